"""The truncated cone that models a limb's skin (equations 3 and 4 of Ma and Dahl, 2016).

In: positions along the limb and angles around it. Out: Cartesian points and normals in the limb
frame: origin on the proximal joint, x along the limb, theta = 0 at +z. Metres and radians.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from robocomp_dsl.tactile.arrays import Floats


@dataclass(frozen=True, slots=True)
class Cone:
    """The surface between x0 and x1; its radius is linear from r0 to r1."""

    x0: float
    x1: float
    r0: float
    r1: float

    def __post_init__(self) -> None:
        if not self.x0 < self.x1:
            raise ValueError("a cone must end after its start: x0 < x1")
        if min(self.r0, self.r1) <= 0.0:
            raise ValueError("the radii of a cone must be positive")

    @property
    def slope(self) -> float:
        """Growth of the radius per metre along the limb."""
        return (self.r1 - self.r0) / (self.x1 - self.x0)

    @property
    def length(self) -> float:
        """Extent along the limb."""
        return self.x1 - self.x0

    def radius(self, x: Floats | float) -> Floats:
        """Distance of the surface from the axis at x (equation 4); not clipped to the ends."""
        return np.asarray(self.r0 + self.slope * (np.asarray(x) - self.x0))

    def points(self, x: Floats | float, theta: Floats | float) -> Floats:
        """Points on the surface, shape (..., 3): (x, rho sin theta, rho cos theta)."""
        return cartesian(x, theta, self.radius(x))

    def normals(self, theta: Floats | float) -> Floats:
        """Outward unit normals of the surface at the angles theta, shape (..., 3)."""
        angle = np.asarray(theta, float)
        length = np.hypot(1.0, self.slope)
        along = np.full(angle.shape, -self.slope / length)
        return np.stack((along, np.sin(angle) / length, np.cos(angle) / length), axis=-1)


def cartesian(x: Floats | float, theta: Floats | float, rho: Floats | float) -> Floats:
    """Taxel coordinates (x, theta, rho) as points (..., 3) of the limb frame (equation 6)."""
    along, angle, out = np.broadcast_arrays(
        np.asarray(x, float), np.asarray(theta, float), np.asarray(rho, float)
    )
    return np.stack((along, out * np.sin(angle), out * np.cos(angle)), axis=-1)


def cylindrical(points: Floats) -> tuple[Floats, Floats, Floats]:
    """Points (..., 3) of the limb frame as x, theta in (-pi, pi] and rho (equation 3)."""
    x, y, z = np.moveaxis(np.asarray(points, float), -1, 0)
    return x, np.arctan2(y, z), np.hypot(y, z)
