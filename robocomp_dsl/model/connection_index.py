"""The connections of a deployment by instance. Pure.

A deployment has about as many connections as instances, so a search of all connections for each
instance would take a time that grows with the square of their number.
"""

from __future__ import annotations

from collections.abc import Iterable, Sequence

from robocomp_dsl.model.deployment import Connection, Instance


class ConnectionIndex:
    """The connections at each instance, in their order."""

    def __init__(self, connections: Iterable[Connection]) -> None:
        self._by_name: dict[str, list[Connection]] = {}
        for connection in connections:
            for name in {connection.source.name, connection.target.name}:
                self._by_name.setdefault(name, []).append(connection)

    def at(self, instance: Instance) -> Sequence[Connection]:
        """The connections with an end at `instance`, also at an external program."""
        return self._by_name.get(instance.name, ())
