"""Lets the routers of a deployment over hosts pass a new connection.

In: the ends of a connection. Out: the access rules of all routers allow it. On one machine there
are no routers, and nothing happens.
"""

from __future__ import annotations

from typing import TYPE_CHECKING

from robocomp_dsl.cli.program import EXIT_FINDINGS, CliError

if TYPE_CHECKING:
    from robocomp_dsl.cli.rcdeploy.inspect.connection_calls import ConnectionEnds
    from robocomp_dsl.cli.rcdeploy.inspect.target import DomainTarget


def grant_connection(target: DomainTarget, ends: ConnectionEnds) -> None:
    """Allow the connection in the rules of all routers. Raises `CliError`."""
    from robocomp_dsl.deploy.supervisor_engine import SupervisorEngine  # noqa: PLC0415

    if target.engine is None or isinstance(target.engine, SupervisorEngine):
        return
    from robocomp_dsl.deploy.hosts.access_changes import CannotGrant, grant  # noqa: PLC0415 - loads asyncssh
    from robocomp_dsl.deploy.hosts.host_engine import HostEngine  # noqa: PLC0415
    from robocomp_dsl.deploy.network.port_uses import AddedConnection  # noqa: PLC0415

    assert isinstance(target.engine, HostEngine)  # noqa: S101 - the other kind of engine
    source, sink = ends.source, ends.target
    connection = AddedConnection(source.component, source.port, sink.component, sink.port)
    try:
        if grant(target.engine.deployment, connection):
            print("the routers of all hosts pass the connection")
    except CannotGrant as error:
        raise CliError(EXIT_FINDINGS, str(error)) from None
