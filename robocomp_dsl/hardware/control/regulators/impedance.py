"""Compliant interaction: each joint is a spring and damper about its reference.

In: position error and velocity (n,). Out: torques (n,) [N m]. Stiffness [N m/rad] and damping
[N m s/rad] are bounded so that the loop is stable at its rate.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from robocomp_dsl.hardware.control.errors import BadValue
from robocomp_dsl.hardware.control.joints import Floats, Ints


@dataclass(frozen=True, slots=True)
class Bounds:
    """Largest stiffness [N m/rad] and damping [N m s/rad] of one joint; the smallest are 0."""

    stiffness: float
    damping: float


class Impedance:
    """`stiffness`, `damping` and `offset` are arrays (n,)."""

    def __init__(self, bounds: tuple[Bounds, ...]) -> None:
        self.bounds = bounds
        self.stiffness = np.array([0.2 * bound.stiffness for bound in bounds])
        self.damping = np.array([0.2 * bound.damping for bound in bounds])
        self.offset = np.zeros(len(bounds))

    def set(self, joints: Ints, stiffness: Floats, damping: Floats) -> None:
        """Set stiffness and damping. Raises `BadValue` outside the bounds."""
        for joint, k, d in zip(joints.tolist(), stiffness, damping, strict=True):
            most = self.bounds[joint]
            if not (0.0 <= k <= most.stiffness and 0.0 <= d <= most.damping):
                message = f"stiffness 0 to {most.stiffness:g}, damping 0 to {most.damping:g}"
                raise BadValue(f"joint {joint} takes {message}; not {k:g} and {d:g}")
        self.stiffness[joints] = stiffness
        self.damping[joints] = damping

    def torque(self, error: Floats, velocity_error: Floats) -> Floats:
        """Torques of all springs, dampers and offsets."""
        torque: Floats = self.stiffness * error + self.damping * velocity_error + self.offset
        return torque
