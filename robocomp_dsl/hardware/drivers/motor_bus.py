"""Motors with encoders on a bus: the Protocol of their drivers, and a control board on top.

In: a driver that reads angles and speeds and accepts torques. Out: a board with all control modes
and limits, like simulated joints, stepped by its own thread.
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
from robocomp_dsl.hardware.control.joints import BoardSpec, Floats
from robocomp_dsl.hardware.control.parking import Parking
from robocomp_dsl.hardware.control.protection.faults import FaultCode
from robocomp_dsl.hardware.control.settings import ControlSettings
from robocomp_dsl.hardware.devices.errors import HardwareError

PERIOD = 0.002
"""Period of the board [s]."""

_LONGEST = 10 * PERIOD
"""Maximum time step of a board: the machine may have been suspended."""

log = logging.getLogger("robocomp.motors")


class MotorBus(Protocol):
    """A driver of n joints; all arrays have the shape (n,), in the order of `spec`."""

    @property
    def spec(self) -> BoardSpec:
        """The joints, their limits and motors."""

    def read(self) -> tuple[Floats, Floats]:
        """Current positions [rad, m] and velocities [rad/s, m/s]; NaN for a broken encoder."""

    def write(self, torque: Floats) -> None:
        """Set the torques [N·m, N] at the joints until the next call."""


@runtime_checkable
class HasTorqueSensors(Protocol):
    """Implemented by drivers whose joints have torque sensors."""

    def read_torque(self) -> Floats:
        """The measured torques [N·m, N] at the joints, (n,)."""


class HardwareBoard:
    """A control board on real motors. `homes` (n,) are the rest positions [rad, m].

    All joints are in one group, so `groups` is empty.
    """

    groups: Mapping[str, str] = MappingProxyType({})

    def __init__(self, bus: MotorBus, turn: AbstractContextManager[Any]) -> None:
        self._bus, self._lock = bus, turn
        self.board = Board(bus.spec)
        self.commands, self.settings = Commands(self.board), ControlSettings(self.board)
        low, high = self.board.limits.low, self.board.limits.high
        self.homes = np.clip(np.zeros(len(low)), low, high)
        self.parking = Parking(self.board, self.homes)
        steps = tuple(Procedure(home=float(home)) for home in self.homes)
        self.calibrator = Calibrator(self.board, steps)
        self.failure = ""
        self._stopping = threading.Event()
        self._thread: threading.Thread | None = None

    def start(self) -> None:
        """Start at the measured positions, at rest; joints are idle until a mode is set."""
        self.board.begin(*self._bus.read())
        self._thread = threading.Thread(target=self._control_loop, name="motors", daemon=True)
        self._thread.start()

    def stop(self) -> None:
        """Stop the thread and set all torques to 0."""
        self._stopping.set()
        if self._thread:
            self._thread.join()
            self._thread = None

    def _control_loop(self) -> None:
        last = time.perf_counter()
        try:
            while not self._stopping.wait(max(0.0, last + PERIOD - time.perf_counter())):
                now = time.perf_counter()
                with self._lock:
                    self._step(min(now - last, _LONGEST))
                last = now
            self._bus.write(np.zeros(len(self.homes)))
        except Exception as error:  # any exception of the driver must fault the joints
            self._fail(error)

    def _step(self, seconds: float) -> None:
        position, velocity = self._bus.read()
        looks = self.board.law.errors
        if looks.needs_torque:
            bus: object = self._bus
            felt = bus.read_torque() if isinstance(bus, HasTorqueSensors) else self.board.torque
            looks.measured_torque = self.board.check_torque(felt)
        self._bus.write(self.board.step(position, velocity, seconds))

    def _fail(self, error: Exception) -> None:
        why = str(error) or type(error).__name__
        log.error("the motor driver failed: %s", why)
        with self._lock:
            self.board.fault(np.arange(len(self.homes)), FaultCode.EXTERNAL, why)
            self.failure = why

    def raise_if_failed(self) -> None:
        """Raises `HardwareError` after the driver has failed."""
        if self.failure:
            raise HardwareError(self.failure)
