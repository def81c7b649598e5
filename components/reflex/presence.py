"""Whether skin and arm are there: when they were last heard of, and since when all is well.

In: moments of the component's clock in s, timeouts. Out: what is missing, in words.
"""

from __future__ import annotations

from dataclasses import dataclass
from math import inf


@dataclass(slots=True)
class Presence:
    """`frame` and `arm`: when the last usable frame and state came; `fault` of a frame since."""

    frame: float = -inf
    arm: float = -inf
    fault: str = ""
    well_since: float = inf

    def hear_frame(self, now: float) -> None:
        """A usable frame has come."""
        self.frame, self.fault = now, ""

    def is_blind(self, now: float, timeout: float) -> bool:
        """Whether no usable frame came for `timeout` s."""
        return not now - self.frame <= timeout

    def is_silent(self, now: float, timeout: float) -> bool:
        """Whether no usable state of the arm came for `timeout` s."""
        return not now - self.arm <= timeout

    def missing(self, now: float, frame_timeout: float, arm_timeout: float) -> str:
        """What is missing, the arm first, since it can do harm; empty: nothing is."""
        if self.is_silent(now, arm_timeout):
            return f"the arm has told no state for {arm_timeout:g} s"
        if self.is_blind(now, frame_timeout):
            why = f"; of the last frame: {self.fault}" if self.fault else ""
            return f"the skin has sent no usable frame for {frame_timeout:g} s{why}"
        return ""

    def well_for(self, now: float) -> float:
        """For how long all has been well, asked whenever it is."""
        self.well_since = min(self.well_since, now)
        return now - self.well_since
