"""Fit a truncated cone with a free, tilted axis to measured taxel positions.

In: points (n, 3) in any frame. Out: the axis, the cone along it and the distances of the
points. Gauss-Newton with damping over six numbers: two tilts and two shifts of the axis, the radius
in the middle and its slope.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from robocomp_dsl.tactile.arrays import Floats
from robocomp_dsl.tactile.errors import BadFit
from robocomp_dsl.tactile.skin.cone import Cone

MINIMUM_POINTS = 8
_ITERATIONS = 200
_SMALLEST_STEP = 1e-10


@dataclass(frozen=True, eq=False)
class ConeFit:
    """A cone in the frame of its points.

    `origin` (3,) is the point of the axis where x = 0, nearest to the frame's own origin;
    `axes` (3, 3) has the limb's x, y and z as columns. `rms` and `worst` are distances [m].
    """

    origin: Floats
    axes: Floats
    cone: Cone
    rms: float
    worst: float

    def to_limb(self, points: Floats) -> Floats:
        """Points (..., 3) in the limb frame of this fit."""
        transformed: Floats = (points - self.origin) @ self.axes
        return transformed


def fit_cone(points: Floats, axis: Floats | None = None) -> ConeFit:
    """The cone nearest to `points` (n, 3) in the least-squares sense of the radius.

    `axis` (3,) is an initial guess and defines which end is the far one; without it the three frame
    axes are tried. Raises `BadFit` for fewer than 8 different points, coplanar or collinear points,
    values that are not finite, or a result that is not a cone.
    """
    _check(points)
    starts = [axis] if axis is not None else list(np.eye(3))
    fits = [_descend(points, np.asarray(start, float)) for start in starts]
    best = min(fits, key=lambda fit: fit[1])
    return _result(points, *best[0])


def _check(points: Floats) -> None:
    if points.ndim != 2 or points.shape[1] != 3 or not np.isfinite(points).all():
        raise BadFit("the points must be rows of three finite numbers")
    different = np.unique(points, axis=0)
    if len(different) < MINIMUM_POINTS:
        raise BadFit(f"{len(different)} different points are too few: {MINIMUM_POINTS} are needed")
    spread = np.linalg.svd(different - different.mean(axis=0), compute_uv=False)
    if spread[2] < 1e-3 * spread[0]:
        raise BadFit("the points are in one plane: no cone surface contains them all")


def _descend(points: Floats, start: Floats) -> tuple[tuple[Floats, Floats, Floats], float]:
    """Frame, six numbers and sum of squares from the initial guess `start` of the axis."""
    frame = _frame(start / np.linalg.norm(start))
    centre = points.mean(axis=0)
    local = (points - centre) @ frame
    state = np.array([0.0, 0.0, 0.0, 0.0, np.hypot(local[:, 1], local[:, 2]).mean(), 0.0])
    residual = _residual(local, state)
    cost, damping = float(residual @ residual), 1e-3
    for _ in range(_ITERATIONS):
        jacobian = _jacobian(local, state)
        normal = jacobian.T @ jacobian
        step = np.linalg.solve(
            normal + damping * np.diag(np.diag(normal) + 1e-12), -jacobian.T @ residual
        )
        trial = _residual(local, state + step)
        if float(trial @ trial) < cost:
            state, residual = state + step, trial
            cost, damping = float(trial @ trial), damping * 0.3
        else:
            damping = min(damping * 5.0, 1e9)
        if np.abs(step).max() < _SMALLEST_STEP:
            break
    return (centre, frame, state), cost


def _residual(local: Floats, state: Floats) -> Floats:
    """Distance from the axis minus radius, (n,). State: tilts y z, shifts y z, radius, slope."""
    direction = np.array([1.0, state[0], state[1]]) / np.sqrt(1.0 + state[0] ** 2 + state[1] ** 2)
    away = local - np.array([0.0, state[2], state[3]])
    along = away @ direction
    radial = np.linalg.norm(away - along[:, None] * direction, axis=1)
    residual: Floats = radial - (state[4] + state[5] * along)
    return residual


def _jacobian(local: Floats, state: Floats) -> Floats:
    """Central differences of the residual, (n, 6)."""
    columns = []
    for i, size in enumerate((1e-6, 1e-6, 1e-8, 1e-8, 1e-8, 1e-6)):
        step = np.zeros(6)
        step[i] = size
        columns.append((_residual(local, state + step) - _residual(local, state - step)) / size / 2)
    return np.stack(columns, axis=1)


def _result(points: Floats, centre: Floats, frame: Floats, state: Floats) -> ConeFit:
    axes = _frame(frame @ np.array([1.0, state[0], state[1]]))
    on_axis = centre + frame @ np.array([0.0, state[2], state[3]])
    middle = float(on_axis @ axes[:, 0])
    along = (points - on_axis) @ axes[:, 0] + middle
    x0, x1 = float(along.min()), float(along.max())
    r0, r1 = (float(state[4] + state[5] * (x - middle)) for x in (x0, x1))
    if min(r0, r1) <= 0.0:
        raise BadFit("the points do not surround an axis: the fitted cone has no positive radius")
    missing = _residual((points - centre) @ frame, state)
    rms, worst = float(np.sqrt(np.mean(missing**2))), float(np.abs(missing).max())
    return ConeFit(on_axis - middle * axes[:, 0], axes, Cone(x0, x1, r0, r1), rms, worst)


def _frame(x: Floats) -> Floats:
    """A right-handed frame with the given x axis as its first column."""
    x = x / np.linalg.norm(x)
    z = np.eye(3)[2] if abs(x[2]) < 0.9 else np.eye(3)[1]
    z = z - (z @ x) * x
    z = z / np.linalg.norm(z)
    return np.stack((x, np.cross(z, x), z), axis=1)
