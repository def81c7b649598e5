"""By which clock a deployment lives.

In: `clock …;` and the instances. Out: the clock with its source, and findings. The source of
simulated time is the one component that publishes `RoboCompClock::Clock`, or which of them `from`
names.
"""

from __future__ import annotations

from collections.abc import Sequence

from robocomp_dsl.check import codes
from robocomp_dsl.check.imports import replace
from robocomp_dsl.check.literals import listing
from robocomp_dsl.check.scopes import JOINT
from robocomp_dsl.diagnostics import Note, Report, nearest
from robocomp_dsl.model.component import Port, Role
from robocomp_dsl.model.deployment import Clock, Instance
from robocomp_dsl.syntax import ast_ddsl as ast
from robocomp_dsl.syntax.ast_base import Name

KINDS = ("wall", "sim")
LOST = ("drop", "stop")
INTERFACE = "RoboCompClock::Clock"
LIMIT_S = 10.0
SHORTEST_S, LONGEST_S = 0.001, 86400.0


def clock_of(
    tree: ast.Clock | None, instances: Sequence[Instance], *, whole: bool, report: Report
) -> Clock:
    """The clock; that of the machine where nothing is written or nothing could make the time.

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
    source = _source(tree, instances, report, whole=whole)
    if source is not None and source.component.period == 0:
        report.add(
            codes.CLOCK_SOURCE_PERIOD,
            (tree.source or tree.kind).span,
            f"`{source.name}` makes the time, but has no period by which it could go on",
            notes=[Note(source.component.span, f"`{source.component.name}` is declared here")],
            help="give it one in its CDSL file: `period 10;`",
        )
    return Clock("sim", source, step is not None, limit, stops, tree.span)


def _no_source(tree: ast.Clock, report: Report) -> None:
    for one, what in ((tree.source, "source"), (tree.lockstep, "lock-step")):
        if one is not None:
            report.add(
                codes.CLOCK,
                one.span,
                f"the clock of the machine has no {what}",
                help="write `clock wall;`, or `clock sim`",
            )


def _lockstep(tree: ast.LockStep | None, report: Report) -> tuple[float, bool]:
    """The limit in s, and whether the source stops when it loses one."""
    limit, stops = LIMIT_S, False
    if tree is None:
        return limit, stops
    if tree.limit is not None:
        if SHORTEST_S <= tree.limit.seconds <= LONGEST_S:
            limit = tree.limit.seconds
        else:
            said = f"{tree.limit.span.text} is no time that a step may need"
            report.add(codes.CLOCK, tree.limit.span, said, help="it is from 1 ms to a day")
    if tree.lost is not None and _is_one_of(tree.lost, LOST, "way to go on", report):
        stops = tree.lost.text.lower() == "stop"
    return limit, stops


def _is_one_of(word: Name, known: Sequence[str], what: str, report: Report) -> bool:
    if word.text.lower() in known:
        return True
    guess = nearest(word.text, known)
    report.add(
        codes.CLOCK,
        word.span,
        f"there is no {what} `{word.text}`",
        label=f"did you mean `{guess}`?" if guess else "",
        help=f"it is one of {listing(known)}",
        fix=replace(word.span, guess) if guess else None,
    )
    return False


def _source(
    tree: ast.Clock, instances: Sequence[Instance], report: Report, *, whole: bool
) -> Instance | None:
    able = [one for one in instances if _clock_port(one)]
    if tree.source is not None:
        return _named(tree.source, instances, able, report, whole=whole)
    if len(able) == 1:
        return able[0]
    if able:
        names = [one.name for one in able]
        report.add(
            codes.CLOCK_SOURCE,
            tree.span,
            f"several components could make the time: {listing(names)}",
            notes=[Note(one.span, f"`{one.name}` publishes `Clock`") for one in able[:4]],
            help=f"say which one: `clock sim from {names[0]};`",
        )
    elif whole:
        report.add(
            codes.CLOCK_SOURCE,
            tree.span,
            "no component here makes the time: none publishes `Clock`",
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
    known = {one.name: one for one in instances}
    # One in a group is called by its own name.
    inside = [one for one in able if one.name.rpartition(JOINT)[2] == name.text]
    found = known.get(name.text) or (inside[0] if len(inside) == 1 else None)
    if found is None:
        if whole:
            _report_unknown(name, list(known), report)
        return None
    if found not in able and whole:
        names = [one.name for one in able]
        report.add(
            codes.CLOCK_SOURCE,
            name.span,
            f"`{name.text}` cannot make the time: it does not publish `Clock`",
            notes=[Note(found.component.span, f"`{found.component.name}` is declared here")],
            help=f"{listing(names)} can"
            if names
            else 'let it: `import "Clock.idsl";` and `publishes Clock` in its CDSL file',
            fix=replace(name.span, names[0]) if len(names) == 1 else None,
        )
    return found if found in able else None


def _report_unknown(name: Name, known: Sequence[str], report: Report) -> None:
    guess = nearest(name.text, known)
    report.add(
        codes.UNKNOWN_INSTANCE,
        name.span,
        f"there is no component `{name.text}` in this deployment",
        label=f"did you mean `{guess}`?" if guess else "",
        help="" if guess else f"there are {listing(known) or 'none'}",
        fix=replace(name.span, guess) if guess else None,
    )


def _clock_port(one: Instance) -> Port | None:
    ports = one.component.with_role(Role.PUBLISHES)
    return next((port for port in ports if port.interface.qualified == INTERFACE), None)
