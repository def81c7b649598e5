"""The rules for a resolved component.

In: a resolved component and its tree. Out: diagnostics.
"""

from __future__ import annotations

from robocomp_dsl.check.cdsl.resolve import ResolvedComponent
from robocomp_dsl.check.codes import types as type_codes
from robocomp_dsl.check.literals import join_names
from robocomp_dsl.diagnostics import Note, Report
from robocomp_dsl.model.component import Port
from robocomp_dsl.model.interface import Operation, Pattern
from robocomp_dsl.syntax.ast import cdsl as ast


def check_cdsl_rules(resolved: ResolvedComponent, report: Report) -> None:
    """Check the rules of a component; a service has no published operations."""
    published: dict[int, list[Operation]] = {}
    for written, port in resolved.pairs:
        if port.role.is_topic:
            _check_topic(written, port, report)
            continue
        interface = port.interface
        if id(interface) not in published:
            published[id(interface)] = [
                o for o in interface.operations if port.pattern(o) is Pattern.PUBLISH
            ]
        if published[id(interface)]:
            _report_role(written, port, published[id(interface)], report)


def _check_topic(written: ast.Port, port: Port, report: Report) -> None:
    """Report queries and commands in a topic: publishers get no reply, so it has no queries."""
    queries = [o for o in port.interface.operations if port.pattern(o) is Pattern.QUERY]
    if queries:
        report.add(
            type_codes.TOPIC_WITH_OUTPUT,
            written.interface.span,
            f"{_operations(queries)} of `{port.interface.name}` {_gives(queries)}: not part of the"
            " topic",
            label="" if port.operations else "nothing of it can be published",
            notes=[
                Note(operation.span, f"`{operation.name}` is declared here")
                for operation in queries
            ],
            help=_other_role(port),
        )
    commands = [o for o in port.interface.operations if port.pattern(o) is Pattern.COMMAND]
    if commands:
        _report_role(written, port, commands, report)


def _report_role(
    written: ast.Port, port: Port, operations: list[Operation], report: Report
) -> None:
    report.add(
        type_codes.PATTERN_AND_ROLE,
        written.interface.span,
        f"{_operations(operations)} of `{port.interface.name}` cannot be used by `{port.role}`",
        notes=[
            Note(operation.span, f"marked `[{operation.pattern}]` here") for operation in operations
        ],
        help=_other_role(port),
    )


def _other_role(port: Port) -> str:
    roles = {
        "publishes": "require the interface, or move the topic to another interface",
        "subscribesTo": "implement the interface, or move the topic to another interface",
        "requires": "subscribe to the interface",
        "implements": "publish the interface",
    }
    return roles[port.role]


def _operations(operations: list[Operation]) -> str:
    return join_names([operation.name for operation in operations], most=3)


def _gives(operations: list[Operation]) -> str:
    return "returns something" if len(operations) == 1 else "return something"
