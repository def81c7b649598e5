"""Decides whether and when an exited process is restarted. Pure.

In: the restart policy, the times of earlier restarts, how the process exited. Out: a
`RestartDecision`. The delay doubles with every restart within the window of the policy (exponential
back-off).
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

from robocomp_dsl.model.deployment import Restart

FIRST_DELAY_S = 0.1
MAX_DELAY_S = 10.0


@dataclass(frozen=True, slots=True)
class RestartDecision:
    """Restart after `delay_s` seconds; None: do not restart, because of `reason`."""

    delay_s: float | None
    reason: str = ""


def decide_restart(
    policy: Restart, restarts: Sequence[float], now: float, *, failed: bool
) -> RestartDecision:
    """The decision for a process that exited at `now`; `restarts` are the times of earlier ones."""
    if policy.policy == "on-failure" and not failed:
        return RestartDecision(None, "exited successfully")
    if policy.policy not in ("always", "on-failure"):
        return RestartDecision(None, "its restart policy is `never`")
    recent = sum(1 for restarted in restarts if now - restarted < policy.window_s)
    if recent >= policy.max:
        limit = f"restart limit reached: {recent} in {policy.window_s:g} s"
        return RestartDecision(None, limit)
    return RestartDecision(min(FIRST_DELAY_S * 2.0 ** min(recent, 30), MAX_DELAY_S))
