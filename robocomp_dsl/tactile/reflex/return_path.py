"""The way of a withdrawn arm back to its start pose, free of the robot's own body.

In: the poses in which withdrawals began, the current pose, the start pose. Out: the next goal of
the return. Each withdrawal was planned free of the own body; the straight way back need not be.
"""

from __future__ import annotations

from robocomp_dsl.tactile.arrays import Floats
from robocomp_dsl.tactile.reflex.pose_directions import PoseDirections

_MOST_WAYPOINTS = 100


class ReturnPath:
    """Remembers where withdrawals began; their ways lead back if the straight way is not free."""

    def __init__(self) -> None:
        self._waypoints: list[Floats] = []

    def add(self, pose: Floats) -> None:
        """A withdrawal begins, or continues, at `pose` (n,)."""
        if len(self._waypoints) < _MOST_WAYPOINTS:
            self._waypoints.append(pose)

    def clear(self) -> None:
        """The arm has returned."""
        self._waypoints.clear()

    def next_goal(
        self, pose: Floats, start: Floats, directions: PoseDirections | None
    ) -> Floats | None:
        """The goal (n,) after `pose` (n,): `start`, or the earliest waypoint with a free way to it.

        None if there is no free way. Without `directions` the arm returns to `start` directly.
        """
        if directions is None or directions.is_free(pose, start):
            return start
        for number, waypoint in enumerate(self._waypoints):
            if directions.is_free(pose, waypoint):
                del self._waypoints[number:]
                return waypoint
        return None
