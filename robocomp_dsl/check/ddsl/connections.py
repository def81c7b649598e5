"""The explicit connections of a deployment.

In: `connect` lines and instances. Out: `Connection` values, and diagnostics.
"""

from __future__ import annotations

from collections.abc import Collection, Iterable, Mapping, Sequence

from robocomp_dsl.check.cdsl.middlewares import find_middleware
from robocomp_dsl.check.codes import deployment as codes
from robocomp_dsl.check.ddsl.monitors import ConnectionContext, resolve_monitors
from robocomp_dsl.check.ddsl.qos import qos_of
from robocomp_dsl.check.literals import join_names
from robocomp_dsl.check.workspace.imports import replace_fix
from robocomp_dsl.diagnostics import Edit, Fix, Note, Report, nearest
from robocomp_dsl.model.component import Port, Role
from robocomp_dsl.model.deployment import Connection, External, Instance
from robocomp_dsl.syntax.ast import ddsl as ast

SOURCES = (Role.REQUIRES, Role.PUBLISHES)
TARGETS = (Role.IMPLEMENTS, Role.SUBSCRIBES)
_MATCHING_ROLE = {Role.REQUIRES: Role.IMPLEMENTS, Role.PUBLISHES: Role.SUBSCRIBES}


class ExplicitConnections:
    """The valid connections, and the names of instances with an invalid connection."""

    def __init__(self, faulty: Iterable[str] = ()) -> None:
        self.connections: list[Connection] = []
        self.faulty_instances = set(faulty)
        self._first: dict[tuple[int, ...], Connection] = {}

    def add(self, connection: Connection) -> Connection | None:
        """Add a connection, unless an earlier one, which is returned, has its required port.

        Nor are two connections added between the same ports.
        """
        source = (id(connection.source), id(connection.source_port))
        both = (*source, id(connection.target), id(connection.target_port))
        is_required = connection.source_port.role is Role.REQUIRES
        earlier = self._first.setdefault(source if is_required else both, connection)
        if earlier is not connection:
            return earlier
        self.connections.append(connection)
        return None


def explicit_connections(
    trees: Sequence[ast.Connection],
    instances: Mapping[str, Instance],
    faulty: Collection[str],
    context: ConnectionContext,
    report: Report,
) -> ExplicitConnections:
    """The valid connections between `instances`; `faulty`: see `ExplicitConnections`."""
    explicit = ExplicitConnections(faulty)
    for tree in trees:
        add_connection(tree, instances, explicit, context, report)
    return explicit


def add_connection(
    tree: ast.Connection,
    instances: Mapping[str, Instance],
    explicit: ExplicitConnections,
    context: ConnectionContext,
    report: Report,
) -> Connection | None:
    """Resolve a connection and add it to `explicit`; None if it is invalid."""
    connection = _connection(tree, instances, context, report)
    earlier = explicit.add(connection) if connection else None
    if connection and earlier:
        _report_duplicate(connection, earlier, report)
    if connection is None or earlier:
        explicit.faulty_instances.update((tree.source.instance.text, tree.target.instance.text))
        return None
    return connection


def same_interface(first: Port, second: Port) -> bool:
    """Whether two ports have the same interface, possibly from two copies of its file."""
    return first.interface.qualified == second.interface.qualified


def _connection(
    tree: ast.Connection,
    instances: Mapping[str, Instance],
    context: ConnectionContext,
    report: Report,
) -> Connection | None:
    qos = qos_of(tree.qos, report)
    middleware = find_middleware(tree.over, context.workspace.middlewares, report)
    source = instances.get(tree.source.instance.text)
    target = instances.get(tree.target.instance.text)
    if source is None or target is None or (tree.over and not middleware):
        return None
    if _is_external(tree, source, target, report) or _is_reversed(tree, source, target, report):
        return None
    source_port = _port(tree.source, source, SOURCES, report)
    target_port = _port(tree.target, target, TARGETS, report)
    if source_port is None or target_port is None:
        return None
    if not _matches(tree, source_port, target_port, report):
        return None
    monitors = resolve_monitors(tree, target_port, context, report)
    return Connection(
        source,
        source_port,
        target,
        target_port,
        tree.span,
        qos,
        middleware=middleware,
        middleware_span=tree.over.span if tree.over else None,
        monitors=monitors,
    )


