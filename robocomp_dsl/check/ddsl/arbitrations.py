"""Resolves `arbitrate` of a deployment: which of several connections delivers to a port.

In: the tree nodes, the explicit connections and the events that monitors set. Out: the connections
with their conditions, those that only the arbitration names included, and diagnostics.
"""

from __future__ import annotations

import re
from collections.abc import Iterator, Mapping, Sequence
from itertools import combinations

from robocomp_dsl.check.codes import connections as codes
from robocomp_dsl.check.ddsl.connections import ExplicitConnections, add_connection
from robocomp_dsl.check.ddsl.monitors import ConnectionContext
from robocomp_dsl.check.literals import join_names
from robocomp_dsl.check.names.unknown_names import report_unknown_name
from robocomp_dsl.diagnostics import Note, Report
from robocomp_dsl.model.component import Role
from robocomp_dsl.model.deployment import Connection, Instance, Monitor
from robocomp_dsl.monitors.constraint import (
    Constraint,
    ConstraintError,
    TooManyEvents,
    find_conflict,
    parse_constraint,
)
from robocomp_dsl.syntax.ast import ddsl as ast

_COMMENT = re.compile(r"/\*.*?\*/|//[^\n]*|#[^\n]*", re.DOTALL)
_CONSTANTS = ("true", "false")
_INPUTS = (Role.SUBSCRIBES, Role.IMPLEMENTS)


def apply_arbitrations(
    trees: Sequence[ast.Arbitration],
    instances: Mapping[str, Instance],
    explicit: ExplicitConnections,
    context: ConnectionContext,
    report: Report,
) -> None:
    """Add the conditions of all arbitrations to the `explicit` connections."""
    first: dict[tuple[str, str], ast.Arbitration] = {}
    for tree in trees:
        key = (tree.target.instance.text, tree.target.port.text)
        earlier = first.setdefault(key, tree)
        if earlier is tree:
            _apply(tree, instances, explicit, context, report)
        else:
            report.add(
                codes.ARBITRATION,
                tree.target.span,
                f"`{key[0]}.{key[1]}` has two arbitrations",
                notes=[Note(earlier.target.span, "the first one is here")],
                help="put all connections into one block",
            )


def _apply(
    tree: ast.Arbitration,
    instances: Mapping[str, Instance],
    explicit: ExplicitConnections,
    context: ConnectionContext,
    report: Report,
) -> None:
    if not _is_input(tree, instances, report):
        return
    constraints: dict[int, tuple[ast.Candidate, Constraint]] = {}
    for candidate in tree.candidates:
        constraint = _constraint(candidate, report)
        connection = _connection_of(candidate, tree, instances, explicit, context, report)
        if connection is None or constraint is None:
            continue
        if connection.condition:
            report.add(
                codes.ARBITRATION,
                candidate.source.span,
                f"`{candidate.source.span.text}` has two conditions",
                help="join them with `||`",
            )
            continue
        conditional = connection.replace(condition=constraint.text)
        explicit.connections[explicit.connections.index(connection)] = conditional
        constraints[id(conditional)] = (candidate, constraint)
    into = [c for c in explicit.connections if _ends_at(c, tree)]
    for connection in into:
        if not connection.condition:
            _report_missing(connection, tree, report)
    if not tree.candidates and not into:
        report.add(
            codes.ARBITRATION,
            tree.target.span,
            "an arbitration names the connections that it chooses from",
            help="write `from component.Port when event;` for each",
        )
    _check_conflicts(list(constraints.values()), report)
    _check_events(list(constraints.values()), into, context, report)


def _is_input(tree: ast.Arbitration, instances: Mapping[str, Instance], report: Report) -> bool:
    """Whether the port exists and receives messages; reports a port of another role."""
    instance = instances.get(tree.target.instance.text)
    if instance is None:
        return False
    ports = [port for port in instance.component.ports if port.name == tree.target.port.text]
    if ports and all(port.role not in _INPUTS for port in ports):
        report.add(
            codes.ARBITRATION,
            tree.target.port.span,
            f"`{instance.name}` {ports[0].role} `{ports[0].name}`: only subscribed and implemented "
            "ports are arbitrated",
            notes=[Note(ports[0].span, "declared here")],
        )
        return False
    return True


