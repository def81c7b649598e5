"""What the geometric checks need to know about the model of a robot.

The interface only, so that descriptions depend on no simulator. Poses and points are in the world
of the model, in metres and radians.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import Protocol

from robocomp_dsl.tactile.arrays import Floats
from robocomp_dsl.tactile.description.model import GenericPart

WORLD = "world"
"""The name of the body that carries the robot."""


@dataclass(frozen=True, slots=True, eq=False)
class JointAxis:
    """The axis of a joint in the current pose: a `point` (3,) on it and its `direction` (3,).

    A joint that does not rotate moves along its direction.
    """

    joint: str
    point: Floats
    direction: Floats
    rotates: bool = True


class PosedModel(Protocol):
    """A robot in a pose; joints that no servo of the current part moves stay at their start."""

    @property
    def up(self) -> Floats:
        """Against gravity, (3,)."""

    def set_pose(self, part: GenericPart, angles: Floats) -> None:
        """Move the joints of `part` to generic angles (n,), also beyond their limits."""

    def pose(self, name: str) -> Floats | None:
        """Pose (4, 4) of the marked point (site), else of the body `name`; None: there is none."""

    def joint(self, name: str) -> JointAxis:
        """The axis of a joint."""

    def body_of(self, joint: str) -> str:
        """The body that a joint moves."""

    def joints_above(self, body: str) -> tuple[str, ...]:
        """The joints that move `body`, the nearest first."""

    def joints_below(self, body: str) -> tuple[str, ...]:
        """The joints that `body` carries, also through other bodies."""

    def bodies_above(self, body: str) -> tuple[str, ...]:
        """The bodies that carry `body`, the nearest first; the last one is the world."""

    def centre(self, body: str) -> Floats:
        """The centre of mass (3,) of `body` and of all that it carries."""

    def rest_centre(self, body: str) -> Floats:
        """The centre of mass (3,) of the robot without `body` and all that it carries."""

    def surface_distances(self, bodies: tuple[str, ...], points: Floats) -> Floats | None:
        """Distance (n,) of points (n, 3) from the nearest shape of the bodies; negative inside.

        None if the bodies have no shapes.
        """
