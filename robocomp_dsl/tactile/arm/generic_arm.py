"""A generic arm over any robot's arm: its state and commands in generic units.

In: readings of the device's joints and wishes in generic angles or in space. Out: `Orders` for the
joints that exist, in SI units, and what had to be clipped or dropped. No middleware, no clock.
"""

from __future__ import annotations

from dataclasses import dataclass
from enum import StrEnum

import numpy as np

from robocomp_dsl.tactile.arm.chain import Chain
from robocomp_dsl.tactile.arm.inverse import Solver, Tolerance
from robocomp_dsl.tactile.arm.mapping import DeviceCommand
from robocomp_dsl.tactile.arrays import Bools, Floats
from robocomp_dsl.tactile.description.model import Part
from robocomp_dsl.tactile.errors import InvalidCommand, NoChain, NoState

PEAK = 15 / 8
"""Largest speed of a motion with the least jerk, as a share of its mean speed."""


class Control(StrEnum):
    """What the numbers of an order are."""

    POSITION = "position"
    DIRECT = "direct"
    VELOCITY = "velocity"
    TORQUE = "torque"


@dataclass(frozen=True, slots=True, eq=False)
class Orders:
    """For `joints` (m,), qualified names: `values` (m,) and for moves mean `speeds` (m,), SI units.

    `clipped` and `dropped` (n,) tell by generic index what was not possible.
    """

    control: Control
    joints: tuple[str, ...]
    values: Floats
    speeds: Floats | None
    clipped: Bools
    dropped: Bools


@dataclass(frozen=True, slots=True, eq=False)
class ArmState:
    """Generic angles, velocities and torques (n,) at `time` [s]."""

    time: float
    position: Floats
    velocity: Floats
    torque: Floats


