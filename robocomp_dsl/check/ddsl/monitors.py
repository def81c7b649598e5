"""Resolves the monitors of a connection, and checks their classes without running them.

In: the tree of a connection and the interface of its ports. Out: `Monitor` values, diagnostics, and
the events that the classes set.
"""

from __future__ import annotations

from collections.abc import Mapping
from typing import TYPE_CHECKING

from robocomp_dsl.check.codes import connections as codes
from robocomp_dsl.check.names.duplicates import unique_by_name
from robocomp_dsl.check.workspace.referenced_files import find_referenced_file
from robocomp_dsl.check.workspace.workspace import Workspace
from robocomp_dsl.diagnostics import Note, Report
from robocomp_dsl.model import types
from robocomp_dsl.model.component import Port
from robocomp_dsl.model.deployment import Monitor
from robocomp_dsl.model.interface import Interface
from robocomp_dsl.record import Record
from robocomp_dsl.source import Source, Span, UnreadableSource
from robocomp_dsl.syntax.ast import ddsl as ast
from robocomp_dsl.syntax.ast.base import Bool, Literal, Name, Number
from robocomp_dsl.syntax.languages.ddsl_connections import FAILURE_POLICIES, POSITIONS

if TYPE_CHECKING:
    from robocomp_dsl.monitors.monitor_finding import MonitorFinding

_PYTHON_TYPES = {
    types.BOOL: "bool",
    types.BYTE: "int",
    types.SHORT: "int",
    types.INT: "int",
    types.LONG: "int",
    types.FLOAT: "float",
    types.DOUBLE: "float",
    types.STRING: "str",
}


class ConnectionContext(Record):
    """The context for resolving connections.

    `events` are the events that each monitor sets; None: they cannot be read from its code.
    """

    workspace: Workspace
    events: dict[Monitor, frozenset[str] | None]


def resolve_monitors(
    tree: ast.Connection, port: Port, context: ConnectionContext, report: Report
) -> tuple[Monitor, ...]:
    """The monitors of a connection into `port`, in order of writing."""
    found = (_monitor(monitor, port, context, report) for monitor in tree.monitors)
    return tuple(monitor for monitor in found if monitor is not None)


def _monitor(
    tree: ast.Monitor, port: Port, context: ConnectionContext, report: Report
) -> Monitor | None:
    beside = tree.file.span.source.path
    path = find_referenced_file(tree.file, (".py",), beside, context.workspace, report)
    if path is None:
        return None
    default = "receiver" if port.role.is_topic else "sender"
    arguments = unique_by_name(tree.arguments, "argument", report)
    monitor = Monitor(
        path,
        tree.class_name.text,
        tuple((argument.name.text, _value(argument.value)) for argument in arguments),
        _choice(tree.at, POSITIONS, default),
        _choice(tree.on_failure, FAILURE_POLICIES, "bypass"),
    )
    context.events[monitor] = _check_class(tree, monitor, port.interface, context, report)
    return monitor


def _choice(written: Name | None, choices: tuple[str, ...], default: str) -> str:
    """A word that the builder has checked, or the default."""
    return written.text.lower() if written and written.text.lower() in choices else default


def _value(written: Literal) -> types.Literal:
    if isinstance(written, Name):
        return written.text
    if isinstance(written, Bool | Number):
        return written.value
    return written.value


def _check_class(
    tree: ast.Monitor,
    monitor: Monitor,
    interface: Interface,
    context: ConnectionContext,
    report: Report,
) -> frozenset[str] | None:
    """Check the class of a monitor; returns the events that it sets."""
    from robocomp_dsl.monitors.class_check import check_monitor_class  # noqa: PLC0415 - few files need it
    from robocomp_dsl.monitors.monitor_finding import MonitoredOperation  # noqa: PLC0415

    try:
        source = context.workspace.sources.read(monitor.file)
    except UnreadableSource as error:
        report.add(codes.MONITOR, tree.file.span, f"cannot read `{tree.file.value}`: {error}")
        return None
    operations = tuple(
        MonitoredOperation(
            operation.name,
            tuple((p.name, _python_type(p.type)) for p in operation.inputs),
        )
        for operation in interface.operations
    )
    arguments: Mapping[str, object] = dict(monitor.arguments)
    checked = check_monitor_class(source.text, monitor.class_name, operations, arguments)
    for finding in checked.findings:
        _report_finding(finding, tree, source, report)
    return frozenset(checked.events) if checked.all_events_known else None


def _python_type(kind: types.Type) -> str:
    return _PYTHON_TYPES.get(kind, "") if isinstance(kind, types.Primitive) else ""


def _report_finding(
    finding: MonitorFinding, tree: ast.Monitor, source: Source, report: Report
) -> None:
    """Report at the argument or the name of the class if that is wrong, else in the Python file."""
    place = _python_span(finding, source)
    own: Span | None = None
    if finding.parameter:
        names = {argument.name.text: argument.span for argument in tree.arguments}
        own = names.get(finding.parameter, tree.class_name.span)
    elif place.start == place.end:
        own = tree.class_name.span
    notes = (
        [Note(tree.class_name.span, "it is a monitor of this connection")]
        if own is None
        else [Note(place, "the class is here")] * (place.start != place.end)
    )
    report.add(codes.MONITOR, own or place, finding.message, help=finding.help, notes=notes)


def _python_span(finding: MonitorFinding, source: Source) -> Span:
    start = source.span_at(finding.line, finding.column).start
    end = source.span_at(finding.end_line, finding.end_column).start
    return source.span(start, max(start, end))
