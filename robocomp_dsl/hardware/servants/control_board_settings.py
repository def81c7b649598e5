"""The settings of a control board as operations of `ControlBoard`: they move nothing."""

# ruff: noqa: N802  called as in the interface

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

from robocomp_dsl.hardware.control.board import Board
from robocomp_dsl.hardware.control.commands import Commands
from robocomp_dsl.hardware.control.joints import Floats
from robocomp_dsl.hardware.control.pid import Gains
from robocomp_dsl.hardware.control.settings import Settings
from robocomp_dsl.hardware.control.variables import RemoteVariables
from robocomp_dsl.hardware.servants.servant import Servant

Names = Sequence[str]


class BoardSettings(Servant):
    """The part of a `ControlBoard` servant that reads and writes settings."""

    @property
    def _board(self) -> Board:
        found: Board = self.board_device().board
        return found

    @property
    def _commands(self) -> Commands:
        return Commands(self._board)

    @property
    def _settings(self) -> Settings:
        return Settings(self._board)

    def setReferenceSpeed(self, joints: Names, speed: Floats) -> None:
        """Mean speeds of the next position moves."""
        self._settings.set_reference_speed(some(joints), speed)

    def setAcceleration(self, joints: Names, acceleration: Floats) -> None:
        """How fast velocities may change."""
        self._settings.set_acceleration(some(joints), acceleration)

    def getReferenceSpeed(self, joints: Names) -> Floats:
        """Mean speeds of position moves."""
        return self._settings.reference_speed(some(joints))

    def getAcceleration(self, joints: Names) -> Floats:
        """How fast velocities may change."""
        return self._settings.acceleration(some(joints))

    def setImpedance(self, joint: str, impedance: Any) -> None:
        """Spring, damper and offset."""
        self._settings.set_impedance([joint], impedance.stiffness, impedance.damping)
        self._settings.set_impedance_offset([joint], impedance.offset)

    def getImpedance(self, joint: str) -> Any:
        """Spring, damper and offset."""
        board = self._board
        at = board.select.index(joint)
        return self.types.Impedance(
            stiffness=float(board.impedance.stiffness[at]),
            damping=float(board.impedance.damping[at]),
            offset=float(board.impedance.offset[at]),
        )

    def setPid(self, joint: str, pid: Any) -> None:
        """The position regulator."""
        gains = Gains(pid.kp, pid.ki, pid.kd, pid.offset, pid.maxOutput, pid.maxIntegral)
        self._settings.set_pid(joint, gains)

    def getPid(self, joint: str) -> Any:
        """The position regulator."""
        it = self._settings.pid(joint)
        return self.types.Pid(
            kp=it.kp,
            ki=it.ki,
            kd=it.kd,
            offset=it.offset,
            maxOutput=it.max_output,
            maxIntegral=it.max_integral,
        )

    def enablePid(self, joints: Names, on: bool) -> None:
        """Switch position regulators on or off."""
        self._settings.enable_pid(some(joints), on)

    def resetPid(self, joints: Names) -> None:
        """Forget what the regulators have summed up."""
        self._settings.reset_pid(some(joints))

    def setSpeedLimits(self, joints: Names, speed: Floats) -> None:
        """Largest speeds."""
        self._settings.set_speed_limits(some(joints), speed)

    def setMaxCurrent(self, motors: Names, current: Floats) -> None:
        """The currents at which motors fault."""
        self._settings.set_max_current(some(motors), current)

    def setMotorEncoder(self, motor: str, counts: float) -> None:
        """Let the motor's counter stand at this count."""
        self._settings.set_motor_encoder([motor], counts)

    def setPositionLimits(self, joint: str, low: float, high: float) -> None:
        """Narrow the range of a joint."""
        self._settings.set_position_limits([joint], low, high)

    def setEncoder(self, joint: str, position: float) -> None:
        """Let the encoder stand at this position."""
        self._settings.set_encoder([joint], position)

    def getLastFault(self, joint: str) -> Any:
        """The last fault of a joint."""
        report = self._settings.last_fault(joint)
        return self.types.JointFault(code=int(report.code), what=report.message)

    def getVariables(self) -> list[str]:
        """The keys of the settings by name."""
        return RemoteVariables(self._board).keys()

    def getVariable(self, key: str) -> Floats:
        """A setting."""
        return RemoteVariables(self._board).get(key)

    def setVariable(self, key: str, values: Floats) -> None:
        """Change a setting."""
        RemoteVariables(self._board).set(key, values)


def some(names: Names) -> Names | None:
    """The names, or None for all."""
    return names if len(names) else None
