"""The force and distance law of the withdrawal reflex (equations 5 to 7 of Ma and Dahl, 2016).

In: the taxels of one touch and a receptive field, both in the frame of the field's limb. Out: the
gain and the displacements of the generic joints. Equation 5 as printed grows with the
distance, which contradicts its text. Here force and distance scale the base motion by 1 to 0:

    theta = phi(F) psi(d) Theta,   phi = clip((F - threshold) / (full - threshold), 0, 1),
    psi = 1 - d / radius,          0 where d >= radius or F <= threshold.
"""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import dataclass

import numpy as np

from robocomp_dsl.tactile.arrays import Floats

_SHORTEST = 1e-9


@dataclass(frozen=True, slots=True)
class Law:
    """Force thresholds [N]: where the reflex begins, and where it reaches full strength."""

    threshold: float = 1.0
    full: float = 10.0

    def __post_init__(self) -> None:
        if not 0.0 <= self.threshold < self.full:
            raise ValueError("0 <= threshold < full force is needed")

    def force_factor(self, force: float) -> float:
        """Phi: 0 at the threshold, 1 from the full force on."""
        return min(max((force - self.threshold) / (self.full - self.threshold), 0.0), 1.0)


@dataclass(frozen=True, slots=True, eq=False)
class Field:
    """A receptive field on one limb: centre (3,) and radius [m], base motion Theta (n,) [rad]."""

    name: str
    limb: str
    centre: Floats
    radius: float
    motion: Floats

    def distance_factor(self, distance: float) -> float:
        """Psi: 1 at the centre, 0 at the edge and beyond."""
        return max(1.0 - distance / self.radius, 0.0)


@dataclass(frozen=True, slots=True, eq=False)
class Stimulus:
    """A touch as seen by one field: weighted centre (3,) [m] and weighted mean force [N]."""

    centre: Floats
    force: float


@dataclass(frozen=True, slots=True, eq=False)
class Response:
    """The response of one field to one touch; `motion` (n,) holds displacements.

    `inward` (3,) is the unit normal of the touched skin into the limb, in the limb's frame.
    """

    field: Field
    stimulus: Stimulus
    distance: float
    gain: float
    inward: Floats

    @property
    def motion(self) -> Floats:
        """Displacements of the generic joints [rad]."""
        return self.gain * self.field.motion


def stimulus(points: Floats, forces: Floats, radius: float) -> Stimulus | None:
    """Equation 7 for the taxels `points` (n, 3) with `forces` (n,), or None without force.

    The weights 2 radius - |P - centre| are negative beyond the diameter of the field and would
    distort the mean. Such taxels are left out, and the centre is computed again.
    """
    felt = forces > 0.0
    points, forces = points[felt], forces[felt]
    if not len(forces):
        return None
    near = _weights(points, _centre(points, forces), radius) > 0.0
    if not near.any():
        return None
    points, forces = points[near], forces[near]
    centre = _centre(points, forces)
    weights = np.maximum(_weights(points, centre, radius), 0.0)
    total = float(weights.sum())
    return Stimulus(centre, float(forces @ weights) / total) if total > 0.0 else None


def respond(
    law: Law, field: Field, points: Floats, forces: Floats, normals: Floats | None = None
) -> Response | None:
    """Equations 5 and 6: the response of `field` to one touch, or None without a response.

    `normals` (n, 3) are those of the taxels, outwards. Without them, the direction from the touch
    to the axis of the limb is taken.
    """
    felt = stimulus(points, forces, field.radius)
    if felt is None:
        return None
    distance = float(np.linalg.norm(felt.centre - field.centre))
    gain = law.force_factor(felt.force) * field.distance_factor(distance)
    if gain <= 0.0:
        return None
    return Response(field, felt, distance, gain, _inward(felt.centre, forces, normals))


def total_motion(responses: Iterable[Response], size: int) -> Floats:
    """The sum (size,) of the displacements of several fields and touches."""
    motion = np.zeros(size)
    for response in responses:
        motion += response.motion
    return motion


def _inward(centre: Floats, forces: Floats, normals: Floats | None) -> Floats:
    """The unit normal (3,) into the limb: the mean by force, or towards the axis x."""
    axis = -np.array([0.0, centre[1], centre[2]])
    mean = axis if normals is None else -(np.maximum(forces, 0.0) @ normals)
    for candidate in (mean, axis):
        length = float(np.linalg.norm(candidate))
        if length > _SHORTEST:
            unit: Floats = candidate / length
            return unit
    return np.array([0.0, 0.0, -1.0])


def _centre(points: Floats, forces: Floats) -> Floats:
    centre: Floats = forces @ points / forces.sum()
    return centre


def _weights(points: Floats, centre: Floats, radius: float) -> Floats:
    weights: Floats = 2.0 * radius - np.linalg.norm(points - centre, axis=1)
    return weights
