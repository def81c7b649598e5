"""Parameters of two versions compared: which configurations are refused by the new one.

In: the parameter sets of both, by name. Out: changes of kind configuration, source and behaviour.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence

from robocomp_dsl.compare import codes
from robocomp_dsl.compare.changes import Changes, Placed
from robocomp_dsl.model.component import Component
from robocomp_dsl.model.parameter import Kind, Parameter, ParameterSet


def compare_of_components(
    old: Mapping[str, Component], new: Mapping[str, Component], changes: Changes
) -> None:
    """The parameters of each component with those that it has now; one may have none."""
    for name in sorted(old.keys() & new.keys()):
        was, now = old[name].parameters, new[name].parameters
        if was and now is None:
            changes.add(codes.CONFIGURATION, was, None, f"the parameters of `{name}` are gone")
        elif now:
            _compare(was.parameters if was else (), now.parameters, now, "", changes)


def compare_sets(
    old: Mapping[str, ParameterSet], new: Mapping[str, ParameterSet], changes: Changes
) -> None:
    """Each set with the one of the same name; one that is gone has no parameters any more."""
    for name, was in old.items():
        now = new.get(name)
        if now is None:
            changes.add(codes.CONFIGURATION, was, None, f"the parameters of `{name}` are gone")
        else:
            _compare(was.parameters, now.parameters, now, "", changes)


def _compare(
    old: Sequence[Parameter], new: Sequence[Parameter], within: Placed, path: str, changes: Changes
) -> None:
    found = {p.name: p for p in new}
    for was in old:
        now = found.pop(was.name, None)
        name = f"`{path}{was.name}`"
        if now is None:
            changes.add(codes.CONFIGURATION, was, within, f"parameter {name} is gone")
        elif _takes(was) != _takes(now):
            said = f"parameter {name} was {_takes(was)}, now it is {_takes(now)}"
            changes.add(codes.CONFIGURATION, was, now, said)
        else:
            _parameter(was, now, name, changes)
            _compare(was.members, now.members, now, f"{path}{was.name}.", changes)
    for one in found.values():
        if _must(one):
            said = f"parameter `{path}{one.name}` is new and must be given"
            changes.add(codes.CONFIGURATION, one, one, said)


def _parameter(was: Parameter, now: Parameter, name: str, changes: Changes) -> None:
    if _must(now) and not _must(was):
        changes.add(codes.CONFIGURATION, was, now, f"parameter {name} must be given now")
    if _narrower(was, now):
        said = f"parameter {name} took {_range(was)}, now {_range(now)}"
        changes.add(codes.CONFIGURATION, was, now, said)
    for gone in (c for c in was.choices if c not in now.choices):
        said = f"parameter {name} does not take `{gone}` any more"
        changes.add(codes.CONFIGURATION, was, now, said)
    if was.unit != now.unit:
        said = f"parameter {name} was in {was.unit or 'no unit'}, now in {now.unit or 'no unit'}"
        changes.add(codes.BEHAVIOUR, was, now, said)
    if was.default is not None and now.default is not None and was.default != now.default:
        said = f"the default of {name} was {was.default!r}, now {now.default!r}"
        changes.add(codes.BEHAVIOUR, was, now, said)
    if was.live and not now.live:
        said = f"parameter {name} may not change any more while running"
        changes.add(codes.BEHAVIOUR, was, now, said)


def _takes(one: Parameter) -> str:
    """The kind of value; a whole number is taken where a number is."""
    if one.kind is Kind.GROUP:
        return "one group" if one.single else "a list of groups"
    words = {Kind.STRING: "a text", Kind.BOOL: "a bool", Kind.CHOICE: "one of some words"}
    return words.get(one.kind, "a number" if one.kind is Kind.FLOAT else "a whole number")


def _must(one: Parameter) -> bool:
    if one.kind is Kind.GROUP:
        return any(map(_must, one.members)) if one.single else bool(one.low)
    return one.default is None


def _narrower(was: Parameter, now: Parameter) -> bool:
    low = now.low is not None and (was.low is None or now.low > was.low)
    high = now.high is not None and (was.high is None or now.high < was.high)
    return low or high


def _range(one: Parameter) -> str:
    ends = ["any" if end is None else f"{end:g}" for end in (one.low, one.high)]
    return f"{ends[0]} to {ends[1]}"
