"""`restart` and `ready` of a deployment.

In: the tree nodes. Out: values with their defaults, and diagnostics.
"""

from __future__ import annotations

from robocomp_dsl.check.codes import deployment as codes
from robocomp_dsl.diagnostics import Report
from robocomp_dsl.model.deployment import START_TIMEOUT_S, Restart
from robocomp_dsl.syntax.ast import ddsl as ast
from robocomp_dsl.syntax.ast.base import Duration, Number

POLICIES = ("on-failure", "always", "never")
_DEFAULT = Restart()
_LONGEST_S = 24 * 60 * 60.0
_MOST = 1_000_000


def restart_of(written: ast.Restart | None, report: Report) -> Restart:
    """The restart policy of a process."""
    if written is None:
        return _DEFAULT
    known = written.policy.text.lower() in POLICIES  # the builder reported unknown ones
    policy = written.policy.text.lower() if known else _DEFAULT.policy
    most = count_of(written.max, "max", _DEFAULT.max, report)
    return Restart(policy, most, seconds_of(written.window, "in", _DEFAULT.window_s, report))


def ready_of(written: Duration | None, report: Report) -> float:
    """Seconds within which a component must be ready."""
    return seconds_of(written, "ready within", START_TIMEOUT_S, report)


def count_of(written: Number | None, what: str, default: int, report: Report) -> int:
    """A whole number from 1, or the default."""
    if written is None:
        return default
    if isinstance(written.value, int) and 1 <= written.value <= _MOST:
        return written.value
    found = f"`{what}` is a whole number from 1 to {_MOST}, not `{written.span.text}`"
    report.add(codes.DEPLOYMENT_NUMBER, written.span, found)
    return default


def seconds_of(written: Duration | None, what: str, default: float, report: Report) -> float:
    """A duration above zero, in seconds, or the default."""
    if written is None:
        return default
    if 0 < written.seconds <= _LONGEST_S:
        return written.seconds
    found = f"`{what}` is a duration above 0 and up to a day, not `{written.span.text}`"
    report.add(codes.DEPLOYMENT_NUMBER, written.span, found)
    return default
