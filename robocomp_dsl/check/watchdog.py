"""`watchdog` of a component or of an instance.

In: the tree node. Out: seconds, and a diagnostic if they are out of range.
"""

from __future__ import annotations

from robocomp_dsl.diagnostics import Code, Report
from robocomp_dsl.syntax.ast.base import Duration

SHORTEST_S = 0.1
"""A shorter time could be exceeded by a thread that merely waits for a processor."""
LONGEST_S = 24 * 60 * 60.0


def watchdog_of(written: Duration | None, code: Code, report: Report) -> float | None:
    """Seconds after which a callback hangs; 0: no watchdog, None: not specified or not valid."""
    if written is None:
        return None
    if written.seconds == 0 or SHORTEST_S <= written.seconds <= LONGEST_S:
        return float(written.seconds)
    report.add(
        code,
        written.span,
        f"`watchdog` is a duration from 100 ms to a day, not `{written.span.text}`",
        help="without a watchdog: `watchdog 0 s;`",
    )
    return None
