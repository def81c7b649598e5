"""Pauses before the arm returns: they grow while an obstacle stays in its way.

In: touches, the times at which the arm has returned. Out: the pause in s.
"""

from __future__ import annotations

from dataclasses import dataclass
from math import inf

SAME_OBSTACLE_S = 0.25
"""A touch so soon after the return is by the same obstacle: the arm still moves a little."""
SHORTEST_S = 0.25
"""The pause that is doubled, if `hold` is shorter."""
GAP_S = 0.1
"""A touch that pauses for longer is a new one."""
_MOST = 30
"""2 to this power exceeds every pause."""


@dataclass(slots=True)
class ObstacleMonitor:
    """`attempts` of the arm to return that an obstacle has ended; `returned`: time of arrival.

    `stays`: the current touch began during the return or right after it; `counted`: it has caused a
    withdrawal.
    """

    attempts: int = 0
    returned: float = -inf
    touched: float = -inf
    stays: bool = False
    counted: bool = False

    def on_touch(self, now: float, *, is_returning: bool) -> None:
        """Record a response to a frame."""
        if now - self.touched > GAP_S:
            self.stays = is_returning or now - self.returned < SAME_OBSTACLE_S
            self.counted = False
        self.touched = now

    def on_withdrawal(self) -> bool:
        """Record a withdrawal; returns whether an obstacle has stayed, once for each touch."""
        if self.counted:
            return False
        self.counted = True
        self.attempts = min(self.attempts + 1, _MOST) if self.stays else 0
        return self.stays

    def pause(self, hold: float, longest: float) -> float:
        """The time [s] without a touch after which the arm returns."""
        if not self.attempts:
            return hold
        return max(hold, min(max(hold, SHORTEST_S) * 2.0**self.attempts, longest))
