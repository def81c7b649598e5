"""Which middlewares the ports of a deployment use. Pure.

In: ports, connections, and what their descriptions say. Out: names of middlewares in order of
preference. The nearest word decides: that of the connection or of an external peer, of `port` and
then `middleware` of the instance, the mark of the port in the CDSL file, `middleware` of the CDSL
file, `middleware` of the deployment. A port without any word follows the other end of a connection,
at last the default of components.
"""

from __future__ import annotations

from collections.abc import Iterable

from robocomp_dsl.model.component import Port, Role
from robocomp_dsl.model.deployment import Connection, External, Instance

IN_PROCESS = "inproc"
"""The middleware of connections within one process."""
_FOUND_BY_OTHERS = (Role.IMPLEMENTS, Role.PUBLISHES)


def declared_middlewares(instance: Instance, port: Port, deployment: str) -> tuple[str, ...]:
    """The middlewares that words name for a port, apart from its connections; may be empty.

    `deployment` is the middleware of the file, or empty.
    """
    component = instance.component
    chosen = tuple(own.middleware for own in instance.own_ports if own.port == port.name)
    if chosen:
        return chosen
    if instance.middleware:
        return (instance.middleware,)
    if port.middlewares:
        return port.middlewares
    if component.middleware_span is not None:
        return (component.middleware,)
    return (deployment,) if deployment else ()


def connection_middleware(connection: Connection) -> str:
    """The middleware that a connection names: by `over`, or by an external end; "" for none."""
    for end in (connection.source, connection.target):
        if isinstance(end, External):
            return end.middleware
    return connection.middleware


def shared_middlewares(connection: Connection, deployment: str) -> tuple[str, ...]:
    """The middlewares that can carry a connection; empty if its ports share none."""
    named = connection_middleware(connection)
    if named:
        return (named,)
    source = declared_middlewares(connection.source, connection.source_port, deployment)
    target = declared_middlewares(connection.target, connection.target_port, deployment)
    if source and target:
        return tuple(name for name in source if name in target)
    return source or target or (connection.source.component.middleware,)


def port_middlewares(
    instance: Instance, port: Port, connections: Iterable[Connection], deployment: str
) -> tuple[str, ...]:
    """All middlewares that a port uses: those that are declared and those of its connections."""
    declared = declared_middlewares(instance, port, deployment)
    default = declared or (instance.component.middleware,)
    names: dict[str, None] = {}
    for connection in connections:
        ends = (
            (connection.source, connection.source_port),
            (connection.target, connection.target_port),
        )
        if (instance, port) in ends:
            named = connection_middleware(connection)
            own = (named,) if named else declared or shared_middlewares(connection, deployment)
            names.update(dict.fromkeys(own))
    if IN_PROCESS in names and port.role in _FOUND_BY_OTHERS:
        # The others are for tools, and for what is connected later.
        names = dict.fromkeys((IN_PROCESS, *names, *default))
    return tuple(names) or default
