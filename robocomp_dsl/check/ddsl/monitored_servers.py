"""Rules for ports whose connections are told apart: those with monitors, and arbitrated ports.

In: all connections of a deployment. Out: diagnostics.
"""

from __future__ import annotations

from collections.abc import Sequence

from robocomp_dsl.check.codes import connections as codes
from robocomp_dsl.diagnostics import Report
from robocomp_dsl.model.deployment import Connection, External


def check_monitored_servers(connections: Sequence[Connection], report: Report) -> None:
    """Report clients that a monitored or arbitrated port cannot accept."""
    arbitrated = {(id(c.target), id(c.target_port)) for c in connections if c.condition}
    for connection in connections:
        client = f"{connection.source.name}.{connection.source_port.name}"
        server = f"{connection.target.name}.{connection.target_port.name}"
        if connection.implied and (id(connection.target), id(connection.target_port)) in arbitrated:
            report.add(
                codes.ARBITRATION,
                connection.span,
                f"`{client}` needs `{server}`, which is arbitrated",
                help=f"add `from {client} when …;` to `arbitrate {server}`",
            )
        elif isinstance(connection.source, External) and _is_monitored_service(connection):
            report.add(
                codes.ARBITRATION if connection.condition else codes.MONITOR,
                connection.span,
                f"`{server}` cannot tell calls of `{connection.source.name}` from others",
                help="a service monitors and arbitrates calls of components only",
            )


def _is_monitored_service(connection: Connection) -> bool:
    """Whether the server has to know by which connection a call comes."""
    received = any(monitor.position == "receiver" for monitor in connection.monitors)
    return bool(received or connection.condition) and not connection.source_port.role.is_topic
