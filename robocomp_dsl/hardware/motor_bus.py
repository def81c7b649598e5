"""Motors with encoders on a bus: the Protocol of their drivers, and a control board on top.

In: a driver that reads angles and speeds and takes torques. Out: a board with all control modes and
limits, as simulated joints have it, led by a thread of its own.
"""

from __future__ import annotations

import logging
import threading
import time
from collections.abc import Mapping
from contextlib import AbstractContextManager
from types import MappingProxyType
from typing import Any, Protocol, runtime_checkable

import numpy as np

from robocomp_dsl.hardware.control.board import Board
from robocomp_dsl.hardware.control.calibration import Calibrator, Procedure
from robocomp_dsl.hardware.control.commands import Commands
from robocomp_dsl.hardware.control.faults import Fault
from robocomp_dsl.hardware.control.joints import BoardSpec, Floats
from robocomp_dsl.hardware.control.parking import Parking
from robocomp_dsl.hardware.control.settings import Settings
from robocomp_dsl.hardware.errors import HardwareError

PERIOD = 0.002
"""From step to step of the board [s]."""

_LONGEST = 10 * PERIOD
"""What a board takes for the time since its last step at most: the machine may have slept."""

log = logging.getLogger("robocomp.motors")


class MotorBus(Protocol):
    """A driver of n joints; all arrays have the shape (n,), in the order of `spec`."""

    @property
    def spec(self) -> BoardSpec:
        """The joints, their limits and motors."""

    def read(self) -> tuple[Floats, Floats]:
        """Positions [rad, m] and velocities [rad/s, m/s] now; NaN for a broken encoder."""

    def write(self, torque: Floats) -> None:
        """Let the motors give these torques [N·m, N] at the joints until the next call."""


@runtime_checkable
class FeelsTorque(Protocol):
    """A driver whose joints have sensors of torque may have this beside; without, none is felt."""

    def feel_torque(self) -> Floats:
        """The torques [N·m, N] that the joints feel now, (n,)."""


class DrivenBoard:
    """A control board on real motors. `homes` (n,) is where each joint rests [rad, m].

    All joints are one group, so that nothing stands in `groups`.
    """

    groups: Mapping[str, str] = MappingProxyType({})

    def __init__(self, bus: MotorBus, turn: AbstractContextManager[Any]) -> None:
        self._bus, self._turn = bus, turn
        self.board = Board(bus.spec)
        self.commands, self.settings = Commands(self.board), Settings(self.board)
        low, high = self.board.limits.low, self.board.limits.high
        self.homes = np.clip(np.zeros(len(low)), low, high)
        self.parking = Parking(self.board, self.homes)
        steps = tuple(Procedure(home=float(home)) for home in self.homes)
        self.calibrator = Calibrator(self.board, steps)
        self.failure = ""
        self._stopping = threading.Event()
        self._thread: threading.Thread | None = None

    def start(self) -> None:
        """Begin where the joints are, at rest; idle until a mode is chosen."""
        self.board.begin(*self._bus.read())
        self._thread = threading.Thread(target=self._live, name="motors", daemon=True)
        self._thread.start()

    def stop(self) -> None:
        """No torque any more."""
        self._stopping.set()
        if self._thread:
            self._thread.join()
            self._thread = None

    def _live(self) -> None:
        last = time.perf_counter()
        try:
            while not self._stopping.wait(max(0.0, last + PERIOD - time.perf_counter())):
                now = time.perf_counter()
                with self._turn:
                    self._step(min(now - last, _LONGEST))
                last = now
            self._bus.write(np.zeros(len(self.homes)))
        except Exception as error:  # whatever the driver raises, the joints must be known as lost
            self._lost(error)

    def _step(self, seconds: float) -> None:
        position, velocity = self._bus.read()
        looks = self.board.law.deviations
        if looks.feels:
            bus: object = self._bus
            felt = bus.feel_torque() if isinstance(bus, FeelsTorque) else self.board.torque
            looks.felt = self.board.trusted(felt)
        self._bus.write(self.board.step(position, velocity, seconds))

    def _lost(self, error: Exception) -> None:
        why = str(error) or type(error).__name__
        log.error("the motors are lost: %s", why)
        with self._turn:
            self.board.fault(np.arange(len(self.homes)), Fault.EXTERNAL, why)
            self.failure = why

    def judge(self) -> None:
        """Pass while it is led. Raises `HardwareError` after the driver has failed."""
        if self.failure:
            raise HardwareError(self.failure)
