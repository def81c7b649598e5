"""What the reflex needs to know about the body of a robot: limbs in space, and their distances.

The interface only, so that the reflex depends on no simulator. `simulation.models.body_model`
implements it with the model that a tactile description names.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import Protocol

from robocomp_dsl.tactile.arrays import Floats


@dataclass(frozen=True, slots=True, eq=False)
class ClosePoint:
    """A place where a limb is close to the body `other` of the robot, or of the arm itself.

    `point` (3,) [m] is on the surface of `limb`, in its frame. `distance` [m] is negative where the
    bodies overlap.
    """

    limb: str
    point: Floats
    other: str
    distance: float


class LimbKinematics(Protocol):
    """The limbs of one generic part, as functions of its generic angles (n,) [rad]."""

    def frame(self, limb: str, angles: Floats) -> tuple[Floats, Floats]:
        """Origin (3,) [m] and axes (3, 3) of the limb's frame in the world."""

    def jacobian(self, limb: str, point: Floats, angles: Floats) -> Floats:
        """World velocity of `point` (3,) [m] of the limb per generic speed, (3, n) [m/rad]."""

    def close_points(self, angles: Floats, within: float) -> list[ClosePoint]:
        """Places of the limbs that are at most `within` [m] from another part of the robot."""

    def clearance(self, angles: Floats, within: float) -> float:
        """The smallest distance [m] of the arm to the rest of the robot, at most `within`."""
