"""`ControlBoard` over a control board, without conversion of arrays.

A port serves all joints of a board, or a group of them.
"""

# ruff: noqa: N802  called as in the interface

from __future__ import annotations

from collections.abc import Callable, Sequence
from typing import Any, ClassVar

import numpy as np

from robocomp_dsl.hardware.control.errors import UnknownJoint, WrongMode
from robocomp_dsl.hardware.control.joints import Bools, Floats
from robocomp_dsl.hardware.control.modes import Interaction, Mode
from robocomp_dsl.hardware.control.targets import targets
from robocomp_dsl.hardware.devices.errors import HardwareError
from robocomp_dsl.hardware.servants.joints.control_board_settings import BoardSettings, Names

_MODES, _INTERACTIONS = tuple(Mode), tuple(Interaction)  # in the order of the interface


class _StateConverter:
    """Converts modes to values of the interface; caches the list until a mode changes."""

    def __init__(self, order: Sequence[Any]) -> None:
        self._order = order
        self._modes: Sequence[Any] = ()
        self._values: list[Any] = []

    def to_message(self, enum: Callable[[int], Any], modes: Sequence[Any]) -> list[Any]:
        """The `modes` as values of `enum`, in a new list."""
        if modes != self._modes:
            self._values = [enum(self._order.index(mode)) for mode in modes]
            self._modes = modes
        return self._values.copy()


class ControlBoardServant(BoardSettings):
    """All joints of the port are on one board; an empty list of names means all of the port."""

    FAILURES: ClassVar[tuple[tuple[type[HardwareError], str], ...]] = (
        (UnknownJoint, "UnknownJoint"),
        (WrongMode, "WrongMode"),
        (HardwareError, "Refused"),
    )

    def __init__(self, *arguments: Any) -> None:
        super().__init__(*arguments)
        self._modes, self._interactions = _StateConverter(_MODES), _StateConverter(_INTERACTIONS)

    def getJoints(self) -> list[Any]:
        """Properties of the joints."""
        board, here = self._board, self._listed
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
                counts=float(board.motors.counts[i]),
                coupledSet=here.index(int(board.table.coupled(np.array([i]))[0])),
            )
            for i in here
            for joint in [board.spec.joints[i]]
        ]

    def getState(self) -> Any:
        """The latest measurements."""
        it, listed = self._board.state(), self._listed
        here = self._rows
        return self.types.BoardState(
            time=it.time,
            position=it.position[here],
            velocity=it.velocity[here],
            acceleration=it.acceleration[here],
            torque=it.torque[here],
            reference=it.reference[here],
            motorCounts=it.motor_counts[here],
            motorSpeed=it.motor_speed[here],
            current=it.current[here],
            duty=it.duty[here],
            temperature=it.temperature[here],
            modes=self._modes.to_message(self.types.ControlMode, [it.modes[i] for i in listed]),
            interactions=self._interactions.to_message(
                self.types.InteractionMode, [it.interactions[i] for i in listed]
            ),
            faults=it.faults[here],
        )

    def getTargets(self, joints: Names) -> Any:
        """The last accepted references."""
        it = targets(self._board, self._some(joints))
        return self.types.Targets(
            position=it.position,
            velocity=it.velocity,
            torque=it.torque,
            duty=it.duty,
            current=it.current,
        )

    def setControlModes(self, joints: Names, modes: Sequence[int]) -> None:
        """Set a control mode per joint."""
        self._commands.set_mode(self._some(joints), [_MODES[mode] for mode in modes])

    def setControlMode(self, joints: Names, mode: int) -> None:
        """Set one control mode for these joints."""
        self._commands.set_mode(self._some(joints), _MODES[mode])

    def setInteractionMode(self, joints: Names, mode: int) -> None:
        """Stiff or compliant."""
        self._commands.set_interaction(self._some(joints), _INTERACTIONS[mode])

    # -- motion -------------------------------------------------------------------------------

    def positionMove(self, joints: Names, position: Floats) -> Bools:
        """Minimum-jerk motion to these positions."""
        return self._commands.position_move(self._some(joints), position)

    def relativeMove(self, joints: Names, way: Floats) -> Bools:
        """Minimum-jerk motion by these distances."""
        return self._commands.relative_move(self._some(joints), way)

    def motionDone(self, joints: Names) -> Bools:
        """Whether the motions are complete."""
        return self._commands.motion_done(self._some(joints))

    def stopMotion(self, joints: Names) -> None:
        """Stop motions."""
        self._commands.stop(self._some(joints))

    def setPosition(self, joints: Names, position: Floats) -> Bools:
        """Follow these positions without a trajectory."""
        return self._commands.set_position(self._some(joints), position)

    def velocityMove(self, joints: Names, velocity: Floats, hold: float) -> Bools:
        """Move at these speeds for `hold` s; 0: without limit."""
        return self._commands.velocity_move(self._some(joints), velocity, hold or np.inf)

    def setVelocity(self, joints: Names, velocity: Floats) -> Bools:
        """Move at these speeds without a ramp."""
        return self._commands.set_velocity(self._some(joints), velocity)

    def setTorque(self, joints: Names, torque: Floats) -> Bools:
        """Reference torques."""
        return self._commands.set_torque(self._some(joints), torque)

    def setDuty(self, motors: Names, duty: Floats) -> Bools:
        """Duty cycles."""
        return self._commands.set_duty(self._some(motors), duty)

    def setCurrent(self, motors: Names, current: Floats) -> Bools:
        """Currents."""
        return self._commands.set_current(self._some(motors), current)

    # -- calibration and parking --------------------------------------------------------------

    def calibrate(self, joints: Names) -> None:
        """Find the zero and move home."""
        self._begin(self.board_device().calibrator.calibrate, joints)

    def home(self, joints: Names) -> None:
        """Move calibrated joints home."""
        self._begin(self.board_device().calibrator.home, joints)

    def park(self, joints: Names) -> None:
        """Move to the parking position and switch off."""
        self._begin(self.board_device().parking.park, joints)

    def isBusy(self) -> bool:
        """Whether joints are being calibrated or parked."""
        device, here = self.board_device(), self._joints
        return bool(device.calibrator.leads_any(here) or device.parking.leads_any(here))

    def quit(self) -> None:
        """Abort calibration and parking."""
        self.board_device().calibrator.quit(self._joints)
        self.board_device().parking.quit(self._joints)

    def _begin(self, lead: Callable[[Any], None], joints: Names) -> None:
        lead(self._some(joints))
