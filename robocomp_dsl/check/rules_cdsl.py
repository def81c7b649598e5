"""What a component may not do although everything it names exists.

In: a resolved component and its tree. Out: findings.
"""

from __future__ import annotations

from robocomp_dsl.check import codes
from robocomp_dsl.check.literals import listing
from robocomp_dsl.check.resolve_cdsl import Resolved
from robocomp_dsl.diagnostics import Note, Report
from robocomp_dsl.model.component import Port
from robocomp_dsl.model.interface import Operation, Pattern
from robocomp_dsl.syntax import ast_cdsl as ast


def judge_cdsl(tree: ast.Component, resolved: Resolved, report: Report) -> None:
    """Report everything that is wrong with a component."""
    for written, port in resolved.pairs:
        if port.role.is_topic:
            _judge_topic(written, port, report)
        else:
            _judge_service(written, port, report)
    if tree.gui:
        report.add(
            codes.NO_GUI,
            tree.gui.span,
            "no code is generated for a user interface",
            help="remove it, or keep it for the older tool",
        )


def _judge_topic(written: ast.Port, port: Port, report: Report) -> None:
    """What is published travels one way: the publisher gets no answer."""
    back = [o for o in port.interface.operations if port.pattern(o) is Pattern.QUERY]
    if back:
        report.add(
            codes.TOPIC_WITH_OUTPUT,
            written.interface.span,
            f"`{port.interface.name}` cannot be a topic: {_operations(back)} {_gives(back)} back",
            notes=[Note(one.span, f"`{one.name}` is declared here") for one in back],
            help=_other_role(port),
        )
    commands = [o for o in port.interface.operations if port.pattern(o) is Pattern.COMMAND]
    if commands:
        _report_role(written, port, commands, report)


def _judge_service(written: ast.Port, port: Port, report: Report) -> None:
    """What is called goes to one component, what is published to all that listen."""
    published = [o for o in port.interface.operations if port.pattern(o) is Pattern.PUBLISH]
    if published:
        _report_role(written, port, published, report)


def _report_role(
    written: ast.Port, port: Port, operations: list[Operation], report: Report
) -> None:
    report.add(
        codes.PATTERN_AND_ROLE,
        written.interface.span,
        f"{_operations(operations)} of `{port.interface.name}` cannot be used by `{port.role}`",
        notes=[Note(one.span, f"marked `[{one.pattern}]` here") for one in operations],
        help=_other_role(port),
    )


def _other_role(port: Port) -> str:
    roles = {
        "publishes": "require the interface, or declare the topic in one of its own",
        "subscribesTo": "implement the interface, or declare the topic in one of its own",
        "requires": "subscribe to the interface",
        "implements": "publish the interface",
    }
    return roles[port.role]


def _operations(operations: list[Operation]) -> str:
    return listing([one.name for one in operations], most=3)


def _gives(operations: list[Operation]) -> str:
    return "gives something" if len(operations) == 1 else "give something"
