"""Tells contacts of a robot with itself from touches by others.

In: the kinematics of the robot and the pose. Out: whether a touch is at a place where the arm is
next to another part of the robot.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from robocomp_dsl.tactile.arm.limb_kinematics import ClosePoint, LimbKinematics
from robocomp_dsl.tactile.arrays import Floats

WITHIN = 0.008
"""Bodies of the robot that are this close count as touching each other [m]."""
RADIUS = 0.03
"""Touches up to this far from such a place are contacts of the robot with itself [m]."""


@dataclass(slots=True)
class SelfContacts:
    """Contacts of the robot with itself; `count` of touches that were recognised as such."""

    body: LimbKinematics
    count: int = 0
    _pose: Floats | None = None
    _places: tuple[ClosePoint, ...] | None = ()

    def at(self, pose: Floats) -> None:
        """Refer to this pose (n,) from now on."""
        if self._pose is not pose:
            self._pose, self._places = pose, None

    def includes(self, limb: str, centre: Floats) -> bool:
        """Whether the touch of `limb` at `centre` (3,) [m] is one of the robot with itself."""
        if self._places is None and self._pose is not None:
            self._places = tuple(self.body.close_points(self._pose, WITHIN))
        found = any(
            place.limb == limb and float(np.linalg.norm(place.point - centre)) <= RADIUS
            for place in self._places or ()
        )
        self.count += found
        return found
