"""Changes parameters of a running component: all or none, with hooks of its worker.

In: the parameters, the worker, paths and values. Out: the changed parameters, or
`ParameterRejected` with all reasons and nothing changed. The caller holds the lock.
"""

from __future__ import annotations

import logging
from collections.abc import Callable, Mapping
from dataclasses import dataclass
from typing import Any, TypeAlias

from robocomp_dsl.runtime.parameters.errors import ParameterRejected, did_you_mean
from robocomp_dsl.runtime.parameters.group import walk_parameters
from robocomp_dsl.runtime.parameters.overrides import format_path, parse_path
from robocomp_dsl.runtime.parameters.scalar import InvalidValue
from robocomp_dsl.runtime.parameters.schema import Element, Parameter, ParameterGroup, Value
from robocomp_dsl.runtime.parameters.value_list import element_of

_log = logging.getLogger("robocomp.parameters")

Interpret: TypeAlias = Callable[[Parameter, str, Any], Value]
"""Converts and checks a requested value: `(parameter, path, value)`; raises `InvalidValue`."""


@dataclass(frozen=True, slots=True)
class _Change:
    """One change that has passed the checks."""

    owner: ParameterGroup
    parameter: Parameter
    path: tuple[str | int, ...]
    old: Any
    new: Any

    def call(self, prefix: str, worker: object, value: Value) -> None:
        """Call the hook of this parameter, if the worker has one."""
        names = "_".join(step for step in self.path if isinstance(step, str))
        hook: Callable[..., Any] | None = getattr(worker, f"{prefix}_{names}", None)
        if hook:
            hook(value, *(step for step in self.path if isinstance(step, int)))


def apply_changes(
    root: ParameterGroup, worker: object, requested: Mapping[str, Any], interpret: Interpret
) -> list[str]:
    """Check all changes, call the `will_set` hooks, assign, call `did_set`; returns the paths."""
    changes = _check_changes(root, requested, interpret)
    _call_will_set(worker, changes)
    for change in changes:
        object.__setattr__(change.owner, change.parameter.attribute, change.new)
    _call_did_set(worker, changes)
    return [format_path(change.path) for change in changes]


def _check_changes(
    root: ParameterGroup, requested: Mapping[str, Any], interpret: Interpret
) -> list[_Change]:
    changes: dict[str, _Change] = {}
    reasons: list[str] = []
    known = {path: (owner, parameter) for path, owner, parameter in walk_parameters(root)}
    for path, value in requested.items():
        name, index = _split_index(path, known)
        if name not in known:
            reasons.append(_unknown_parameter(path, list(known)))
            continue
        owner, parameter = known[name]
        old = getattr(owner, parameter.attribute)
        former = changes[name].new if name in changes else old
        try:
            if index is None:
                new = _check_value(parameter, path, value, interpret)
            else:
                new = _with_element(parameter, name, index, value, former, interpret)
        except InvalidValue as unfit:
            reasons.append("; ".join(filter(None, (str(unfit), unfit.label, unfit.help))))
            continue
        changes[name] = _Change(owner, parameter, tuple(parse_path(name) or ()), old, new)
    if reasons:
        raise ParameterRejected("\n".join(reasons))
    return [change for change in changes.values() if change.new != change.old]


def _split_index(path: str, known: Mapping[str, tuple[Any, Parameter]]) -> tuple[str, int | None]:
    """The path of a parameter and None; of an element, those of its list and its position."""
    steps = parse_path(path)
    if path in known or not steps or not isinstance(steps[-1], int):
        return path, None
    name = format_path(steps[:-1])
    return (name, steps[-1]) if name in known and known[name][1].is_list else (path, None)


def _with_element(
    parameter: Parameter,
    name: str,
    index: int,
    value: object,
    former: list[Element],
    interpret: Interpret,
) -> list[Element]:
    """The list `former` with a new value at a position."""
    if index >= len(former):
        size = f"{len(former)} element{'' if len(former) == 1 else 's'}"
        raise InvalidValue(
            f"`{name}` has {size}, there is no [{index}] (they count from 0)",
            help=f"set the whole list to change its length, as in `{name}=[…]`",
        )
    new = _check_value(element_of(parameter), f"{name}[{index}]", value, interpret)
    assert isinstance(new, bool | int | float | str)  # noqa: S101 - of one element
    return [*former[:index], new, *former[index + 1 :]]


def _check_value(parameter: Parameter, path: str, value: object, interpret: Interpret) -> Value:
    if not parameter.live:
        raise InvalidValue(f"`{path}` is not live: it is read at the start only")
    return interpret(parameter, path, value)


def _call_will_set(worker: object, changes: list[_Change]) -> None:
    reasons = []
    for change in changes:
        try:
            change.call("will_set", worker, change.new)
        except ParameterRejected as refusal:
            reasons.append(f"`{format_path(change.path)}` stays {change.old!r}: {refusal.reason}")
    if reasons:
        raise ParameterRejected("\n".join(reasons))
    together: Callable[[dict[str, Value]], Any] | None = getattr(worker, "will_set", None)
    if together and changes:
        together({format_path(change.path): change.new for change in changes})


def _call_did_set(worker: object, changes: list[_Change]) -> None:
    for change in changes:
        try:
            change.call("did_set", worker, change.old)
        except Exception:
            _log.exception("did_set of `%s` failed; the change stays", format_path(change.path))


def _unknown_parameter(path: str, known: list[str]) -> str:
    for name in known:
        if name.startswith((f"{path}.", f"{path}[")):
            return f"`{path}` is a group: change one of its members, as in `{name}`"
    message = f"unknown parameter `{path}`"
    array = path.partition("[")[0]
    entries = {name.partition("]")[0] for name in known if name.startswith(f"{array}[")}
    if entries and not any(path.startswith(f"{entry}]") for entry in entries):
        many = "one entry" if len(entries) == 1 else f"{len(entries)} entries"
        return f"{message}; `{array}` has {many}"
    guess = did_you_mean(path, known)
    return f"{message}; {guess}" if guess else message
