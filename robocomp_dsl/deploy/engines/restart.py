"""Whether a process that has ended is started again, and when. Pure.

In: the policy, when it was restarted before, how it ended. Out: a `Verdict`. The wait doubles with
every restart within the window of the policy, so it is short again after a quiet time.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

from robocomp_dsl.model.deployment import Restart

FIRST_WAIT_S = 0.1
LONGEST_WAIT_S = 10.0


@dataclass(frozen=True, slots=True)
class Verdict:
    """Start again after `wait_s`, or not at all (None) because of `reason`."""

    wait_s: float | None
    reason: str = ""


def judge(policy: Restart, restarts: Sequence[float], now: float, *, failed: bool) -> Verdict:
    """What to do with a process that ended at `now`; `restarts` are the times of earlier ones."""
    if policy.policy == "on-failure" and not failed:
        return Verdict(None, "it ended well")
    if policy.policy not in ("always", "on-failure"):
        return Verdict(None, "its policy is not to restart")
    recent = sum(1 for at in restarts if now - at < policy.window_s)
    if recent >= policy.max:
        times = "once" if recent == 1 else f"{recent} times"
        return Verdict(None, f"restarted {times} in {policy.window_s:g} s, that is enough")
    return Verdict(min(FIRST_WAIT_S * 2.0 ** min(recent, 30), LONGEST_WAIT_S))
