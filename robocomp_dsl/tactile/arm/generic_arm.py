"""A generic arm over the arm of any robot: state and commands in generic units.

In: joint readings of the device, and commands in generic angles or in Cartesian space. Out:
`JointCommands` for the joints that exist, in SI units, with the clipped and dropped entries.
"""

from __future__ import annotations

from dataclasses import dataclass
from enum import StrEnum

import numpy as np

from robocomp_dsl.tactile.arm.chain import Chain
from robocomp_dsl.tactile.arm.inverse import Solver, Tolerance
from robocomp_dsl.tactile.arm.mapping import DeviceCommand
from robocomp_dsl.tactile.arrays import Bools, Floats
from robocomp_dsl.tactile.description.model import GenericPart
from robocomp_dsl.tactile.errors import InvalidCommand, NoChain, NoState

PEAK = 15 / 8
"""Peak speed of a minimum-jerk motion, as a multiple of its mean speed."""


class Control(StrEnum):
    """The quantity that a command holds."""

    POSITION = "position"
    DIRECT = "direct"
    VELOCITY = "velocity"
    TORQUE = "torque"


@dataclass(frozen=True, slots=True, eq=False)
class JointCommands:
    """Commands for `joints` (m,), by qualified name, in SI units.

    `values` (m,) are the set-points, `speeds` (m,) the mean speeds of position moves. `clipped` and
    `dropped` (n,) mark, by generic index, what the arm cannot do.
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

    def __init__(self, part: GenericPart, tolerance: Tolerance | None = None) -> None:
        self.part, self.mapping = part, part.mapping
        self.low, self.high = self.mapping.limits
        self.speed_limits = part.speed_limits
        self.state: ArmState | None = None
        self._chain = part.generic_chain
        self._to_si = self.mapping.to_si[self.mapping.present]
        self._tolerance = tolerance or Tolerance()

    def update_state(
        self, time: float, position: Floats, velocity: Floats, torque: Floats
    ) -> ArmState:
        """Update from readings of the present joints (m,), in SI units; return the new state."""
        device = position / self._to_si
        self.state = ArmState(
            time,
            self.mapping.read(device),
            self.mapping.read_speed(velocity / self._to_si),
            self.mapping.read_torque(torque),
        )
        return self.state

    def position_move(self, goal: Floats, speed: Floats | None = None) -> JointCommands:
        """Move to generic angles `goal` (n,) [rad], by default as fast as the limits allow.

        `speed` (n,) [rad/s] is the mean speed; it is limited so that the peak speed of a
        minimum-jerk motion stays within the limits, too.
        """
        sent = self.mapping.command(goal)
        requested = self.speed_limits if speed is None else self._checked(speed, "speeds")
        if (requested[self.mapping.present] <= 0.0).any():
            raise InvalidCommand("every joint needs a speed above 0")
        limited = np.minimum(requested, self.speed_limits / PEAK)
        speeds = self.mapping.speed(limited).values * self._to_si
        return self._joint_commands(Control.POSITION, sent, speeds)

    def relative_move(self, way: Floats, speed: Floats | None = None) -> JointCommands:
        """Move by generic displacements `way` (n,) [rad]. Raises `NoState` without a state."""
        return self.position_move(
            self.current_state().position + self._checked(way, "displacements"), speed
        )

    def set_position(self, goal: Floats) -> JointCommands:
        """Set the generic angles `goal` without a trajectory; for streams of small steps."""
        return self._joint_commands(Control.DIRECT, self.mapping.command(goal))

    def velocity_move(self, velocity: Floats) -> JointCommands:
        """Move at generic velocities (n,) [rad/s], clipped to the limits."""
        limit = np.where(self.mapping.available, self.speed_limits, np.inf)
        limited = np.clip(self._checked(velocity, "velocities"), -limit, limit)
        return self._joint_commands(
            Control.VELOCITY,
            self.mapping.velocity(limited),
            clipped=limited != velocity,
        )

    def set_torque(self, torque: Floats) -> JointCommands:
        """Apply generic torques (n,) [N m]."""
        sent = self.mapping.torque(self._checked(torque, "torques"))
        return JointCommands(
            Control.TORQUE, self.part.joints, sent.values, None, sent.clipped, sent.dropped
        )

    def stiffness(self, stiffness: Floats, damping: Floats) -> tuple[Floats, Floats]:
        """Device stiffness [N m/rad] and damping [N m s/rad] (m,) of generic ones (n,)."""
        if (stiffness < 0.0).any() or (damping < 0.0).any():
            raise InvalidCommand("stiffness and damping must not be negative")
        return self.mapping.stiffness(stiffness).values, self.mapping.stiffness(damping).values

    def reach(self, position: Floats, rotation: Floats | None = None) -> JointCommands:
        """Move the end effector to `position` (3,) [m] and `rotation` (3, 3), in the base frame.

        Raises `Unreachable`, `NoChain`, `NoState`.
        """
        now = self.current_state().position
        if not np.isfinite(position).all() or np.shape(position) != (3,):
            raise InvalidCommand("a position needs three finite numbers")
        if rotation is not None and not _is_rotation(rotation):
            raise InvalidCommand("a rotation needs a 3 by 3 matrix with orthonormal columns")
        solver = Solver(self.chain, self.low, self.high, self._tolerance)
        return self.position_move(solver.solve(position, now, rotation))

    def line_move(self, velocity: Floats, damping: float = 0.05) -> JointCommands:
        """Move the end effector at `velocity` (3,) [m/s], or (6,) with rotation [rad/s].

        Joints at a limit stop; all speeds are scaled down together if a joint would be too fast.
        """
        if np.shape(velocity) not in ((3,), (6,)) or not np.isfinite(velocity).all():
            raise InvalidCommand("a velocity needs three or six finite numbers")
        now = self.current_state().position
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
        return self.velocity_move(speed / max(1.0, float(over.max())))

    def end_effector_pose(self, angles: Floats | None = None) -> Floats:
        """Pose 4 x 4 of the end effector in the base frame, at `angles` or at the current pose."""
        return self.chain.pose(self.current_state().position if angles is None else angles)

    @property
    def chain(self) -> Chain:
        """The chain in generic angles. Raises `NoChain` if the description has none."""
        if self._chain is None:
            raise NoChain(f"the description of `{self.part.name}` has no kinematic chain")
        return self._chain

    def _joint_commands(
        self,
        control: Control,
        sent: DeviceCommand,
        speeds: Floats | None = None,
        clipped: Bools | None = None,
    ) -> JointCommands:
        cut = sent.clipped if clipped is None else clipped
        values = sent.values * self._to_si
        return JointCommands(control, self.part.joints, values, speeds, cut, sent.dropped)

    def current_state(self) -> ArmState:
        """The latest measured state. Raises `NoState` before the first `update_state`."""
        if self.state is None:
            raise NoState(f"`{self.part.name}` has not been measured yet")
        return self.state

    def _checked(self, values: Floats, what: str) -> Floats:
        if values.shape != (self.mapping.size,) or not np.isfinite(values).all():
            raise InvalidCommand(f"{self.mapping.size} finite {what} are needed")
        return values


def _is_rotation(matrix: Floats) -> bool:
    """Whether the columns are orthonormal and right-handed, up to rounding."""
    if np.shape(matrix) != (3, 3) or not np.isfinite(matrix).all():
        return False
    square = np.allclose(matrix.T @ matrix, np.eye(3), atol=1e-3)
    return bool(square and np.linalg.det(matrix) > 0)


def _damped(jacobian: Floats, velocity: Floats, damping: float) -> Floats:
    """Damped least-squares joint speeds for a Cartesian velocity."""
    square = jacobian @ jacobian.T + damping**2 * np.eye(len(velocity)) * 0.01
    speeds: Floats = jacobian.T @ np.linalg.solve(square, velocity)
    return speeds
