"""Two versions of an interface at the two ends of a connection.

In: the connections of a deployment. Out: diagnostics. The components would raise
`InterfaceMismatch`, or not receive the messages, when they run.
"""

from __future__ import annotations

from collections.abc import Iterable

from robocomp_dsl.check.codes import connections as codes
from robocomp_dsl.diagnostics import Note, Report
from robocomp_dsl.model.deployment import Connection, External
from robocomp_dsl.model.interface_shape import InterfaceShapes
from robocomp_dsl.runtime.data.shape_difference import describe_difference


def check_interface_versions(connections: Iterable[Connection], report: Report) -> None:
    """Report each pair of versions once, at the first connection that has it."""
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
        seen.add(key)
        shapes = shapes or InterfaceShapes()
        _compare(connection, shapes, report)


def _compare(connection: Connection, shapes: InterfaceShapes, report: Report) -> None:
    source, target = connection.source, connection.target
    here, there = (
        shapes.of(port.interface) for port in (connection.source_port, connection.target_port)
    )
    for name, shape in here.items():
        if shape == there.get(name):
            continue
        interface = connection.source_port.interface
        difference = f"`{target.component.name}` does not have this operation"
        if name in there:
            difference = describe_difference(shape, there[name]).replace(
                " there", f" in `{target.component.name}`"
            )
        operation = next(o for o in interface.operations if o.name == name)
        other = connection.target_port.interface
        place = next((o.span for o in other.operations if o.name == name), other.span)
        report.add(
            codes.INTERFACE_VERSIONS,
            connection.span,
            f"`{source.name}` and `{target.name}` have different versions of"
            f" `{interface.qualified}`",
            label=f"`{name}`: {difference}",
            notes=[
                Note(operation.span, f"the version of `{source.component.name}`"),
                Note(place, f"the version of `{target.component.name}`"),
            ],
            help="import the same file in both, and generate both components again",
        )
        return
