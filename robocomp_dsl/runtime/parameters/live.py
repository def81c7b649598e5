"""Changes of a running component's parameters: all or none, and with the say of its worker.

In: the parameters, the worker, paths and values. Out: the parameters changed, or `Refused` with
every reason and nothing changed. The caller holds the lock.
"""

from __future__ import annotations

import logging
from collections.abc import Callable, Mapping
from dataclasses import dataclass
from typing import Any, TypeAlias

from robocomp_dsl.runtime.parameters.findings import Refused, did_you_mean
from robocomp_dsl.runtime.parameters.group import ParameterGroup, walk
from robocomp_dsl.runtime.parameters.overrides import dotted, steps
from robocomp_dsl.runtime.parameters.scalar import Unfit
from robocomp_dsl.runtime.parameters.schema import Parameter, Value

_log = logging.getLogger("robocomp.parameters")

Interpret: TypeAlias = Callable[[Parameter, str, Any], Value]
"""From what was given to a checked value: `(parameter, path, given)`; raises `Unfit`."""


@dataclass(frozen=True, slots=True)
class _Change:
    """One change that has passed the checks."""

    owner: ParameterGroup
    parameter: Parameter
    path: tuple[str | int, ...]
    old: Value
    new: Value

    def call(self, prefix: str, worker: object, value: Value) -> None:
        """Call the hook of this parameter, if the worker has one."""
        names = "_".join(step for step in self.path if isinstance(step, str))
        hook: Callable[..., Any] | None = getattr(worker, f"{prefix}_{names}", None)
        if hook:
            hook(value, *(step for step in self.path if isinstance(step, int)))


def change(
    root: ParameterGroup, worker: object, given: Mapping[str, Any], interpret: Interpret
) -> list[str]:
    """Check all, ask the worker about all, assign all, tell the worker; what has changed."""
    changes = _checked(root, given, interpret)
    _ask(worker, changes)
    for one in changes:
        object.__setattr__(one.owner, one.parameter.attribute, one.new)
    _tell(worker, changes)
    return [dotted(one.path) for one in changes]


def _checked(root: ParameterGroup, given: Mapping[str, Any], interpret: Interpret) -> list[_Change]:
    made: list[_Change] = []
    reasons: list[str] = []
    known = {path: (owner, parameter) for path, owner, parameter in walk(root)}
    for path, value in given.items():
        owner, parameter = known.get(path, (None, None))
        if owner is None or parameter is None:
            reasons.append(_no_such(path, list(known)))
            continue
        try:
            new = _allowed(parameter, path, value, interpret)
        except Unfit as unfit:
            reasons.append("; ".join(filter(None, (str(unfit), unfit.label, unfit.help))))
            continue
        old = getattr(owner, parameter.attribute)
        if new != old:
            made.append(_Change(owner, parameter, tuple(steps(path) or ()), old, new))
    if reasons:
        raise Refused("\n".join(reasons))
    return made


def _allowed(parameter: Parameter, path: str, value: object, interpret: Interpret) -> Value:
    if not parameter.live:
        raise Unfit(f"`{path}` is not live: it is read at the start only")
    return interpret(parameter, path, value)


def _ask(worker: object, changes: list[_Change]) -> None:
    reasons = []
    for one in changes:
        try:
            one.call("will_set", worker, one.new)
        except Refused as refusal:
            reasons.append(f"`{dotted(one.path)}` stays {one.old!r}: {refusal.reason}")
    if reasons:
        raise Refused("\n".join(reasons))
    together: Callable[[dict[str, Value]], Any] | None = getattr(worker, "will_set", None)
    if together and changes:
        together({dotted(one.path): one.new for one in changes})


def _tell(worker: object, changes: list[_Change]) -> None:
    for one in changes:
        try:
            one.call("did_set", worker, one.old)
        except Exception:
            _log.exception("did_set of `%s` failed; the change stays", dotted(one.path))


def _no_such(path: str, known: list[str]) -> str:
    for name in known:
        if name.startswith((f"{path}.", f"{path}[")):
            return f"`{path}` is a group: change one of its members, as in `{name}`"
    said = f"there is no parameter `{path}`"
    array = path.partition("[")[0]
    entries = {name.partition("]")[0] for name in known if name.startswith(f"{array}[")}
    if entries and not any(path.startswith(f"{one}]") for one in entries):
        many = "one entry" if len(entries) == 1 else f"{len(entries)} entries"
        return f"{said}; `{array}` has {many}"
    guess = did_you_mean(path, known)
    return f"{said}; {guess}" if guess else said
