"""Resolves the quality of service of a connection.

In: the settings in its braces. Out: a `Qos`, and diagnostics.
"""

from __future__ import annotations

from robocomp_dsl.check.codes import deployment as codes
from robocomp_dsl.check.ddsl.restarts import count_of, seconds_of
from robocomp_dsl.check.literals import join_names
from robocomp_dsl.check.workspace.imports import replace_fix
from robocomp_dsl.diagnostics import Report, nearest
from robocomp_dsl.model.deployment import Qos
from robocomp_dsl.syntax.ast import ddsl as ast
from robocomp_dsl.syntax.ast.base import Name, Number

PRIORITIES = ("background", "low", "normal", "high", "realtime")
MAX_THREAD_PRIORITY = 99
"""The highest priority of SCHED_FIFO, see sched(7)."""


def qos_of(tree: ast.Qos | None, report: Report) -> Qos:
    """The quality of service in the braces of a connection."""
    if tree is None:
        return Qos()
    priority = _priority(tree.priority, report) if tree.priority else None
    liveliness = seconds_of(tree.liveliness, "liveliness", 0, report) if tree.liveliness else 0
    deadline = seconds_of(tree.deadline, "deadline", 0, report) if tree.deadline else 0
    return Qos(
        reliable=tree.reliability.text.lower() == "reliable" if tree.reliability else None,
        priority=priority,
        depth=count_of(tree.depth, "depth", 1, report) if tree.depth else None,
        deadline_ms=deadline * 1000 if deadline else None,
        keep_all=True if tree.keep_all else None,
        latched=True if tree.latched else None,
        liveliness_ms=liveliness * 1000 if liveliness else None,
        thread_priority=_thread_priority(tree.thread_priority, report),
    )


def _thread_priority(written: Number | None, report: Report) -> int | None:
    if written is None:
        return None
    value = written.value
    if isinstance(value, int) and 1 <= value <= MAX_THREAD_PRIORITY:
        return value
    report.add(
        codes.DEPLOYMENT_NUMBER,
        written.span,
        f"`thread priority` is a whole number from 1 to {MAX_THREAD_PRIORITY}, "
        f"not `{written.span.text}`",
    )
    return None


def _priority(written: Name, report: Report) -> str | None:
    if written.text.lower() in PRIORITIES:
        return written.text.lower()
    guess = nearest(written.text, PRIORITIES)
    report.add(
        codes.UNKNOWN_PRIORITY,
        written.span,
        f"unknown priority `{written.text}`",
        label=f"did you mean `{guess}`?" if guess else "",
        help=f"it is one of {join_names(PRIORITIES)}",
        fix=replace_fix(written.span, guess) if guess else None,
    )
    return None
