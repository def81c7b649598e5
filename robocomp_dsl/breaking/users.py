"""Finds the connections that a change of a type or an interface affects.

In: deployments. Out: for the name of a declaration, notes at the connections that use it.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator

from robocomp_dsl.diagnostics import Note
from robocomp_dsl.model import types
from robocomp_dsl.model.deployment import Connection, Deployment
from robocomp_dsl.model.interface import Interface
from robocomp_dsl.model.types import Declaration, Type

MAX_NOTES = 3
"""Notes per change."""


class Users:
    """The connections of deployments by the declarations that they use."""

    def __init__(self, deployments: Iterable[Deployment]) -> None:
        self._notes: dict[str, list[Note]] = {}
        for deployment in deployments:
            for connection in deployment.connections:
                note = Note(connection.span, _describe(deployment, connection))
                for name in _carried(connection.source_port.interface):
                    self._notes.setdefault(name, []).append(note)

    def notes(self, qualified: str) -> list[Note]:
        """Notes at the connections that use the declaration."""
        found = self._notes.get(qualified, [])
        more = len(found) - MAX_NOTES
        if more <= 0:
            return found
        last = found[MAX_NOTES - 1]
        return [
            *found[: MAX_NOTES - 1],
            Note(last.span, f"{last.message}; {more} more connections use it"),
        ]


def _describe(deployment: Deployment, connection: Connection) -> str:
    source = f"{connection.source.name}.{connection.source_port.name}"
    target = f"{connection.target.name}.{connection.target_port.name}"
    return f"deployment `{deployment.name}` connects `{source}` to `{target}` with it: restart both"


def _carried(interface: Interface) -> set[str]:
    found: dict[str, Declaration] = {}
    todo: list[Declaration | Type | None] = [interface]
    while todo:
        item = todo.pop()
        if isinstance(item, Declaration) and item.qualified not in found:
            found[item.qualified] = item
            todo.extend(_parts(item))
    return set(found)


def _parts(item: Declaration) -> Iterator[Declaration | Type | None]:
    match item:
        case types.Struct() | types.ExceptionType():
            yield from (field.type for field in item.fields)
        case types.Sequence():
            yield item.element
        case types.Dictionary():
            yield from (item.key, item.value)
        case Interface():
            for operation in item.operations:
                yield operation.result
                yield from (param.type for param in (*operation.inputs, *operation.outputs))
                yield from operation.throws
