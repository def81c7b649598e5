"""Compares types and interfaces of two versions.

In: the declarations of both versions, by qualified name. Out: changes of kind `WIRE`, `SOURCE` and
`BEHAVIOUR`.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from itertools import zip_longest
from typing import Any

from robocomp_dsl.breaking import codes
from robocomp_dsl.breaking.changes import Changes
from robocomp_dsl.breaking.users import Users
from robocomp_dsl.diagnostics import Report
from robocomp_dsl.model import types
from robocomp_dsl.model.interface import Interface, Operation, Param
from robocomp_dsl.model.types import Declaration, Enum, Field, Type


def compare_declarations(
    old: Mapping[str, Declaration], new: Mapping[str, Declaration], users: Users, report: Report
) -> None:
    """Compare the declarations with the same name; notes point to the affected `users`."""
    for name, was in old.items():
        changes = Changes(Report())
        _compare_named(name, was, new.get(name), changes)
        for item in changes.report:
            notes = users.notes(name) if item.code is codes.WIRE else []
            report.extend([item.replace(notes=(*item.notes, *notes))])


def _compare_named(name: str, was: Declaration, now: Declaration | None, changes: Changes) -> None:
    if now is None:
        changes.add(codes.WIRE, was, None, f"{_kind(was)} `{name}` was removed")
    elif type(now) is not type(was):
        changes.add(codes.WIRE, was, now, f"`{name}` was {_article(was)}, now {_article(now)}")
    else:
        _compare(was, now, changes)


def type_name(type_: Type | None) -> str:
    """The name of a type as users write it."""
    if type_ is None:
        return "void"
    return type_.name if isinstance(type_, types.Primitive) else type_.qualified


def _compare(was: Any, now: Any, changes: Changes) -> None:
    match was:
        case types.Struct() | types.ExceptionType():
            _fields(was, was.fields, now.fields, now, changes)
        case Enum():
            _enum(was, now, changes)
        case types.Sequence():
            what = f"elements of `{was.qualified}`"
            _same_type(was, now, was.element, now.element, what, changes)
            if was.bound != now.bound:
                limits = [f"{limit or 'any number of'} {what}" for limit in (was.bound, now.bound)]
                message = f"at most {limits[0]} were allowed, now {limits[1]}"
                changes.add(codes.WIRE, was, now, message)
        case types.Dictionary():
            _same_type(was, now, was.key, now.key, f"keys of `{was.qualified}`", changes)
            _same_type(was, now, was.value, now.value, f"values of `{was.qualified}`", changes)
        case Interface():
            _interface(was, now, changes)


def _same_type(
    was: Declaration, now: Declaration, old: Type, new: Type, what: str, changes: Changes
) -> None:
    if type_name(old) != type_name(new):
        message = f"the {what} were {type_name(old)}, now {type_name(new)}"
        changes.add(codes.WIRE, was, now, message)


def _fields(
    was: Declaration,
    old: Sequence[Field],
    new: Sequence[Field],
    now: Declaration,
    changes: Changes,
) -> None:
    names = [f.name for f in old], [f.name for f in new]
    for before, after in zip_longest(old, new):
        if before is None:
            message = f"field `{after.name}` of `{was.qualified}` was added"
            changes.add(codes.WIRE, was, after, message)
        elif after is None:
            message = f"field `{before.name}` of `{was.qualified}` was removed"
            changes.add(codes.WIRE, before, now, message)
        elif before.name != after.name:
            moved = before.name in names[1] or after.name in names[0]
            message = f"field `{before.name}` of `{was.qualified}` is `{after.name}` now"
            replaced = f"in place of field `{before.name}` `{was.qualified}` has `{after.name}`"
            changes.add(codes.WIRE, before, after, replaced if moved else message)
        else:
            _field(before, after, f"`{was.qualified}.{before.name}`", changes)


def _field(was: Field, now: Field, what: str, changes: Changes) -> None:
    if type_name(was.type) != type_name(now.type):
        message = f"{what} was {type_name(was.type)}, now {type_name(now.type)}"
        changes.add(codes.WIRE, was, now, message)
    _unit(was, now, what, changes)
    if (was.default, was.items) != (now.default, now.items):
        old, new = was.items or was.default, now.items or now.default
        message = f"the default of {what} was {_shown(old)}, now {_shown(new)}"
        changes.add(codes.BEHAVIOUR, was, now, message)


def _enum(was: Enum, now: Enum, changes: Changes) -> None:
    values = {e.name: e for e in now.enumerators}
    for enumerator in was.enumerators:
        found = values.get(enumerator.name)
        if found is None:
            changes.add(
                codes.WIRE, enumerator, now, f"`{enumerator.name}` of `{was.qualified}` was removed"
            )
        elif found.value != enumerator.value:
            values_text = f"was {enumerator.value}, now {found.value}"
            message = f"`{enumerator.name}` of `{was.qualified}` {values_text}"
            changes.add(codes.WIRE, enumerator, found, message)
    for enumerator in now.enumerators:
        if enumerator.name not in {e.name for e in was.enumerators}:
            message = (
                f"`{enumerator.name}` of `{was.qualified}` was added: older peers do not know it"
            )
            changes.add(codes.WIRE, was, enumerator, message)


def _interface(was: Interface, now: Interface, changes: Changes) -> None:
    found = {o.name: o for o in now.operations}
    for operation in was.operations:
        after = found.pop(operation.name, None)
        if after is None:
            message = f"operation `{operation.name}` of `{was.qualified}` was removed"
            changes.add(codes.WIRE, operation, now, message)
        else:
            _operation(operation, after, f"`{was.qualified}.{operation.name}`", changes)
    for new in found.values():
        message = (
            f"operation `{new.name}` of `{was.qualified}` was added: generate both sides again"
        )
        changes.add(codes.WIRE, was, new, message)


def _operation(was: Operation, now: Operation, what: str, changes: Changes) -> None:
    if was.pattern is not now.pattern:
        changes.add(codes.WIRE, was, now, f"{what} was a {was.pattern}, now a {now.pattern}")
    if type_name(was.result) != type_name(now.result):
        message = f"{what} returned {type_name(was.result)}, now {type_name(now.result)}"
        changes.add(codes.WIRE, was, now, message)
    _params("input", was, was.inputs, now, now.inputs, what, changes)
    _params("output", was, was.outputs, now, now.outputs, what, changes)
    thrown = [{t.qualified for t in item.throws} for item in (was, now)]
    if thrown[0] != thrown[1]:
        listed = ["nothing" if not names else ", ".join(sorted(names)) for names in thrown]
        changes.add(codes.WIRE, was, now, f"{what} threw {listed[0]}, now {listed[1]}")
    if was.idempotent and not now.idempotent:
        message = f"{what} is no longer idempotent: a lost call is not repeated"
        changes.add(codes.BEHAVIOUR, was, now, message)


def _params(
    kind: str,
    was: Operation,
    old: Sequence[Param],
    now: Operation,
    new: Sequence[Param],
    what: str,
    changes: Changes,
) -> None:
    if len(old) != len(new):
        message = f"{what} had {len(old)} {kind}{'s' if len(old) != 1 else ''}, now {len(new)}"
        changes.add(codes.WIRE, was, now, message)
        return
    for before, after in zip(old, new, strict=True):
        name = f"{kind} `{before.name}` of {what}"
        if type_name(before.type) != type_name(after.type):
            message = f"{name} was {type_name(before.type)}, now {type_name(after.type)}"
            changes.add(codes.WIRE, before, after, message)
        if before.name != after.name:
            changes.add(codes.SOURCE, before, after, f"{name} is called `{after.name}` now")
        _unit(before, after, name, changes)


def _unit(was: Field | Param, now: Field | Param, what: str, changes: Changes) -> None:
    if was.unit != now.unit:
        message = f"{what} was in {was.unit or 'no unit'}, now in {now.unit or 'no unit'}"
        changes.add(codes.BEHAVIOUR, was, now, message)


def _shown(default: object) -> str:
    return "none" if default is None else repr(default)


def _kind(item: Declaration) -> str:
    return "exception" if isinstance(item, types.ExceptionType) else type(item).__name__.lower()


def _article(item: Declaration) -> str:
    kind = _kind(item)
    return f"an {kind}" if kind[0] in "aeiou" else f"a {kind}"