def _constraint(candidate: ast.Candidate, report: Report) -> Constraint | None:
    span = candidate.condition.span
    try:
        constraint = parse_constraint(" ".join(_COMMENT.sub(" ", span.text).split()))
    except ConstraintError as error:
        report.add(codes.ARBITRATION, span, error.message, help=error.help)
        return None
    if not constraint.sometimes_true():
        report.add(codes.ARBITRATION, span, "this condition never holds")
    return constraint


def _connection_of(
    candidate: ast.Candidate,
    tree: ast.Arbitration,
    instances: Mapping[str, Instance],
    explicit: ExplicitConnections,
    context: ConnectionContext,
    report: Report,
) -> Connection | None:
    """The connection of a candidate, which is added if no `connect` names it."""
    source = candidate.source
    for connection in explicit.connections:
        name = (connection.source.name, connection.source_port.name)
        if name == (source.instance.text, source.port.text) and _ends_at(connection, tree):
            return connection
    written = ast.Connection(candidate.span, source, tree.target)
    return add_connection(written, instances, explicit, context, report)


def _ends_at(connection: Connection, tree: ast.Arbitration) -> bool:
    name = (connection.target.name, connection.target_port.name)
    return name == (tree.target.instance.text, tree.target.port.text)


def _report_missing(connection: Connection, tree: ast.Arbitration, report: Report) -> None:
    source = f"{connection.source.name}.{connection.source_port.name}"
    report.add(
        codes.ARBITRATION,
        tree.target.span,
        f"the arbitration says nothing of `{source}`",
        notes=[Note(connection.span, "it is connected here")],
        help=f"add `from {source} when …;`, or `when true` if it always delivers",
    )


def _check_conflicts(
    constraints: Sequence[tuple[ast.Candidate, Constraint]], report: Report
) -> None:
    """Report two conditions that hold together."""
    for (first, condition), (second, other) in combinations(constraints, 2):
        try:
            events = find_conflict(condition, other)
        except TooManyEvents as error:
            report.add(codes.ARBITRATION, second.condition.span, f"too many events: {error}")
            return
        if events is None:
            continue
        when = f"if {join_names(sorted(events))} is set" if events else "if no event is set"
        report.add(
            codes.ARBITRATION,
            second.condition.span,
            f"`{first.source.span.text}` and `{second.source.span.text}` both deliver {when}",
            notes=[Note(first.condition.span, "this condition holds, too")],
            help="add an event to one of them that excludes the other",
        )


def _check_events(
    constraints: Sequence[tuple[ast.Candidate, Constraint]],
    into: Sequence[Connection],
    context: ConnectionContext,
    report: Report,
) -> None:
    """Report events that no monitor sets."""
    sets = [context.events[monitor] for monitor in _receiving_monitors(into, context)]
    if any(events is None for events in sets):
        return
    known = sorted({event for events in sets for event in events or ()})
    reported: set[str] = set()
    for candidate, _ in constraints:
        for event in candidate.condition.events:
            if event.text in (*known, *_CONSTANTS, *reported):
                continue
            reported.add(event.text)
            report_unknown_name(
                report,
                codes.ARBITRATION,
                event,
                f"no monitor of these connections sets the event `{event.text}`",
                known,
                f"they set {join_names(known)}"
                if known
                else f'a monitor at the receiver sets it: `self.set_event("{event.text}", 0.5)`',
            )


def _receiving_monitors(
    into: Sequence[Connection], context: ConnectionContext
) -> Iterator[Monitor]:
    for connection in into:
        for monitor in connection.monitors:
            if monitor.position == "receiver" and monitor in context.events:
                yield monitor
