"""Between RoboComp's frame and MuJoCo's.

RoboComp: mm, x right, y up, z ahead (left-handed; angles turn accordingly). MuJoCo: m, z up,
right-handed. Ours puts MuJoCo's x to the right and its y ahead, so that the two frames differ by
an exchange of y and z, and a heading changes its sign.
"""

from __future__ import annotations

import math
from typing import Any

import numpy as np
from numpy.typing import NDArray

from robocomp_dsl.hardware.planar import Pose, wrapped

MM = 1e-3


def point(x: float, y: float, z: float) -> list[float]:
    """A point of RoboComp's (mm) in MuJoCo's frame (m)."""
    return [x * MM, z * MM, y * MM]


def heading(alpha: float) -> list[float]:
    """The quaternion (w, x, y, z) of a body that stands upright and heads to `alpha`."""
    return [math.cos(alpha / 2), 0.0, 0.0, -math.sin(alpha / 2)]


def pose(position: NDArray[Any], rotation: NDArray[Any]) -> Pose:
    """Where a body of MuJoCo (position (3,) in m, rotation matrix (9,)) stands on the floor."""
    ahead_x, ahead_y = float(rotation[1]), float(rotation[4])  # the body's y axis in the world
    return Pose(
        float(position[0]) / MM, float(position[1]) / MM, wrapped(math.atan2(ahead_x, ahead_y))
    )


def floor(points: NDArray[np.float64]) -> NDArray[np.float64]:
    """Points of MuJoCo, shape (n, 3) in m, as (x, z) in mm, shape (n, 2)."""
    return points[:, :2] / MM
