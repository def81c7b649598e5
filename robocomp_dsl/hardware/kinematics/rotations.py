"""Rotations in RoboComp's order, R = Rx(rx)·Ry(ry)·Rz(rz), and poses as matrices of shape (4, 4).

Each factor has the sines of a right-handed rotation matrix; since the frame is left-handed (x
right, y up, z ahead), a positive angle about y turns to the right (RoboComp, Rot3D).
"""

from __future__ import annotations

import math
from collections.abc import Sequence

import numpy as np
from numpy.typing import NDArray

Matrix = NDArray[np.float64]


def pose_rows(pose: Sequence[float]) -> tuple[tuple[float, float, float, float], ...]:
    """The upper three rows of the matrix of `pose`: x, y, z in mm and rx, ry, rz in rad."""
    x, y, z, rx, ry, rz = pose
    sx, cx = math.sin(rx), math.cos(rx)
    sy, cy = math.sin(ry), math.cos(ry)
    sz, cz = math.sin(rz), math.cos(rz)
    return (
        (cy * cz, -cy * sz, sy, x),
        (sx * sy * cz + cx * sz, cx * cz - sx * sy * sz, -sx * cy, y),
        (sx * sz - cx * sy * cz, cx * sy * sz + sx * cz, cx * cy, z),
    )


def rotation(rx: float, ry: float, rz: float) -> Matrix:
    """The rotation matrix, shape (3, 3)."""
    return np.array([row[:3] for row in pose_rows((0, 0, 0, rx, ry, rz))])


def angles(turned: Matrix) -> tuple[float, float, float]:
    """rx, ry, rz of a rotation matrix, shape (3, 3), in rad.

    A rotation has two solutions: (rx, ry, rz) with |ry| up to 90° and (rx + 180°, 180° - ry,
    rz + 180°). The one of the smaller Euclidean norm is returned, as by RoboComp's
    `QMat::extractAnglesR_min`: a rotation about one axis has one angle in [-π, π] and two zeros.
    If ry is ±90°, rz is set to 0.
    """
    rx, ry, rz = _principal(turned)
    other = _opposite(rx), math.copysign(math.pi, ry) - ry, _opposite(rz)
    return other if math.hypot(*other) < math.hypot(rx, ry, rz) else (rx, ry, rz)


def heading(turned: Matrix) -> float:
    """The direction of the z axis seen from above, about y from z to x, in rad; shape (3, 3)."""
    return math.atan2(turned[0, 2], turned[2, 2])


def _principal(turned: Matrix) -> tuple[float, float, float]:
    """The solution with |ry| up to 90°.

    ry and rz are computed after rx is undone, so that the three reproduce `turned` to the last
    digits even if ry is nearly ±90° and rx alone is ill-conditioned.
    """
    row = turned.tolist()
    upright = math.hypot(row[1][2], row[2][2]) < 1e-12
    rx = math.atan2(row[2][1], row[1][1]) if upright else math.atan2(-row[1][2], row[2][2])
    sx, cx = math.sin(rx), math.cos(rx)
    ry = math.atan2(row[0][2], cx * row[2][2] - sx * row[1][2])
    rz = math.atan2(cx * row[1][0] + sx * row[2][0], cx * row[1][1] + sx * row[2][1])
    return rx + 0.0, ry + 0.0, rz + 0.0  # without negative zeros


def _opposite(angle: float) -> float:
    return angle - math.copysign(math.pi, angle)


def inverse(pose: Matrix) -> Matrix:
    """The inverse of a rigid transform, shape (4, 4)."""
    inverted = np.eye(4)
    inverted[:3, :3] = pose[:3, :3].T
    inverted[:3, 3] = -pose[:3, :3].T @ pose[:3, 3]
    return inverted
