"""Checks the monitors at publishers.

In: connections. Out: diagnostics.
"""

from __future__ import annotations

from collections.abc import Sequence

from robocomp_dsl.check.codes import connections as codes
from robocomp_dsl.diagnostics import Note, Report
from robocomp_dsl.model.deployment import Connection


def check_sender_monitors(connections: Sequence[Connection], report: Report) -> None:
    """Report publishers with different monitors: a message is sent once for all subscribers."""
    first: dict[tuple[int, int], Connection] = {}
    for connection in connections:
        if not connection.source_port.role.is_topic:
            continue
        key = (id(connection.source), id(connection.source_port))
        earlier = first.setdefault(key, connection)
        if _sender_monitors(earlier) != _sender_monitors(connection):
            name = f"{connection.source.name}.{connection.source_port.name}"
            report.add(
                codes.MONITOR,
                connection.span,
                f"all connections of `{name}` need the same monitors `at sender`",
                notes=[Note(earlier.span, "this connection has others")],
                help="a message is sent once for all subscribers; write `at receiver`",
            )


def _sender_monitors(connection: Connection) -> list[object]:
    return [monitor for monitor in connection.monitors if monitor.position == "sender"]
