"""Types and interfaces of two versions compared.

In: the declarations of both, by qualified name. Out: changes of kind wire, source and behaviour.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from itertools import zip_longest
from typing import Any

from robocomp_dsl.compare import codes
from robocomp_dsl.compare.changes import Changes
from robocomp_dsl.compare.users import Users
from robocomp_dsl.diagnostics import Report
from robocomp_dsl.model import types
from robocomp_dsl.model.interface import Interface, Operation, Param
from robocomp_dsl.model.types import Declaration, Enum, Field, Type


def compare_declarations(
    old: Mapping[str, Declaration], new: Mapping[str, Declaration], users: Users, report: Report
) -> None:
    """Each declaration with the one of the same name; `users` are told of what breaks them."""
    for name, was in old.items():
        changes = Changes(Report())
        _compare_named(name, was, new.get(name), changes)
        for one in changes.report:
            notes = users.notes(name) if one.code is codes.WIRE else []
            report.extend([one.replaced(notes=(*one.notes, *notes))])


def _compare_named(name: str, was: Declaration, now: Declaration | None, changes: Changes) -> None:
    if now is None:
        changes.add(codes.WIRE, was, None, f"{_kind(was)} `{name}` is gone")
    elif type(now) is not type(was):
        changes.add(codes.WIRE, was, now, f"`{name}` was {_article(was)}, now {_article(now)}")
    else:
        _compare(was, now, changes)


def type_name(type_: Type | None) -> str:
    """As users write it."""
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
            _same_type(
                was, now, was.element, now.element, f"elements of `{was.qualified}`", changes
            )
        case types.Dictionary():
            _same_type(was, now, was.key, now.key, f"keys of `{was.qualified}`", changes)
            _same_type(was, now, was.value, now.value, f"values of `{was.qualified}`", changes)
        case Interface():
            _interface(was, now, changes)


def _same_type(
    was: Declaration, now: Declaration, old: Type, new: Type, what: str, changes: Changes
) -> None:
    if type_name(old) != type_name(new):
        said = f"the {what} were {type_name(old)}, now {type_name(new)}"
        changes.add(codes.WIRE, was, now, said)


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
            said = f"field `{after.name}` of `{was.qualified}` is new"
            changes.add(codes.WIRE, was, after, said)
        elif after is None:
            said = f"field `{before.name}` of `{was.qualified}` is gone"
            changes.add(codes.WIRE, before, now, said)
        elif before.name != after.name:
            moved = before.name in names[1] or after.name in names[0]
            said = f"field `{before.name}` of `{was.qualified}` is `{after.name}` now"
            told = f"in place of field `{before.name}` `{was.qualified}` has `{after.name}`"
            changes.add(codes.WIRE, before, after, told if moved else said)
        else:
            _field(before, after, f"`{was.qualified}.{before.name}`", changes)


def _field(was: Field, now: Field, what: str, changes: Changes) -> None:
    if type_name(was.type) != type_name(now.type):
        said = f"{what} was {type_name(was.type)}, now {type_name(now.type)}"
        changes.add(codes.WIRE, was, now, said)
    _unit(was, now, what, changes)
    if was.default != now.default:
        said = f"the default of {what} was {_shown(was.default)}, now {_shown(now.default)}"
        changes.add(codes.BEHAVIOUR, was, now, said)


def _enum(was: Enum, now: Enum, changes: Changes) -> None:
    values = {e.name: e for e in now.enumerators}
    for one in was.enumerators:
        found = values.get(one.name)
        if found is None:
            changes.add(codes.WIRE, one, now, f"`{one.name}` of `{was.qualified}` is gone")
        elif found.value != one.value:
            said = f"`{one.name}` of `{was.qualified}` was {one.value}, now {found.value}"
            changes.add(codes.WIRE, one, found, said)
    for one in now.enumerators:
        if one.name not in {e.name for e in was.enumerators}:
            said = f"`{one.name}` of `{was.qualified}` is new: older peers do not know it"
            changes.add(codes.WIRE, was, one, said)


def _interface(was: Interface, now: Interface, changes: Changes) -> None:
    found = {o.name: o for o in now.operations}
    for one in was.operations:
        after = found.pop(one.name, None)
        if after is None:
            said = f"operation `{one.name}` of `{was.qualified}` is gone"
            changes.add(codes.WIRE, one, now, said)
        else:
            _operation(one, after, f"`{was.qualified}.{one.name}`", changes)
    for new in found.values():
        said = f"operation `{new.name}` of `{was.qualified}` is new: both sides must be generated"
        changes.add(codes.WIRE, was, new, said)


def _operation(was: Operation, now: Operation, what: str, changes: Changes) -> None:
    if was.pattern is not now.pattern:
        changes.add(codes.WIRE, was, now, f"{what} was a {was.pattern}, now a {now.pattern}")
    if type_name(was.result) != type_name(now.result):
        said = f"{what} returned {type_name(was.result)}, now {type_name(now.result)}"
        changes.add(codes.WIRE, was, now, said)
    _params("input", was, was.inputs, now, now.inputs, what, changes)
    _params("output", was, was.outputs, now, now.outputs, what, changes)
    thrown = [{t.qualified for t in one.throws} for one in (was, now)]
    if thrown[0] != thrown[1]:
        listed = ["nothing" if not names else ", ".join(sorted(names)) for names in thrown]
        changes.add(codes.WIRE, was, now, f"{what} threw {listed[0]}, now {listed[1]}")
    if was.idempotent and not now.idempotent:
        said = f"{what} is not idempotent any more: a lost call is not repeated"
        changes.add(codes.BEHAVIOUR, was, now, said)


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
        said = f"{what} had {len(old)} {kind}{'s' if len(old) != 1 else ''}, now {len(new)}"
        changes.add(codes.WIRE, was, now, said)
        return
    for before, after in zip(old, new, strict=True):
        name = f"{kind} `{before.name}` of {what}"
        if type_name(before.type) != type_name(after.type):
            said = f"{name} was {type_name(before.type)}, now {type_name(after.type)}"
            changes.add(codes.WIRE, before, after, said)
        if before.name != after.name:
            changes.add(codes.SOURCE, before, after, f"{name} is called `{after.name}` now")
        _unit(before, after, name, changes)


def _unit(was: Field | Param, now: Field | Param, what: str, changes: Changes) -> None:
    if was.unit != now.unit:
        said = f"{what} was in {was.unit or 'no unit'}, now in {now.unit or 'no unit'}"
        changes.add(codes.BEHAVIOUR, was, now, said)


def _shown(default: object) -> str:
    return "none" if default is None else repr(default)


def _kind(one: Declaration) -> str:
    return "exception" if isinstance(one, types.ExceptionType) else type(one).__name__.lower()


def _article(one: Declaration) -> str:
    kind = _kind(one)
    return f"an {kind}" if kind[0] in "aeiou" else f"a {kind}"
