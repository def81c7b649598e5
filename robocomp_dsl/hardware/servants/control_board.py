"""`ControlBoard` over a control board: the board's own words, arrays as they are."""

# ruff: noqa: N802  called as in the interface

from __future__ import annotations

from collections.abc import Callable, Sequence
from typing import Any, ClassVar

import numpy as np

from robocomp_dsl.hardware.control.board import Board
from robocomp_dsl.hardware.control.commands import Commands
from robocomp_dsl.hardware.control.errors import UnknownJoint, WrongMode
from robocomp_dsl.hardware.control.joints import Bools, Floats
from robocomp_dsl.hardware.control.modes import Interaction, Mode
from robocomp_dsl.hardware.control.pid import Gains
from robocomp_dsl.hardware.control.settings import Settings
from robocomp_dsl.hardware.control.variables import RemoteVariables
from robocomp_dsl.hardware.errors import HardwareError
from robocomp_dsl.hardware.servants.servant import Servant

_MODES, _INTERACTIONS = tuple(Mode), tuple(Interaction)  # in the order of the interface
Names = Sequence[str]


class ControlBoardServant(Servant):
    """All joints of the port are on one board; an empty list of names means all."""

    FAILURES: ClassVar[tuple[tuple[type[HardwareError], str], ...]] = (
        (UnknownJoint, "UnknownJoint"),
        (WrongMode, "WrongMode"),
        (HardwareError, "Refused"),
    )

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

    def getJoints(self) -> list[Any]:
        """What joints there are."""
        board = self._board
        return [
            self.types.JointInfo(
                name=joint.name,
                prismatic=joint.prismatic,
                torqueControl=joint.torque_control,
                low=float(board.limits.low[i]),
                high=float(board.limits.high[i]),
                speedLimit=float(board.limits.speed[i]),
                torqueLimit=float(board.limits.torque[i]),
                maxCurrent=float(board.motors.max_current[i]),
                gear=float(board.motors.gear[i]),
            )
            for i, joint in enumerate(board.spec.joints)
        ]

    def getState(self) -> Any:
        """Everything that was measured last."""
        return board_state(self.types, self._board)

    def setControlMode(self, joints: Names, mode: int) -> None:
        """Ask for one control mode."""
        self._commands.set_mode(_some(joints), _MODES[mode])

    def setInteractionMode(self, joints: Names, mode: int) -> None:
        """Stiff or compliant."""
        self._commands.set_interaction(_some(joints), _INTERACTIONS[mode])

    # -- motion -------------------------------------------------------------------------------

    def positionMove(self, joints: Names, position: Floats) -> Bools:
        """Minimum jerk to these positions."""
        return self._commands.position_move(_some(joints), position)

    def relativeMove(self, joints: Names, way: Floats) -> Bools:
        """Minimum jerk by these ways."""
        return self._commands.relative_move(_some(joints), way)

    def motionDone(self, joints: Names) -> Bools:
        """Whether the motions have ended."""
        return self._commands.motion_done(_some(joints))

    def stopMotion(self, joints: Names) -> None:
        """End motions."""
        self._commands.stop(_some(joints))

    def setPosition(self, joints: Names, position: Floats) -> Bools:
        """Follow these positions at once."""
        return self._commands.set_position(_some(joints), position)

    def velocityMove(self, joints: Names, velocity: Floats, hold: float) -> Bools:
        """Turn at these speeds for `hold` s; 0: for ever."""
        return self._commands.velocity_move(_some(joints), velocity, hold or np.inf)

    def setVelocity(self, joints: Names, velocity: Floats) -> Bools:
        """Turn at these speeds at once."""
        return self._commands.set_velocity(_some(joints), velocity)

    def setTorque(self, joints: Names, torque: Floats) -> Bools:
        """Reference torques."""
        return self._commands.set_torque(_some(joints), torque)

    def setDuty(self, motors: Names, duty: Floats) -> Bools:
        """Duty cycles."""
        return self._commands.set_duty(_some(motors), duty)

    def setCurrent(self, motors: Names, current: Floats) -> Bools:
        """Currents."""
        return self._commands.set_current(_some(motors), current)

    # -- settings -----------------------------------------------------------------------------

    def setReferenceSpeed(self, joints: Names, speed: Floats) -> None:
        """Mean speeds of the next position moves."""
        self._settings.set_reference_speed(_some(joints), speed)

    def setAcceleration(self, joints: Names, acceleration: Floats) -> None:
        """How fast velocities may change."""
        self._settings.set_acceleration(_some(joints), acceleration)

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

    # -- calibration and parking --------------------------------------------------------------

    def calibrate(self, joints: Names) -> None:
        """Find the zero and go home."""
        self._begin(self.board_device().calibrator.calibrate, joints)

    def park(self, joints: Names) -> None:
        """Go to rest and switch off."""
        self._begin(self.board_device().parking.park, joints)

    def quit(self) -> None:
        """Stop calibrating and parking."""
        self.board_device().calibrator.quit()
        self.board_device().parking.quit()

    def _begin(self, lead: Callable[[Any], None], joints: Names) -> None:
        lead(self._board.select.indices(_some(joints)))


def board_state(types: Any, board: Board) -> Any:
    """The state of a board as the struct of the interface."""
    it = board.state()
    return types.BoardState(
        time=it.time,
        position=it.position,
        velocity=it.velocity,
        acceleration=it.acceleration,
        torque=it.torque,
        reference=it.reference,
        motorCounts=it.motor_counts,
        motorSpeed=it.motor_speed,
        current=it.current,
        duty=it.duty,
        temperature=it.temperature,
        modes=[types.ControlMode(_MODES.index(mode)) for mode in it.modes],
        interactions=[types.InteractionMode(_INTERACTIONS.index(i)) for i in it.interactions],
    )


def _some(names: Names) -> Names | None:
    """The names, or None for all."""
    return names if len(names) else None
