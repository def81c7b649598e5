"""Calibration of joints whose encoders have no known zero: a state machine per joint.

In: the calibration method of each joint. Out: commands to the board, step by step:

    NOT_CONFIGURED -> SEARCH (push towards the hard stop) -> ZERO -> HOME -> CALIB_DONE -> POSITION

An absolute encoder skips the search. A time-out of the search or the home motion is a hardware
fault; force-idle clears it. The joint reports mode `CALIBRATING` meanwhile.
"""

from __future__ import annotations

from dataclasses import dataclass
from enum import Enum

import numpy as np

from robocomp_dsl.hardware.control.board import Board
from robocomp_dsl.hardware.control.errors import BadValue, ModeRefused
from robocomp_dsl.hardware.control.joints import Ints
from robocomp_dsl.hardware.control.modes import Mode
from robocomp_dsl.hardware.control.protection.faults import FaultCode

STILL = 0.01
"""A joint slower than this is at its hard stop [rad/s]."""

SETTLE = 0.2
"""Required time at the hard stop [s]."""


class CalibrationMethod(Enum):
    """How the zero of a joint is found."""

    ABSOLUTE = "absolute"
    HARD_STOP = "hard stop"


@dataclass(frozen=True, slots=True)
class Procedure:
    """Calibration settings of one joint.

    `zero` is the encoder reading at angle 0 (absolute encoders), `stop` the angle of the hard stop
    that it searches with `duty` [%]; then it moves to `home` at `speed`, all within `timeout` s.
    """

    kind: CalibrationMethod = CalibrationMethod.ABSOLUTE
    zero: float = 0.0
    duty: float = 0.0
    stop: float = 0.0
    home: float = 0.0
    speed: float = 0.3
    timeout: float = 20.0

    def __post_init__(self) -> None:
        if self.kind is CalibrationMethod.HARD_STOP and self.duty == 0.0:
            raise BadValue("a search for a hard stop needs a duty cycle")
        if self.speed <= 0.0 or self.timeout <= 0.0:
            raise BadValue("speed and timeout of a calibration must be positive")


@dataclass(slots=True)
class _Run:
    """Calibration state of one joint."""

    procedure: Procedure
    searching: bool
    elapsed: float = 0.0
    still: float = 0.0


class Calibrator:
    """Calibrates joints of a board and moves them home."""

    def __init__(self, board: Board, procedures: tuple[Procedure, ...]) -> None:
        if len(procedures) != len(board.spec.joints):
            raise BadValue(f"{len(board.spec.joints)} joints need as many calibration procedures")
        self._board, self._procedures = board, procedures
        self._runs: dict[int, _Run] = {}
        board.motion_overrides.append(self.step)

    def calibrate(self, joints: Ints | None = None) -> None:
        """Start with `joints`, or all. Raises `ModeRefused` for a joint with a fault."""
        chosen = self._board.select.indices(joints)
        for joint in chosen.tolist():
            if self._board.table.modes[joint] is Mode.HW_FAULT:
                name = self._board.spec.names[joint]
                raise ModeRefused(f"`{name}` has a hardware fault; clear it first (`fidl`)")
        for joint in chosen.tolist():
            self._begin(joint)

    def home(self, joints: Ints | None = None) -> None:
        """Move calibrated joints home; raises `ModeRefused` for uncalibrated joints."""
        chosen = self._board.select.indices(joints)
        self._board.set_modes(chosen, [Mode.POSITION] * len(chosen))
        for joint in chosen.tolist():
            self._go_home(joint, self._procedures[joint])

    def quit(self, joints: Ints | None = None) -> None:
        """Abort; the joints stay uncalibrated and idle."""
        for joint in self._runs.keys() & set(self._board.select.indices(joints).tolist()):
            self._board.table.calibrated[joint] = False
            self._board.force_mode(joint, Mode.NOT_CONFIGURED)
            del self._runs[joint]

    def leads_any(self, joints: Ints) -> bool:
        """Whether any of `joints` is still being calibrated."""
        return not self._runs.keys().isdisjoint(joints.tolist())

    @property
    def busy(self) -> bool:
        """Whether any joint is still being calibrated."""
        return bool(self._runs)

    def step(self, dt: float) -> None:
        """Called by the board at every step."""
        if not self._runs:
            return
        for joint, run in list(self._runs.items()):
            if self._board.table.modes[joint] is not Mode.CALIBRATING:
                del self._runs[joint]  # force-idle or a fault has changed the joint's mode
                continue
            run.elapsed += dt
            if run.elapsed > run.procedure.timeout:
                del self._runs[joint]
                self._board.fault(
                    np.array([joint]), FaultCode.CALIBRATION, "calibration took too long"
                )
            elif run.searching:
                self._search(joint, run, dt)
            elif not self._board.references.trajectory.moving[joint]:
                del self._runs[joint]
                self._board.force_mode(joint, Mode.CALIB_DONE)
                self._board.force_mode(joint, Mode.POSITION)

    def _begin(self, joint: int) -> None:
        procedure = self._procedures[joint]
        self._board.table.calibrated[joint] = False
        self._runs[joint] = _Run(procedure, searching=procedure.kind is CalibrationMethod.HARD_STOP)
        if procedure.kind is CalibrationMethod.HARD_STOP:
            self._board.force_mode(joint, Mode.CALIBRATING, Mode.PWM)
            self._board.law.duty[joint] = procedure.duty
            self._board.law.apply()
        else:
            reading = self._board.position[joint] - self._board.offset[joint]
            self._zero(joint, procedure, reading - procedure.zero)

    def _search(self, joint: int, run: _Run, dt: float) -> None:
        still = abs(self._board.velocity[joint]) < STILL
        run.still = run.still + dt if still else 0.0
        if run.still >= SETTLE:
            run.searching = False
            self._zero(joint, run.procedure, run.procedure.stop)

    def _zero(self, joint: int, procedure: Procedure, angle: float) -> None:
        """The encoder is zeroed; the motion to the home position starts."""
        self._board.set_encoders(np.array([joint]), np.array([angle]))
        self._board.table.calibrated[joint] = True
        self._board.force_mode(joint, Mode.CALIBRATING, Mode.POSITION)
        self._go_home(joint, procedure)

    def _go_home(self, joint: int, procedure: Procedure) -> None:
        index = np.array([joint])
        goal, _ = self._board.limits.clip(index, np.array([procedure.home]))
        speed = np.array([procedure.speed])
        self._board.references.move(index, goal, self._board.dt, speed)
