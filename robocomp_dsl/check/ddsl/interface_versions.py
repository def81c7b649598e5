"""Two versions of an interface at the two ends of a connection.

In: the connections of a deployment. Out: diagnostics. The components would raise
`InterfaceMismatch`, or not receive the messages, when they run.
"""

from __future__ import annotations

from collections.abc import Iterable

from robocomp_dsl.check.codes import connections as codes
from robocomp_dsl.check.workspace.middlewares import KnownMiddlewares
from robocomp_dsl.diagnostics import Note, Report
from robocomp_dsl.model.component import Port
from robocomp_dsl.model.deployment import Connection, External
from robocomp_dsl.model.interface import Interface
from robocomp_dsl.model.interface_shape import InterfaceShapes
from robocomp_dsl.model.port_middlewares import shared_middlewares
from robocomp_dsl.runtime.data.shape_difference import describe_difference
from robocomp_dsl.source import Span


def check_interface_versions(
    connections: Iterable[Connection], deployment: str, known: KnownMiddlewares, report: Report
) -> None:
    """Report each pair of versions once, at the first connection where it does harm.

    `deployment` is the middleware of the deployment, or "".
    """
    shapes: InterfaceShapes | None = None
    seen: set[tuple[int, int]] = set()
    for connection in connections:
        ends = connection.source_port.interface, connection.target_port.interface
        key = id(ends[0]), id(ends[1])
        is_external = isinstance(connection.source, External) or isinstance(
            connection.target, External
        )
        if ends[0] is ends[1] or is_external or key in seen:
            continue
        shapes = shapes or InterfaceShapes()
        is_partial = _works_in_part(connection, deployment, known)
        if _compare(connection, shapes, report, is_partial=is_partial):
            seen.add(key)


def _works_in_part(connection: Connection, deployment: str, known: KnownMiddlewares) -> bool:
    """Whether the middleware carries the messages of the operations that are the same."""
    found = [known.describe(name) for name in shared_middlewares(connection, deployment)]
    return all(each is None or each.capabilities.topic_versions for each in found)


def _compare(
    connection: Connection, shapes: InterfaceShapes, report: Report, *, is_partial: bool
) -> bool:
    """Report the first operation that cannot be used; returns whether there is one."""
    own, other = (shapes.of(port.interface) for port in _ports(connection))
    if not connection.source_port.role.is_topic:
        wrong = [name for name, shape in own.items() if other.get(name) != shape]
    else:
        published = [o.name for port in _ports(connection) for o in port.operations]
        names = [name for name in published if not is_partial or (name in own and name in other)]
        wrong = [name for name in names if own.get(name) != other.get(name)]
    if wrong:
        _report(connection, wrong[0], own.get(wrong[0]), other.get(wrong[0]), report)
    return bool(wrong)


def _ports(connection: Connection) -> tuple[Port, Port]:
    return connection.source_port, connection.target_port


def _report(
    connection: Connection, name: str, own: str | None, other: str | None, report: Report
) -> None:
    source, target = connection.source.component.name, connection.target.component.name
    if own is None or other is None:
        difference = f"`{source if own is None else target}` does not have this operation"
    else:
        difference = describe_difference(own, other)
        difference = difference.replace(" there", f" in `{target}`")
        difference = difference.replace(" here", f" in `{source}`")
    report.add(
        codes.INTERFACE_VERSIONS,
        connection.span,
        f"`{connection.source.name}` and `{connection.target.name}` have different versions of"
        f" `{connection.source_port.interface.qualified}`",
        label=f"`{name}`: {difference}",
        notes=[
            Note(_place(port.interface, name), f"the version of `{component}`")
            for port, component in zip(_ports(connection), (source, target), strict=True)
        ],
        help="import the same file in both, and generate both components again",
    )


def _place(interface: Interface, name: str) -> Span:
    """Where an operation is declared, or the interface that lacks it."""
    return next((o.span for o in interface.operations if o.name == name), interface.span)
