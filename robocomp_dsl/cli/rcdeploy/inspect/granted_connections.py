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


def has_routers(target: DomainTarget) -> bool:
    """Whether the deployment is on several hosts."""
    from robocomp_dsl.deploy.supervisor_engine import SupervisorEngine  # noqa: PLC0415

    return target.engine is not None and not isinstance(target.engine, SupervisorEngine)


def grant_connection(target: DomainTarget, ends: ConnectionEnds) -> bool:
    """Allow the connection in the rules of all routers; whether they changed. Raises `CliError`."""
    if not has_routers(target):
        return False
    from robocomp_dsl.deploy.hosts.access_changes import CannotGrant, grant  # noqa: PLC0415 - loads asyncssh
    from robocomp_dsl.deploy.hosts.host_engine import HostEngine  # noqa: PLC0415
    from robocomp_dsl.deploy.network.port_uses import AddedConnection  # noqa: PLC0415

    assert isinstance(target.engine, HostEngine)  # noqa: S101 - the other kind of engine
    source, sink = ends.source, ends.target
    connection = AddedConnection(source.component, source.port, sink.component, sink.port)
    try:
        is_changed = grant(target.engine.deployment, connection)
    except CannotGrant as error:
        raise CliError(EXIT_FINDINGS, str(error)) from None
    if is_changed:
        print("the routers of all hosts pass the connection")
    return is_changed
