"""Heartbeats of skin and arm: when each was last received, and since when both are healthy.

In: times of the component's clock in s, time-outs in s. Out: a message that says what is missing.
"""

from __future__ import annotations

from dataclasses import dataclass
from math import inf


@dataclass(slots=True)
class Heartbeats:
    """Times of the last valid `frame` and `arm` state; `fault`: of an invalid frame since then."""

    frame: float = -inf
    arm: float = -inf
    fault: str = ""
    healthy_since: float = inf

    def on_frame(self, now: float) -> None:
        """Record a valid frame."""
        self.frame, self.fault = now, ""

    def is_blind(self, now: float, timeout: float) -> bool:
        """Whether no valid frame was received for `timeout` s."""
        return not now - self.frame <= timeout

    def is_silent(self, now: float, timeout: float) -> bool:
        """Whether no valid state of the arm was received for `timeout` s."""
        return not now - self.arm <= timeout

    def missing(self, now: float, frame_timeout: float, arm_timeout: float) -> str:
        """The missing part, the arm first because it can do harm; empty if nothing is missing."""
        if self.is_silent(now, arm_timeout):
            return f"no state of the arm received for {arm_timeout:g} s"
        if self.is_blind(now, frame_timeout):
            why = f"; the last frame was rejected: {self.fault}" if self.fault else ""
            return f"no valid frame of the skin received for {frame_timeout:g} s{why}"
        return ""

    def healthy_for(self, now: float) -> float:
        """How long both have been healthy, in s; call it in every healthy cycle."""
        self.healthy_since = min(self.healthy_since, now)
        return now - self.healthy_since
