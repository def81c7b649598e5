"""Who is wired by an interface that a type or an interface belongs to.

In: deployments. Out: for a declaration by its name, notes at the wires that carry it.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator

from robocomp_dsl.diagnostics import Note
from robocomp_dsl.model import types
from robocomp_dsl.model.deployment import Connection, Deployment
from robocomp_dsl.model.interface import Interface
from robocomp_dsl.model.types import Declaration, Type

MOST = 3
"""So many wires are told of one change."""


class Users:
    """The wires of some deployments by what they carry."""

    def __init__(self, deployments: Iterable[Deployment]) -> None:
        self._notes: dict[str, list[Note]] = {}
        for deployment in deployments:
            for wire in deployment.connections:
                note = Note(wire.span, _said(deployment, wire))
                for name in _carried(wire.source_port.interface):
                    self._notes.setdefault(name, []).append(note)

    def notes(self, qualified: str) -> list[Note]:
        """Where the declaration called so is used."""
        found = self._notes.get(qualified, [])
        more = len(found) - MOST
        if more <= 0:
            return found
        last = found[MOST - 1]
        return [*found[: MOST - 1], Note(last.span, f"{last.message}; {more} more wires use it")]


def _said(deployment: Deployment, wire: Connection) -> str:
    source = f"{wire.source.name}.{wire.source_port.name}"
    target = f"{wire.target.name}.{wire.target_port.name}"
    return f"deployment `{deployment.name}` wires `{source}` to `{target}` by it: restart both"


def _carried(interface: Interface) -> set[str]:
    found: dict[str, Declaration] = {}
    todo: list[Declaration | Type | None] = [interface]
    while todo:
        one = todo.pop()
        if isinstance(one, Declaration) and one.qualified not in found:
            found[one.qualified] = one
            todo.extend(_parts(one))
    return set(found)


def _parts(one: Declaration) -> Iterator[Declaration | Type | None]:
    match one:
        case types.Struct() | types.ExceptionType():
            yield from (field.type for field in one.fields)
        case types.Sequence():
            yield one.element
        case types.Dictionary():
            yield from (one.key, one.value)
        case Interface():
            for operation in one.operations:
                yield operation.result
                yield from (param.type for param in (*operation.inputs, *operation.outputs))
                yield from operation.throws
