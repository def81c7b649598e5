"""Compares parameters of two versions: which configurations the new version rejects.

In: the parameter sets of both versions, by name. Out: changes of kind `CONFIGURATION` and
`BEHAVIOUR`.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence

from robocomp_dsl.breaking import codes
from robocomp_dsl.breaking.changes import Changes, Placed
from robocomp_dsl.model.component import Component
from robocomp_dsl.model.parameter import Kind, Parameter, ParameterSet


def compare_of_components(
    old: Mapping[str, Component], new: Mapping[str, Component], changes: Changes
) -> None:
    """Compare the parameters of the components with the same name."""
    for name in sorted(old.keys() & new.keys()):
        was, now = old[name].parameters, new[name].parameters
        if was and now is None:
            changes.add(codes.CONFIGURATION, was, None, f"the parameters of `{name}` were removed")
        elif now:
            _compare(was.parameters if was else (), now.parameters, now, "", changes)


def compare_sets(
    old: Mapping[str, ParameterSet], new: Mapping[str, ParameterSet], changes: Changes
) -> None:
    """Compare the parameter sets with the same name."""
    for name, was in old.items():
        now = new.get(name)
        if now is None:
            changes.add(codes.CONFIGURATION, was, None, f"the parameters of `{name}` were removed")
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
            changes.add(codes.CONFIGURATION, was, within, f"parameter {name} was removed")
        elif _accepted_kind(was) != _accepted_kind(now):
            message = f"parameter {name} was {_accepted_kind(was)}, now it is {_accepted_kind(now)}"
            changes.add(codes.CONFIGURATION, was, now, message)
        else:
            _parameter(was, now, name, changes)
            _compare(was.members, now.members, now, f"{path}{was.name}.", changes)
    for item in found.values():
        if _is_required(item):
            message = f"parameter `{path}{item.name}` was added and is required"
            changes.add(codes.CONFIGURATION, item, item, message)


def _parameter(was: Parameter, now: Parameter, name: str, changes: Changes) -> None:
    if _is_required(now) and not _is_required(was):
        changes.add(codes.CONFIGURATION, was, now, f"parameter {name} is now required")
    if _narrower(was, now):
        message = f"parameter {name} accepted {_range(was)}, now {_range(now)}"
        changes.add(codes.CONFIGURATION, was, now, message)
    if was.is_list and _is_shorter(was, now):
        lengths = f"{was.describe_length()}, now {now.describe_length()}"
        changes.add(codes.CONFIGURATION, was, now, f"parameter {name} accepted {lengths}")
    for gone in (c for c in was.choices if c not in now.choices):
        message = f"parameter {name} no longer accepts `{gone}`"
        changes.add(codes.CONFIGURATION, was, now, message)
    if was.unit != now.unit:
        message = f"parameter {name} was in {was.unit or 'no unit'}, now in {now.unit or 'no unit'}"
        changes.add(codes.BEHAVIOUR, was, now, message)
    if was.default is not None and now.default is not None and was.default != now.default:
        old, new = _default(was), _default(now)
        message = f"the default of {name} was {old}, now {new}"
        changes.add(codes.BEHAVIOUR, was, now, message)
    if was.live and not now.live:
        message = f"parameter {name} can no longer change while running"
        changes.add(codes.BEHAVIOUR, was, now, message)


def _accepted_kind(item: Parameter) -> str:
    """The accepted kind of value, in words."""
    if item.kind is Kind.GROUP:
        return "one group" if item.single else "a list of groups"
    if item.is_list:
        return f"a list, each {_accepted_kind(item.replace(shortest=None))}"
    words = {Kind.STRING: "a string", Kind.BOOL: "a bool", Kind.CHOICE: "one of some words"}
    return words.get(item.kind, "a number" if item.kind is Kind.FLOAT else "a whole number")


def _is_required(item: Parameter) -> bool:
    if item.kind is Kind.GROUP:
        return any(map(_is_required, item.members)) if item.single else bool(item.low)
    return item.default is None


def _narrower(was: Parameter, now: Parameter) -> bool:
    low = now.low is not None and (was.low is None or now.low > was.low)
    high = now.high is not None and (was.high is None or now.high < was.high)
    return low or high


def _is_shorter(was: Parameter, now: Parameter) -> bool:
    """Whether some lists that were accepted are too short or too long now."""
    if (now.shortest or 0) > (was.shortest or 0):
        return True
    return now.longest is not None and (was.longest is None or now.longest < was.longest)


def _default(item: Parameter) -> str:
    return str(list(item.default)) if isinstance(item.default, tuple) else repr(item.default)


def _range(item: Parameter) -> str:
    ends = ["any" if end is None else f"{end:g}" for end in (item.low, item.high)]
    return f"{ends[0]} to {ends[1]}"
