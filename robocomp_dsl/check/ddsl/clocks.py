"""Resolves the clock of a deployment.

In: `clock …;` and the instances. Out: the clock with its source, and diagnostics. The source of
simulated time is the component that publishes `RoboCompClock::Clock`, or the one named by `from`.
"""

from __future__ import annotations

from collections.abc import Sequence

from robocomp_dsl.check.codes import clock as clock_codes
from robocomp_dsl.check.codes import deployment as deployment_codes
from robocomp_dsl.check.ddsl.scopes import NAME_SEPARATOR
from robocomp_dsl.check.literals import join_names
from robocomp_dsl.check.names.unknown_names import report_unknown_name
from robocomp_dsl.check.workspace.imports import replace_fix
from robocomp_dsl.diagnostics import Note, Report, nearest
from robocomp_dsl.model.component import Port, Role
from robocomp_dsl.model.deployment import Clock, Instance
from robocomp_dsl.syntax.ast import ddsl as ast
from robocomp_dsl.syntax.ast.base import Name

KINDS = ("wall", "sim")
TIMEOUT_POLICIES = ("drop", "stop")
INTERFACE = "RoboCompClock::Clock"
DEFAULT_LIMIT_S = 10.0
SHORTEST_S, LONGEST_S = 0.001, 86400.0


def resolve_clock(
    tree: ast.Clock | None, instances: Sequence[Instance], *, complete: bool, report: Report
) -> Clock:
    """The clock; the wall clock if none is written or there is no clock source.

    `whole` False: something of the deployment is not known; a missing source is then not missed.
    """
    if tree is None or not _is_one_of(tree.kind, KINDS, "clock", report):
        return Clock()
    simulated = tree.kind.text.lower() == "sim"
    if not simulated:
        _no_source(tree, report)
        return Clock(span=tree.span)
    step = tree.lockstep
    limit, stops = _lockstep(step, report)
    source = _source(tree, instances, report, whole=complete)
    if source is not None and source.component.period == 0:
        report.add(
            clock_codes.CLOCK_SOURCE_PERIOD,
            (tree.source or tree.kind).span,
            f"`{source.name}` is the clock source but has no period",
            notes=[Note(source.component.span, f"`{source.component.name}` is declared here")],
            help="set it in its CDSL file: `period 10;`",
        )
    return Clock("sim", source, step is not None, limit, stops, tree.span)


def _no_source(tree: ast.Clock, report: Report) -> None:
    for node, what in ((tree.source, "source"), (tree.lockstep, "lock-step")):
        if node is not None:
            report.add(
                clock_codes.INVALID_CLOCK,
                node.span,
                f"the wall clock has no {what}",
                help="write `clock wall;`, or `clock sim`",
            )


def _lockstep(tree: ast.LockStep | None, report: Report) -> tuple[float, bool]:
    """The step limit in s, and whether the deployment stops when a component times out."""
    limit, stops = DEFAULT_LIMIT_S, False
    if tree is None:
        return limit, stops
    if tree.limit is not None:
        if SHORTEST_S <= tree.limit.seconds <= LONGEST_S:
            limit = tree.limit.seconds
        else:
            message = f"{tree.limit.span.text} is not a valid step limit"
            report.add(
                clock_codes.INVALID_CLOCK,
                tree.limit.span,
                message,
                help="a step limit is from 1 ms to a day",
            )
    if tree.lost is not None and _is_one_of(
        tree.lost, TIMEOUT_POLICIES, "policy after a time-out", report
    ):
        stops = tree.lost.text.lower() == "stop"
    return limit, stops


def _is_one_of(word: Name, known: Sequence[str], what: str, report: Report) -> bool:
    if word.text.lower() in known:
        return True
    guess = nearest(word.text, known)
    report.add(
        clock_codes.INVALID_CLOCK,
        word.span,
        f"there is no {what} `{word.text}`",
        label=f"did you mean `{guess}`?" if guess else "",
        help=f"it is one of {join_names(known)}",
        fix=replace_fix(word.span, guess) if guess else None,
    )
    return False


def _source(
    tree: ast.Clock, instances: Sequence[Instance], report: Report, *, whole: bool
) -> Instance | None:
    able = [instance for instance in instances if _clock_port(instance)]
    if tree.source is not None:
        return _named(tree.source, instances, able, report, whole=whole)
    if len(able) == 1:
        return able[0]
    if able:
        names = [instance.name for instance in able]
        report.add(
            clock_codes.CLOCK_SOURCE,
            tree.span,
            f"several components can be the clock source: {join_names(names)}",
            notes=[
                Note(instance.span, f"`{instance.name}` publishes `Clock`") for instance in able[:4]
            ],
            help=f"name one: `clock sim from {names[0]};`",
        )
    elif whole:
        report.add(
            clock_codes.CLOCK_SOURCE,
            tree.span,
            "no clock source: no component in this deployment publishes `Clock`",
            help="add a simulator that publishes `Clock` (of Clock.idsl), or write `clock wall;`",
        )
    return None


def _named(
    name: Name,
    instances: Sequence[Instance],
    able: Sequence[Instance],
    report: Report,
    *,
    whole: bool,
) -> Instance | None:
    known = {instance.name: instance for instance in instances}
    # `from` may name an instance in a group without its group.
    inside = [
        instance for instance in able if instance.name.rpartition(NAME_SEPARATOR)[2] == name.text
    ]
    match = known.get(name.text) or (inside[0] if len(inside) == 1 else None)
    if match is None:
        if whole:
            _report_unknown(name, instances, report)
        return None
    if match not in able and whole:
        names = [instance.name for instance in able]
        report.add(
            clock_codes.CLOCK_SOURCE,
            name.span,
            f"`{name.text}` cannot be the clock source: it does not publish `Clock`",
            notes=[Note(match.component.span, f"`{match.component.name}` is declared here")],
            help=f"{join_names(names)} can"
            if names
            else 'add `import "Clock.idsl";` and `publishes Clock` to its CDSL file',
            fix=replace_fix(name.span, names[0]) if len(names) == 1 else None,
        )
    return match if match in able else None


def _report_unknown(name: Name, instances: Sequence[Instance], report: Report) -> None:
    known = [instance.name for instance in instances]
    report_unknown_name(
        report,
        deployment_codes.UNKNOWN_INSTANCE,
        name,
        f"there is no component `{name.text}` in this deployment",
        known,
        f"there are {join_names(known) or 'none'}",
        declared=[instance.span for instance in instances],
    )


def _clock_port(instance: Instance) -> Port | None:
    ports = instance.component.with_role(Role.PUBLISHES)
    return next((port for port in ports if port.interface.qualified == INTERFACE), None)
