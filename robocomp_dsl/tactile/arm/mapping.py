"""Generic servos and device joints (equations 1 and 2 of Ma and Dahl, 2016).

In: gamma, sigma and limits per generic index. Out: readings, commands, displacements, speeds,
torques and limits, converted between both sides. A generic value is gamma * device + sigma;
displacements omit sigma, speeds divide by |gamma|, torques follow from equal power.
"""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property

import numpy as np

from robocomp_dsl.tactile.arrays import Bools, Floats, Ints
from robocomp_dsl.tactile.errors import InvalidCommand


@dataclass(frozen=True)
class DeviceCommand:
    """Values for the device: one per present joint, in generic order.

    `clipped` and `dropped` have one entry per generic index: the value was clipped to its limits;
    the value was for a degree of freedom that the robot lacks.
    """

    values: Floats
    clipped: Bools
    dropped: Bools


@dataclass(frozen=True, eq=False)
class PartMapping:
    """The n generic servos of one part, over the m <= n device joints that exist.

    All arrays have n entries, in the device's unit; `to_si` turns that unit into radians or metres.
    Where `available` is false the generic value is fixed to sigma and commands are dropped.
    """

    gamma: Floats
    sigma: Floats
    low: Floats
    high: Floats
    available: Bools
    to_si: Floats

    def __post_init__(self) -> None:
        if np.any(self.gamma == 0.0):
            raise ValueError("gamma must not be zero")
        if np.any(self.low > self.high):
            raise ValueError("a lower limit is above its upper limit")

    @property
    def size(self) -> int:
        """Number of generic indices, n."""
        return len(self.gamma)

    @cached_property
    def present(self) -> Ints:
        """Generic indices that have a device joint, shape (m,)."""
        return np.flatnonzero(self.available)

    def read(self, device: Floats) -> Floats:
        """Generic values (n,) of the readings (m,) of the present joints."""
        self._require(device, len(self.present))
        generic = self.sigma.copy()
        generic[self.present] += self.gamma[self.present] * device
        return generic

    def read_speed(self, device: Floats) -> Floats:
        """Generic velocities (n,) of device velocities (m,); zero for missing joints."""
        self._require(device, len(self.present))
        generic = np.zeros(self.size)
        generic[self.present] = self.gamma[self.present] * device
        return generic

    def command(self, generic: Floats) -> DeviceCommand:
        """Device positions for generic positions (n,), clipped in device units."""
        self._require(generic, self.size)
        requested = (generic - self.sigma) / self.gamma
        limited = np.clip(requested, self.low, self.high)
        changed = (limited != requested) & self.available
        return DeviceCommand(limited[self.present], changed, self._dropped(generic - self.sigma))

    def joint_positions(self, generic: Floats) -> Floats:
        """Positions (m,) [rad or m] of the present joints for generic positions (n,), not clipped.

        The inverse of equation 1.
        """
        self._require(generic, self.size)
        positions: Floats = ((generic - self.sigma) / self.gamma_si)[self.present]
        return positions

    def displacement(self, generic: Floats) -> DeviceCommand:
        """Device displacements for generic displacements (n,): without sigma and clipping."""
        self._require(generic, self.size)
        moved = (generic / self.gamma)[self.present]
        return DeviceCommand(moved, np.zeros(self.size, bool), self._dropped(generic))

    def speed(self, generic: Floats) -> DeviceCommand:
        """Device reference speeds, never negative, for generic reference speeds (n,)."""
        self._require(generic, self.size)
        speed = (np.abs(generic) / np.abs(self.gamma))[self.present]
        return DeviceCommand(speed, np.zeros(self.size, bool), self._dropped(generic))

    def velocity(self, generic: Floats) -> DeviceCommand:
        """Signed device velocities for generic velocities (n,)."""
        return self.displacement(generic)

    def torque(self, generic: Floats) -> DeviceCommand:
        """Device torques [N m] with the same power as generic torques [N m] (n,)."""
        self._require(generic, self.size)
        torque = (generic * self.gamma_si)[self.present]
        return DeviceCommand(torque, np.zeros(self.size, bool), self._dropped(generic))

    def read_torque(self, device: Floats) -> Floats:
        """Generic torques (n,) of device torques (m,); zero for missing joints."""
        self._require(device, len(self.present))
        generic = np.zeros(self.size)
        generic[self.present] = device / self.gamma_si[self.present]
        return generic

    def stiffness(self, generic: Floats) -> DeviceCommand:
        """Device stiffness [N m/rad] or damping [N m s/rad] of a generic one (n,)."""
        self._require(generic, self.size)
        value = (generic * self.gamma_si**2)[self.present]
        return DeviceCommand(value, np.zeros(self.size, bool), self._dropped(generic))

    @cached_property
    def gamma_si(self) -> Floats:
        """Gamma for device values in radians and metres, (n,)."""
        return self.gamma / self.to_si

    @cached_property
    def limits(self) -> tuple[Floats, Floats]:
        """Lower and upper generic limits, each (n,); swapped where gamma is negative."""
        ends = np.stack((self.gamma * self.low, self.gamma * self.high)) + self.sigma
        ends[:, ~self.available] = self.sigma[~self.available]
        return ends.min(axis=0), ends.max(axis=0)

    def speed_limit(self, device: Floats) -> Floats:
        """Generic speed limits (n,) of device speed limits (n,)."""
        limit: Floats = np.where(self.available, np.abs(self.gamma) * device, 0.0)
        return limit

    def _dropped(self, effect: Floats) -> Bools:
        """Missing joints that the command addresses."""
        dropped: Bools = ~self.available & (effect != 0.0)
        return dropped

    def _require(self, values: Floats, size: int) -> None:
        if values.shape != (size,):
            raise InvalidCommand(f"{size} values are needed, not {values.size}")
        if not np.isfinite(values).all():
            raise InvalidCommand("the values hold NaN or infinity")
