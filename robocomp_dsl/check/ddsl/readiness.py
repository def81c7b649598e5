"""`ready when`, `ready after`, and the limits `memory`, `cpu`, `cores`, `realtime priority`.

In: the tree nodes. Out: values, and diagnostics.
"""

from __future__ import annotations

import re
from collections.abc import Sequence

from robocomp_dsl.check.codes import deployment as codes
from robocomp_dsl.check.ddsl.restarts import seconds_of
from robocomp_dsl.diagnostics import Report
from robocomp_dsl.model.deployment import Readiness, ResourceLimits
from robocomp_dsl.syntax.ast import ddsl as ast
from robocomp_dsl.syntax.ast.base import Number, Text

MEMORY_UNITS = {"kb": 1e3, "mb": 1e6, "gb": 1e9, "kib": 2**10, "mib": 2**20, "gib": 2**30}
_LAST_PORT = 65535
_MIN_BYTES, _MAX_BYTES = 1e6, 1e15
_MAX_CPU_PERCENT = 100_000
_LAST_CORE = 1023
_MAX_REALTIME = 99
"""The highest priority of SCHED_FIFO (sched(7))."""


def readiness_of(written: ast.ReadyWhen | None, report: Report) -> Readiness:
    """When the program of an instance is ready."""
    if written is None:
        return Readiness()
    return Readiness(
        _pattern_of(written.pattern, report),
        port_of(written.port, report),
        seconds_of(written.delay, "ready after", 0.0, report),
    )


def limits_of(tree: ast.Instance | ast.Group, report: Report) -> ResourceLimits:
    """The limits of an instance or a group."""
    return ResourceLimits(
        _memory_of(tree.memory, report),
        _cpu_of(tree.cpu, report),
        _cores_of(tree.cores, report),
        _realtime_of(tree.realtime, report),
    )


def _pattern_of(written: Text | None, report: Report) -> str:
    if written is None:
        return ""
    try:
        re.compile(written.value)
        problem = "" if written.value else "it is empty"
    except re.error as error:
        problem = str(error)
    if problem:
        what = f"invalid regular expression: {problem}"
        report.add(codes.READY_PATTERN, written.span, what, help="for example `listening on`")
        return ""
    return written.value


def port_of(written: Number | None, report: Report, help: str = "") -> int:
    """A TCP port; 0 without one."""
    if written is None:
        return 0
    if isinstance(written.value, int) and 1 <= written.value <= _LAST_PORT:
        return written.value
    what = f"a port is a whole number from 1 to {_LAST_PORT}, not `{written.span.text}`"
    report.add(codes.PORT_NUMBER, written.span, what, help=help)
    return 0


def _memory_of(written: ast.Memory | None, report: Report) -> int:
    if written is None or written.unit.text.lower() not in MEMORY_UNITS:
        return 0
    amount = written.amount.value * MEMORY_UNITS[written.unit.text.lower()]
    if _MIN_BYTES <= amount <= _MAX_BYTES:
        return round(amount)
    found = f"`memory` is at least 1 MB, not `{written.amount.span.text} {written.unit.text}`"
    report.add(codes.DEPLOYMENT_NUMBER, written.amount.span, found)
    return 0


def _cpu_of(written: Number | None, report: Report) -> float:
    if written is None:
        return 0.0
    if 0 < written.value <= _MAX_CPU_PERCENT:
        return written.value / 100
    found = f"`cpu` is a share of one core above 0 %, not `{written.span.text} %`"
    report.add(codes.DEPLOYMENT_NUMBER, written.span, found)
    return 0.0


def _cores_of(written: Sequence[ast.CoreRange], report: Report) -> tuple[int, ...]:
    cores: set[int] = set()
    for each in written:
        first, last = each.first.value, each.last.value if each.last else each.first.value
        if (
            isinstance(first, int)
            and isinstance(last, int)
            and 0 <= first <= last <= _LAST_CORE
            and not each.first.span.text.startswith(("+", "-"))
        ):
            cores.update(range(first, last + 1))
        else:
            found = f"`{each.span.text}` is no CPU core; cores are counted from 0"
            right = "a range is written with the lower number first: `cores 0, 2-3;`"
            report.add(codes.DEPLOYMENT_NUMBER, each.span, found, help=right)
    return tuple(sorted(cores))


def _realtime_of(written: Number | None, report: Report) -> int:
    if written is None:
        return 0
    if isinstance(written.value, int) and 1 <= written.value <= _MAX_REALTIME:
        return written.value
    found = f"`realtime priority` is a whole number from 1 to {_MAX_REALTIME}"
    report.add(codes.DEPLOYMENT_NUMBER, written.span, f"{found}, not `{written.span.text}`")
    return 0
