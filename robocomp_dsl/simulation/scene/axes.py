"""Conversion between RoboComp's frame and MuJoCo's.

RoboComp: mm, x right, y up, z ahead (left-handed; angles turn accordingly). MuJoCo: m, z up,
right-handed. We choose MuJoCo's x to the right and y ahead, so the conversion exchanges y and z: a
mirror, which maps rotations to rotations in the opposite direction.
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from typing import Any

import numpy as np
from numpy.typing import NDArray

from robocomp_dsl.hardware.kinematics.planar import Pose, wrap_angle

MM = 1e-3

Array = NDArray[np.float64]

EXCHANGED = np.array([0, 2, 1, 6, 8, 7, 3, 5, 4])
"""Indices of the 9 numbers of a RoboComp rotation in a MuJoCo rotation."""


def point(x: float, y: float, z: float) -> list[float]:
    """A RoboComp point (mm) in MuJoCo's frame (m)."""
    return [x * MM, z * MM, y * MM]


def points(points: Array) -> Array:
    """As `point`, for shape (n, 3)."""
    return points[:, [0, 2, 1]] * MM


def direction(vector: Sequence[float]) -> list[float]:
    """A direction, without units."""
    return [vector[0], vector[2], vector[1]]


def turn_axis(axis: Sequence[float] | Array) -> list[float]:
    """The axis with the same rotation in MuJoCo as `axis` in RoboComp."""
    return [-float(axis[0]), -float(axis[2]), -float(axis[1])]


def quaternion(rotation: Array) -> list[float]:
    """The quaternion (w, x, y, z) of a RoboComp rotation, shape (3, 3).

    Shepperd's method: divides by the largest of the four.
    """
    m = rotation[[0, 2, 1]][:, [0, 2, 1]]
    xx, yy, zz = (float(m[i, i]) for i in range(3))
    squares = [1 + xx + yy + zz, 1 + xx - yy - zz, 1 - xx + yy - zz, 1 - xx - yy + zz]
    largest = max(range(4), key=squares.__getitem__)
    wx, wy, wz = (float(m[2, 1] - m[1, 2]), float(m[0, 2] - m[2, 0]), float(m[1, 0] - m[0, 1]))
    xy, xz, yz = (float(m[1, 0] + m[0, 1]), float(m[0, 2] + m[2, 0]), float(m[2, 1] + m[1, 2]))
    row = (
        [squares[0], wx, wy, wz],
        [wx, squares[1], xy, xz],
        [wy, xy, squares[2], yz],
        [wz, xz, yz, squares[3]],
    )[largest]
    norm = math.sqrt(sum(part * part for part in row))
    return [part / norm for part in row]


def heading(alpha: float) -> list[float]:
    """The quaternion (w, x, y, z) of an upright body with the heading `alpha`."""
    return [math.cos(alpha / 2), 0.0, 0.0, -math.sin(alpha / 2)]


def pose(position: NDArray[Any], rotation: NDArray[Any]) -> Pose:
    """The planar pose of a MuJoCo body (position (3,) in m, rotation matrix (9,))."""
    ahead_x, ahead_y = float(rotation[1]), float(rotation[4])  # the body's y axis in the world
    return Pose(
        float(position[0]) / MM, float(position[1]) / MM, wrap_angle(math.atan2(ahead_x, ahead_y))
    )


def matrix(position: NDArray[Any], rotation: NDArray[Any]) -> Array:
    """The pose of a MuJoCo body as a RoboComp matrix, shape (4, 4), in mm."""
    converted = np.eye(4)
    converted[:3, :3] = np.reshape(rotation, (3, 3))[[0, 2, 1]][:, [0, 2, 1]]
    converted[:3, 3] = np.asarray(position)[[0, 2, 1]] / MM
    return converted


def body(pose: Array) -> Array:
    """A RoboComp pose, shape (4, 4) in mm, as MuJoCo pose in m; the inverse of `matrix`."""
    converted = np.eye(4)
    converted[:3, :3] = pose[:3, :3][[0, 2, 1]][:, [0, 2, 1]]
    converted[:3, 3] = pose[[0, 2, 1], 3] * MM
    return converted


def floor(pose: Array) -> Array:
    """MuJoCo points, shape (n, 3) in m, as (x, z) in mm, shape (n, 2)."""
    return pose[:, :2] / MM
