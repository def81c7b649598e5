"""`JointMotor` over a control board. Angles in rad; prismatic joints: mm, on the board m."""

# ruff: noqa: N802, N803  called as in the interface

from __future__ import annotations

from collections.abc import Iterable, Sequence
from typing import Any, ClassVar

import numpy as np

from robocomp_dsl.hardware.control.board import Board
from robocomp_dsl.hardware.control.errors import BadValue, UnknownJoint
from robocomp_dsl.hardware.control.joints import Floats, Ints, numbers
from robocomp_dsl.hardware.control.modes import Mode
from robocomp_dsl.hardware.control.trajectories.minimum_jerk import PEAK
from robocomp_dsl.hardware.devices.errors import HardwareError
from robocomp_dsl.hardware.servants.servant import Servant

_MM = 1e-3
_LEAST, _MOST = -(2**31), 2**31 - 1

_ROUNDING = 1e-5
"""Tolerance of limits for 32-bit goals [rad or m]."""


class JointMotorServant(Servant):
    """All motors of the port are on one board."""

    FAILURES: ClassVar[tuple[tuple[type[HardwareError], str], ...]] = (
        (UnknownJoint, "UnknownMotorException"),
        (HardwareError, "HardwareFailedException"),
    )

    @property
    def _board(self) -> Board:
        found: Board = self.board_device().board
        return found

    # -- goals --------------------------------------------------------------------------------

    def setPosition(self, goal: Any) -> None:
        """Send one motor to a position; goals beyond its limits are rejected."""
        self.setSyncPosition([goal])

    def setSyncPosition(self, listGoals: Sequence[Any]) -> None:
        """Send several motors, all or none."""
        self.move(
            [goal.name for goal in listGoals],
            [goal.position for goal in listGoals],
            [goal.maxSpeed for goal in listGoals],
        )

    def move(self, names: Sequence[str], position: Sequence[float], speed: Sequence[float]) -> None:
        """Send the motors `names` to positions."""
        joints = self._joints(names)
        self._move(
            joints,
            numbers("position", position, len(joints)) * self._units(joints),
            numbers("maxSpeed", speed, len(joints)),
        )

    def setZeroPos(self, name: str) -> None:
        """Send one motor home."""
        joints = self._joints([name])
        self._move(joints, self.board_device().homes[joints], np.zeros(1))

    def setSyncZeroPos(self) -> None:
        """Send all motors home."""
        homes = self.board_device().homes
        self._move(np.arange(len(homes)), homes, np.zeros(len(homes)))

    def setVelocity(self, goal: Any) -> None:
        """Move one motor at a velocity."""
        self.setSyncVelocity([goal])

    def setSyncVelocity(self, listGoals: Sequence[Any]) -> None:
        """Move several motors at velocities; a `maxAcc` of 0 leaves the acceleration unchanged."""
        self.drive(
            [goal.name for goal in listGoals],
            [goal.velocity for goal in listGoals],
            [goal.maxAcc for goal in listGoals],
        )

    def drive(self, names: Sequence[str], speed: Sequence[float], most: Sequence[float]) -> None:
        """Move the motors `names`, with accelerations up to `most`."""
        board, joints = self._board, self._joints(names)
        unit = self._units(joints)
        velocity = numbers("velocity", speed, len(joints)) * unit
        steepest = numbers("maxAcc", most, len(joints)) * unit
        self._refuse_beyond("velocity", joints, velocity, -board.limits.speed, board.limits.speed)
        board.set_modes(joints, [Mode.VELOCITY] * len(joints))
        limited = steepest > 0
        board.references.acceleration[joints[limited]] = steepest[limited]
        board.references.set_velocity(joints, velocity, np.inf)

    def _move(self, joints: Ints, goal: Floats, speed: Floats) -> None:
        """Minimum-jerk motion to `goal` (rad or m); `speed` is the peak, as in the interface."""
        board = self._board
        self._refuse_beyond("position", joints, goal, board.limits.low, board.limits.high)
        if (speed < 0).any():
            raise BadValue("`maxSpeed` is negative")
        most = np.where(speed > 0, speed * self._units(joints), board.limits.speed[joints])
        board.set_modes(joints, [Mode.POSITION] * len(joints))
        allowed, _ = board.limits.clip(joints, goal)
        board.references.move(joints, allowed, board.dt, most / PEAK)

    def _refuse_beyond(
        self, what: str, joints: Ints, values: Floats, low: Floats, high: Floats
    ) -> None:
        for joint, value in zip(joints.tolist(), values.tolist(), strict=True):
            lowest, highest = float(low[joint]), float(high[joint])
            if not lowest - _ROUNDING <= value <= highest + _ROUNDING:
                name, unit = self._board.spec.names[joint], self._unit(joint)
                raise BadValue(
                    f"`{name}` cannot take the {what} {value / unit:g}: "
                    f"it is limited to {lowest / unit:g} … {highest / unit:g}"
                )

    # -- states -------------------------------------------------------------------------------

    def getMotorState(self, motor: str) -> Any:
        """The current state of one motor."""
        return self._states([self._joint(motor)])[motor]

    def getMotorStateMap(self, mList: Sequence[str]) -> dict[str, Any]:
        """The current states of the named motors."""
        return self._states([self._joint(name) for name in mList])

    def getAllMotorState(self) -> dict[str, Any]:
        """The current states of all motors."""
        return self._states(range(len(self._board.spec.joints)))

    def _states(self, joints: Iterable[int]) -> dict[str, Any]:
        board = self._board
        state, units = board.state(), np.where(board.spec.prismatic, _MM, 1.0)
        moving = (np.abs(state.velocity) > 1e-3) | board.references.trajectory.moving
        columns = (
            (state.position / units).tolist(),
            (state.velocity / units).tolist(),
            (state.torque * state.velocity).tolist(),
            _whole(state.motor_counts),
            _whole(state.motor_speed),
            moving.tolist(),
            state.temperature.astype(np.int64).tolist(),
        )
        names, rows = board.spec.names, list(zip(*columns, strict=True))
        time, struct = f"{state.time:.6f}", self.types.MotorState
        return {names[i]: _state(struct, time, rows[i]) for i in joints}

    # -- configuration ------------------------------------------------------------------------

    def getMotorParams(self, motor: str) -> Any:
        """Configuration and limits of one motor."""
        board, joint = self._board, self._joint(motor)
        unit = self._unit(joint)
        low, high = float(board.limits.low[joint]), float(board.limits.high[joint])
        turns = board.motors.gear[joint] * (high - low) / (2 * np.pi)
        return self.types.MotorParams(
            name=motor,
            minPos=low / unit,
            maxPos=high / unit,
            maxVelocity=float(board.limits.speed[joint]) / unit,
            zeroPos=float(self.board_device().homes[joint]) / unit,
            stepsRange=float(turns * board.motors.counts[joint]),
            maxDegrees=float(np.rad2deg(high - low)),
            unitsRange=(high - low) / unit,
        )

    def getAllMotorParams(self) -> list[Any]:
        """Configuration and limits of all motors."""
        return [self.getMotorParams(name) for name in self._board.spec.names]

    def getBusParams(self) -> Any:
        """The bus."""
        board = self._board
        return self.types.BusParams(
            handler="robocomp_dsl",
            device=self.port,
            numMotors=len(board.spec.joints),
            basicPeriod=max(1, round(board.dt * 1000)),
        )

    # -- names and units ----------------------------------------------------------------------

    def _joint(self, name: str) -> int:
        return self._board.select.index(name)

    def _joints(self, names: Iterable[str]) -> Ints:
        return self._board.select.indices(list(names))

    def _unit(self, joint: int) -> float:
        return _MM if self._board.spec.prismatic[joint] else 1.0

    def _units(self, joints: Ints) -> Floats:
        return np.where(self._board.spec.prismatic[joints], _MM, 1.0)


def _state(struct: type[Any], time: str, row: tuple[Any, ...]) -> Any:
    """The state of a motor, the array row `row`, as an instance of `struct`."""
    pos, vel, power, p, v, moving, temperature = row
    return struct(
        pos=pos,
        vel=vel,
        power=power,
        timeStamp=time,
        p=p,
        v=v,
        isMoving=moving,
        temperature=temperature,
    )


def _whole(counts: Floats) -> list[int]:
    """Counts clipped to the 32 bits of the interface."""
    clamp_scene: list[int] = np.clip(counts, _LEAST, _MOST).astype(np.int64).tolist()
    return clamp_scene
