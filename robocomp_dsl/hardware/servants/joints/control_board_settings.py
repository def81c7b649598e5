"""The settings of a control board as operations of `ControlBoard`; they cause no motion.

All joints of a world are on one board, which steps them together; a port serves those of its group.
"""

# ruff: noqa: N802  called as in the interface

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

import numpy as np

from robocomp_dsl.hardware.control.board import Board
from robocomp_dsl.hardware.control.commands import Commands
from robocomp_dsl.hardware.control.errors import UnknownJoint
from robocomp_dsl.hardware.control.joints import Bools, Floats, Ints, run
from robocomp_dsl.hardware.control.regulators.loops import Loop
from robocomp_dsl.hardware.control.regulators.pid import Gains
from robocomp_dsl.hardware.control.settings import ControlSettings
from robocomp_dsl.hardware.control.variables import RemoteVariables
from robocomp_dsl.hardware.servants.servant import Servant

Names = Sequence[str]
_LOOPS = tuple(Loop)  # in the order of the interface


class BoardSettings(Servant):
    """The part of a `ControlBoard` servant that reads and writes settings."""

    def __init__(self, *arguments: Any) -> None:
        super().__init__(*arguments)
        self._known: object = None
        self._here = np.empty(0, dtype=np.int64)
        self._rows: slice | Ints = self._here
        self._numbers: dict[str, int] = {}

    @property
    def _board(self) -> Board:
        found: Board = self.board_device().board
        return found

    @property
    def _joints(self) -> Ints:
        """Indices of the port's joints on the board, in order."""
        self._look(self.board_device())
        return self._here

    def _look(self, device: Any) -> None:
        """The joints of `device` that belong to the port; `_rows` is the same as an index."""
        if device is self._known:
            return
        mine = device.groups.get(self.ids[0], "")
        names = device.board.spec.names
        chosen = [i for i, name in enumerate(names) if device.groups.get(name, "") == mine]
        self._here = np.array(chosen, dtype=np.int64)
        self._rows = run(self._here)
        self._numbers = {names[i]: i for i in chosen}
        self._known = device

    @property
    def _listed(self) -> list[int]:
        found: list[int] = self._joints.tolist()
        return found

    def _some(self, names: Names) -> Ints:
        """The named joints, all of the port if empty. Raises `UnknownJoint`."""
        here = self._joints
        if not len(names):
            return here
        chosen = self._board.select.indices(names)
        for name in names:
            if name not in self._numbers:
                listed = ", ".join(self._numbers)
                raise UnknownJoint(f"`{name}` is not on `{self.port}`: {listed}")
        return chosen

    def _joint_index(self, name: str) -> int:
        return int(self._some([name])[0])

    @property
    def _variables(self) -> RemoteVariables:
        return RemoteVariables(self._board, self._joints)

    @property
    def _commands(self) -> Commands:
        return Commands(self._board)

    @property
    def _settings(self) -> ControlSettings:
        return ControlSettings(self._board)

    def setReferenceSpeed(self, joints: Names, speed: Floats) -> None:
        """Set the mean speeds of later position motions."""
        self._settings.set_reference_speed(self._some(joints), speed)

    def setAcceleration(self, joints: Names, acceleration: Floats) -> None:
        """Set the acceleration limits of velocity commands."""
        self._settings.set_acceleration(self._some(joints), acceleration)

    def getReferenceSpeed(self, joints: Names) -> Floats:
        """The mean speeds of position motions."""
        return self._settings.reference_speed(self._some(joints))

    def getAcceleration(self, joints: Names) -> Floats:
        """The acceleration limits of velocity commands."""
        return self._settings.acceleration(self._some(joints))

    def setImpedance(self, joint: str, impedance: Any) -> None:
        """Set stiffness, damping and torque offset."""
        self._settings.set_impedance(self._some([joint]), impedance.stiffness, impedance.damping)
        self._settings.set_impedance_offset(self._some([joint]), impedance.offset)

    def getImpedance(self, joint: str) -> Any:
        """Stiffness, damping and torque offset."""
        board = self._board
        at = self._joint_index(joint)
        return self.types.Impedance(
            stiffness=float(board.impedance.stiffness[at]),
            damping=float(board.impedance.damping[at]),
            offset=float(board.impedance.offset[at]),
        )

    def setPid(self, loop: int, joint: str, pid: Any) -> None:
        """Set the gains of a PID controller."""
        gains = Gains(
            pid.kp,
            pid.ki,
            pid.kd,
            pid.offset,
            pid.maxOutput,
            pid.maxIntegral,
            pid.feedforward,
        )
        self._settings.set_pid(self._joint_index(joint), gains, _LOOPS[loop])

    def getPid(self, loop: int, joint: str) -> Any:
        """The gains of a PID controller."""
        it = self._settings.pid(self._joint_index(joint), _LOOPS[loop])
        return self.types.Pid(
            kp=it.kp,
            ki=it.ki,
            kd=it.kd,
            offset=it.offset,
            maxOutput=it.max_output,
            maxIntegral=it.max_integral,
            feedforward=it.feedforward,
        )

    def enablePid(self, loop: int, joints: Names, on: bool) -> None:
        """Enable or disable PID controllers."""
        self._settings.enable_pid(self._some(joints), on, _LOOPS[loop])

    def isPidEnabled(self, loop: int, joints: Names) -> Bools:
        """Which PID controllers are enabled."""
        return self._settings.pid_enabled(self._some(joints), _LOOPS[loop])

    def resetPid(self, loop: int, joints: Names) -> None:
        """Reset the integrals of the controllers."""
        self._settings.reset_pid(self._some(joints), _LOOPS[loop])

    def getPidReferences(self, loop: int, joints: Names) -> Floats:
        """The references of the controllers."""
        return self._settings.pid_reference(self._some(joints), _LOOPS[loop])

    def getPidErrors(self, loop: int, joints: Names) -> Floats:
        """The errors of the controllers."""
        return self._settings.pid_error(self._some(joints), _LOOPS[loop])

    def getPidOutputs(self, loop: int, joints: Names) -> Floats:
        """The outputs of the controllers."""
        return self._settings.pid_output(self._some(joints), _LOOPS[loop])

    def setSpeedLimits(self, joints: Names, speed: Floats) -> None:
        """Maximum speeds."""
        self._settings.set_speed_limits(self._some(joints), speed)

    def setMaxCurrent(self, motors: Names, current: Floats) -> None:
        """The currents at which motors fault."""
        self._settings.set_max_current(self._some(motors), current)

    def setMotorEncoder(self, motor: str, counts: float) -> None:
        """Set the encoder count of a motor."""
        self._settings.set_motor_encoder(self._some([motor]), counts)

    def setPositionLimits(self, joint: str, low: float, high: float) -> None:
        """Narrow the range of a joint."""
        self._settings.set_position_limits(self._some([joint]), low, high)

    def setEncoder(self, joint: str, position: float) -> None:
        """Set the encoder reading of a joint."""
        self._settings.set_encoder(self._some([joint]), position)

    def getLastFault(self, joint: str) -> Any:
        """The last fault of a joint."""
        report = self._settings.last_fault(self._joint_index(joint))
        return self.types.JointFault(code=int(report.code), what=report.message)

    def getVariables(self) -> list[str]:
        """The keys of the settings by name."""
        return self._variables.keys()

    def getVariable(self, key: str) -> Floats:
        """A setting."""
        return self._variables.get(key)

    def setVariable(self, key: str, values: Floats) -> None:
        """Change a setting."""
        self._variables.set(key, values)