def _named(instance: Instance, name: str, roles: tuple[Role, ...]) -> Port | None:
    ports = (port for port in instance.component.ports if port.role in roles)
    return next((port for port in ports if port.name == name), None)


def _is_external(tree: ast.Connection, source: Instance, target: Instance, report: Report) -> bool:
    """Whether both ends are external programs; reports it."""
    if not (isinstance(source, External) and isinstance(target, External)):
        return False
    report.add(
        codes.PORT_ROLE,
        tree.source.span.cover(tree.target.span),
        f"`{source.name}` and `{target.name}` are external programs",
        help="a connection has a component of the deployment at one end",
    )
    return True


def _is_reversed(tree: ast.Connection, source: Instance, target: Instance, report: Report) -> bool:
    """Whether the connection runs from server to client; reports it."""
    right = _named(source, tree.source.port.text, SOURCES) and _named(
        target, tree.target.port.text, TARGETS
    )
    turned = _named(source, tree.source.port.text, TARGETS) and _named(
        target, tree.target.port.text, SOURCES
    )
    if right or not turned:
        return False
    edits = (
        Edit(tree.source.span, tree.target.span.text),
        Edit(tree.target.span, tree.source.span.text),
    )
    report.add(
        codes.PORT_ROLE,
        tree.source.span.cover(tree.target.span),
        "this connection is reversed",
        help="a connection runs from the component that requires or publishes to the one that "
        "implements or subscribes",
        fix=Fix("swap the two ends", edits),
    )
    return True


def _port(
    tree: ast.PortRef, instance: Instance, roles: tuple[Role, ...], report: Report
) -> Port | None:
    match = _named(instance, tree.port.text, roles)
    if match is not None:
        return match
    source = roles is SOURCES
    expected = "requires or publishes" if source else "implements or subscribes to"
    other = _named(instance, tree.port.text, (*SOURCES, *TARGETS))
    if other is not None:
        report.add(
            codes.PORT_ROLE,
            tree.port.span,
            f"a connection {'starts' if source else 'ends'} at a port that a component {expected}",
            notes=[Note(other.span, f"`{instance.name}` {other.role} `{other.name}`")],
        )
        return None
    invalid = instance.component.invalid_ports
    if tree.port.text in invalid or tree.port.text != tree.port.span.text:
        return None  # reported where the port, or its export from a group, is declared
    known = [port.name for port in instance.component.ports if port.role in roles]
    known += sorted(invalid)
    guess = nearest(tree.port.text, known)
    report.add(
        codes.UNKNOWN_PORT,
        tree.port.span,
        f"`{instance.name}` has no port `{tree.port.text}` that it {expected}",
        label=f"did you mean `{guess}`?" if guess else "",
        notes=[Note(instance.component.span, f"`{instance.component.name}` is declared here")],
        help="" if guess else f"it has {join_names(known) or 'none'}",
        fix=replace_fix(tree.port.span, guess) if guess else None,
    )
    return None


def _matches(tree: ast.Connection, source: Port, target: Port, report: Report) -> bool:
    span = tree.source.span.cover(tree.target.span)
    notes = [
        Note(source.span, f"{source.role} `{source.interface.name}`"),
        Note(target.span, f"{target.role} `{target.interface.name}`"),
    ]
    if _MATCHING_ROLE[source.role] is not target.role:
        message = f"`{source.role}` cannot be connected to `{target.role}`"
        right = "connect `requires` to `implements` and `publishes` to `subscribesTo`"
        report.add(codes.PORT_ROLE, span, message, notes=notes, help=right)
        return False
    if not same_interface(source, target):
        message = f"`{source.interface.qualified}` cannot be connected to "
        message += f"`{target.interface.qualified}`"
        report.add(codes.INTERFACE_MISMATCH, span, message, notes=notes)
        return False
    return True


def _report_duplicate(connection: Connection, earlier: Connection, report: Report) -> None:
    report.add(
        codes.CONNECTED_TWICE,
        connection.span,
        f"`{connection.source.name}.{connection.source_port.name}` is already connected",
        notes=[Note(earlier.span, "connected here")],
    )