class GenericArm:
    """The generic arm of one part. Angles and limits are (n,), n the number of generic indices."""

    def __init__(self, part: Part, tolerance: Tolerance | None = None) -> None:
        self.part, self.mapping = part, part.mapping
        self.low, self.high = self.mapping.limits
        self.speed_limits = part.speed_limits
        self.state: ArmState | None = None
        self._chain = part.generic_chain
        self._to_si = self.mapping.to_si[self.mapping.present]
        self._tolerance = tolerance or Tolerance()

    def sense(self, time: float, position: Floats, velocity: Floats, torque: Floats) -> ArmState:
        """Take in readings of the present joints (m,), in SI units; the new state."""
        device = position / self._to_si
        self.state = ArmState(
            time,
            self.mapping.read(device),
            self.mapping.read_speed(velocity / self._to_si),
            self.mapping.read_torque(torque),
        )
        return self.state

    def move(self, goal: Floats, speed: Floats | None = None) -> Orders:
        """Go to generic angles `goal`, by default as fast as the limits allow.

        `speed` (n,) [rad/s] is the mean of the motion, so that the peak of a slow start and end is
        within the limits, too.
        """
        sent = self.mapping.command(goal)
        wished = self.speed_limits if speed is None else self._expected(speed, "speeds")
        if (wished[self.mapping.present] <= 0.0).any():
            raise InvalidCommand("every joint needs a speed above 0, or it would never arrive")
        kept = np.minimum(wished, self.speed_limits / PEAK)
        speeds = self.mapping.speed(kept).values * self._to_si
        return self._orders(Control.POSITION, sent, speeds)

    def move_by(self, way: Floats, speed: Floats | None = None) -> Orders:
        """Go by generic displacements from where the arm is. Raises `NoState` before `sense`."""
        return self.move(self.now().position + self._expected(way, "displacements"), speed)

    def follow(self, goal: Floats) -> Orders:
        """Be at generic angles `goal` at once; for streams of small steps."""
        return self._orders(Control.DIRECT, self.mapping.command(goal))

    def drive(self, velocity: Floats) -> Orders:
        """Turn at generic velocities, clipped to the limits."""
        most = np.where(self.mapping.available, self.speed_limits, np.inf)
        kept = np.clip(self._expected(velocity, "velocities"), -most, most)
        return self._orders(
            Control.VELOCITY,
            self.mapping.velocity(kept),
            clipped=kept != velocity,
        )

    def push(self, torque: Floats) -> Orders:
        """Generic torques [N m]."""
        sent = self.mapping.torque(self._expected(torque, "torques"))
        return Orders(
            Control.TORQUE, self.part.joints, sent.values, None, sent.clipped, sent.dropped
        )

    def stiffness(self, stiffness: Floats, damping: Floats) -> tuple[Floats, Floats]:
        """Device stiffness [N m/rad] and damping [N m s/rad] (m,) of generic ones (n,)."""
        if (stiffness < 0.0).any() or (damping < 0.0).any():
            raise InvalidCommand("stiffness and damping are not negative")
        return self.mapping.stiffness(stiffness).values, self.mapping.stiffness(damping).values

    def reach(self, position: Floats, rotation: Floats | None = None) -> Orders:
        """Bring the hand to `position` (3,) [m], and `rotation` (3, 3) if given, in the base frame.

        Raises `Unreachable`, `NoChain`, `NoState`.
        """
        now = self.now().position
        if not np.isfinite(position).all() or np.shape(position) != (3,):
            raise InvalidCommand("a position is three finite numbers")
        if rotation is not None and not _is_rotation(rotation):
            raise InvalidCommand("a rotation is a matrix of 3 by 3 with three unit axes")
        solver = Solver(self.chain, self.low, self.high, self._tolerance)
        return self.move(solver.solve(position, now, rotation))

    def glide(self, velocity: Floats, damping: float = 0.05) -> Orders:
        """Move the hand at `velocity` (3,) [m/s], or (6,) with rotation [rad/s].

        Joints at a limit do not push on; all speeds are scaled down together where one is too fast.
        """
        if np.shape(velocity) not in ((3,), (6,)) or not np.isfinite(velocity).all():
            raise InvalidCommand("a velocity is three or six finite numbers")
        now = self.now().position
        jacobian = self.chain.jacobian(now)[: len(velocity)]
        free = self.mapping.available.copy()
        speed = np.zeros(len(now))
        for _ in range(len(now)):
            speed = _damped(np.where(free, jacobian, 0.0), velocity, damping)
            blocked = ((now <= self.low) & (speed < 0)) | ((now >= self.high) & (speed > 0))
            if not (blocked & free).any():
                break
            free &= ~blocked
        over = np.abs(speed) / np.where(self.speed_limits > 0, self.speed_limits, np.inf)
        return self.drive(speed / max(1.0, float(over.max())))

    def hand(self, angles: Floats | None = None) -> Floats:
        """Pose 4 x 4 of the hand in the base frame, at `angles` or where the arm is."""
        return self.chain.pose(self.now().position if angles is None else angles)

    @property
    def chain(self) -> Chain:
        """The chain in generic angles; raises `NoChain` where the description gives none."""
        if self._chain is None:
            raise NoChain(f"the description of `{self.part.name}` gives no chain")
        return self._chain

    def _orders(
        self,
        control: Control,
        sent: DeviceCommand,
        speeds: Floats | None = None,
        clipped: Bools | None = None,
    ) -> Orders:
        cut = sent.clipped if clipped is None else clipped
        values = sent.values * self._to_si
        return Orders(control, self.part.joints, values, speeds, cut, sent.dropped)

    def now(self) -> ArmState:
        """Where the arm was measured last. Raises `NoState` before the first `sense`."""
        if self.state is None:
            raise NoState(f"`{self.part.name}` has not been measured yet")
        return self.state

    def _expected(self, values: Floats, what: str) -> Floats:
        if values.shape != (self.mapping.size,) or not np.isfinite(values).all():
            raise InvalidCommand(f"{self.mapping.size} finite {what} are needed")
        return values


def _is_rotation(matrix: Floats) -> bool:
    """Whether the columns are a right-handed set of axes, up to rounding."""
    if np.shape(matrix) != (3, 3) or not np.isfinite(matrix).all():
        return False
    square = np.allclose(matrix.T @ matrix, np.eye(3), atol=1e-3)
    return bool(square and np.linalg.det(matrix) > 0)


def _damped(jacobian: Floats, velocity: Floats, damping: float) -> Floats:
    """Damped least-squares joint speeds for a velocity in space."""
    square = jacobian @ jacobian.T + damping**2 * np.eye(len(velocity)) * 0.01
    speeds: Floats = jacobian.T @ np.linalg.solve(square, velocity)
    return speeds
