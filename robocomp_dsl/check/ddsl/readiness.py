"""`ready when`, `ready after`, `memory` and `cpu` of a deployment.

In: the tree nodes. Out: values, and diagnostics.
"""

from __future__ import annotations

import re

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


def readiness_of(written: ast.ReadyWhen | None, report: Report) -> Readiness:
    """When the program of an instance is ready."""
    if written is None:
        return Readiness()
    return Readiness(
        _pattern_of(written.pattern, report),
        _port_of(written.port, report),
        seconds_of(written.delay, "ready after", 0.0, report),
    )


def limits_of(tree: ast.Instance | ast.Group, report: Report) -> ResourceLimits:
    """The limits of an instance or a group."""
    return ResourceLimits(_memory_of(tree.memory, report), _cpu_of(tree.cpu, report))


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


def _port_of(written: Number | None, report: Report) -> int:
    if written is None:
        return 0
    if isinstance(written.value, int) and 1 <= written.value <= _LAST_PORT:
        return written.value
    what = f"a port is a whole number from 1 to {_LAST_PORT}, not `{written.span.text}`"
    report.add(codes.PORT_NUMBER, written.span, what)
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
