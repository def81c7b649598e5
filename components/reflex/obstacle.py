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
_MOST = 30
"""2 to this power exceeds every pause."""


@dataclass(slots=True)
class ObstacleMonitor:
    """`attempts` of the arm to return that an obstacle has ended; `returned`: time of arrival."""

    attempts: int = 0
    returned: float = -inf

    def on_withdrawal(self, now: float, *, is_returning: bool) -> bool:
        """Record the start of a withdrawal; returns whether the obstacle has stayed."""
        stays = is_returning or now - self.returned < SAME_OBSTACLE_S
        self.attempts = min(self.attempts + 1, _MOST) if stays else 0
        return stays

    def pause(self, hold: float, longest: float) -> float:
        """The time [s] without a touch after which the arm returns."""
        if not self.attempts:
            return hold
        return max(hold, min(max(hold, SHORTEST_S) * 2.0**self.attempts, longest))
