"""Kinds of devices around control boards: the boards, their calibrators, Cartesian controllers.

In: boards or parts of them, simulated or real, by name, and the lock of the thread that steps them.
Out: kinds for a device manager. Parameters of single joints have a dot: `home.elbow = 0.5`.
"""

from __future__ import annotations

import threading
from collections.abc import Callable, Mapping
from contextlib import AbstractContextManager
from dataclasses import dataclass
from functools import partial
from typing import Any

import numpy as np

from robocomp_dsl.hardware.control.board import Board
from robocomp_dsl.hardware.control.calibration import Calibrator, Procedure
from robocomp_dsl.hardware.control.commands import Commands
from robocomp_dsl.hardware.control.errors import BadValue
from robocomp_dsl.hardware.control.joints import Ints
from robocomp_dsl.hardware.control.modes import Mode
from robocomp_dsl.hardware.control.parking import Parking, ParkState
from robocomp_dsl.hardware.device_manager.description import DeviceSpec
from robocomp_dsl.hardware.device_manager.kinds import ActionFailed, DeviceKind
from robocomp_dsl.hardware.devices.errors import CommandRefused
from robocomp_dsl.hardware.kinematics.cartesian import JointChain
from robocomp_dsl.hardware.kinematics.cartesian_controller import CartesianController

BoardLock = AbstractContextManager[Any]

POLL = 0.005
"""Polling period for the end of an action [s]."""


@dataclass(frozen=True, slots=True)
class BoardPart:
    """Some joints of a board, by their names."""

    board: Board
    joints: tuple[str, ...]


ChainFactory = Callable[[DeviceSpec, tuple[str, ...]], tuple[JointChain, tuple[str, ...]]]
"""Creates the chain of a Cartesian controller from joints of its board."""


class BoardDevice:
    """A board, or a part of one, that others attach to; closing it switches the motors off."""

    def __init__(self, part: BoardPart, turn: BoardLock) -> None:
        self.board, self.joints, self.lock = part.board, part.joints, turn
        self.commands = Commands(part.board)

    @property
    def indices(self) -> Ints:
        """Indices of its joints on the board."""
        return self.board.select.indices(self.joints)

    def close(self) -> None:
        """Switch the motors off."""
        with self.lock:
            self.commands.set_mode(self.joints, Mode.FORCE_IDLE)


@dataclass(slots=True)
class _LedBoard:
    """A board under a calibrator."""

    device: BoardDevice
    calibrator: Calibrator
    parking: Parking


class CalibratorDevice:
    """Calibrates and parks the boards that it is attached to.

    Parameters: `speed` [rad/s], `timeout` [s], and for joints `home.J`, `park.J`, `zero.J` [rad].
    """

    def __init__(self, spec: DeviceSpec) -> None:
        self._spec = spec
        self._speed, self._timeout = _number(spec, "speed", 0.3), _number(spec, "timeout", 20.0)
        self._led: dict[str, _LedBoard] = {}

    def attach(self, devices: Mapping[str, Any]) -> None:
        """Attach boards. Raises `CommandRefused` for other devices and invalid parameters."""
        boards = {name: _board_of(name, device) for name, device in devices.items()}
        _known_joints(self._spec, boards, ("home", "park", "zero"), ("speed", "timeout"))
        for name, device in boards.items():
            with device.lock:
                self._led[name] = self._lead(device)

    def detach(self) -> None:
        """Detach the boards."""
        for led in self._led.values():
            with led.device.lock:
                led.device.board.motion_overrides.remove(led.calibrator.step)
                led.device.board.motion_overrides.remove(led.parking.step)
        self._led.clear()

    def close(self) -> None:
        """Nothing to release except boards."""

    def calibrate(self, target: str, stop: threading.Event) -> None:
        """Find the zero of all joints of a board; `ActionFailed` names the failed joints."""
        led = self._led[target]
        joints = led.device.indices
        _run_until_done(
            led.device.lock, partial(led.calibrator.calibrate, joints), led.calibrator, stop
        )
        board = led.device.board
        bad = [board.spec.names[i] for i in joints.tolist() if board.table.modes[i] in _FAILED]
        _raise_unfinished(f"{target}: not calibrated", bad, stop)

    def park(self, target: str, stop: threading.Event) -> None:
        """Move all joints of a board to their positions; raises `ActionFailed` like `calibrate`."""
        led = self._led[target]
        joints = led.device.indices
        _run_until_done(led.device.lock, partial(led.parking.park, joints), led.parking, stop)
        names, states = led.device.board.spec.names, led.parking.states
        bad = [names[i] for i in joints.tolist() if states[i] is not ParkState.PARKED]
        _raise_unfinished(f"{target}: not parked", bad, stop)

    def _lead(self, device: BoardDevice) -> _LedBoard:
        board, spec = device.board, self._spec
        names = board.spec.names
        procedures = tuple(
            Procedure(
                zero=_number(spec, f"zero.{name}", 0.0),
                home=_number(spec, f"home.{name}", 0.0),
                speed=self._speed,
                timeout=self._timeout,
            )
            for name in names
        )
        pose = np.array(
            [_number(spec, f"park.{n}", p.home) for n, p in zip(names, procedures, strict=True)]
        )
        parking = Parking(board, pose, self._speed, self._timeout)
        return _LedBoard(device, Calibrator(board, procedures), parking)


class CartesianDevice:
    """A Cartesian controller; `controller` exists while it is attached to a board."""

    def __init__(self, spec: DeviceSpec, chain: ChainFactory) -> None:
        self._spec, self._chain = spec, chain
        self.controller: CartesianController | None = None
        self._board: BoardDevice | None = None

    def attach(self, devices: Mapping[str, Any]) -> None:
        """Control the arm of one board."""
        (name,) = devices
        self._board = _board_of(name, devices[name])
        with self._board.lock:
            chain = self._chain(self._spec, self._board.joints)
            self.controller = CartesianController(self._board.board, *chain)

    def detach(self) -> None:
        """Stop, and release the arm."""
        if self._board is not None and self.controller is not None:
            with self._board.lock:
                self.controller.stop()
                self._board.board.motion_overrides.remove(self.controller.step)
        self.controller = self._board = None

    def close(self) -> None:
        """Nothing to release."""


_FAILED = (Mode.HW_FAULT, Mode.NOT_CONFIGURED, Mode.CALIBRATING)


def board_kinds(
    boards: Mapping[str, BoardPart], lock: BoardLock, chain: ChainFactory
) -> dict[str, DeviceKind]:
    """The kinds `control_board` (parameter `part`), `calibrator` and `cartesian`."""

    def board(spec: DeviceSpec) -> BoardDevice:
        return BoardDevice(_chosen(spec, "part", boards), lock)

    return {
        "control_board": DeviceKind(board),
        "calibrator": DeviceKind(CalibratorDevice, max_attached=64, calibrates=True),
        "cartesian": DeviceKind(lambda spec: CartesianDevice(spec, chain), max_attached=1),
    }


def _chosen(spec: DeviceSpec, key: str, among: Mapping[str, Any]) -> Any:
    """The item that a parameter names; by default the one with the name of the device."""
    requested = str(spec.parameters.get(key, spec.name))
    if requested not in among:
        there = ", ".join(among) or "none"
        raise CommandRefused(f"device `{spec.name}`: there is no {key} `{requested}`: {there}")
    return among[requested]


def _board_of(name: str, device: object) -> BoardDevice:
    if not isinstance(device, BoardDevice):
        raise CommandRefused(f"`{name}` is not a control board")
    return device


def _known_joints(
    spec: DeviceSpec,
    boards: Mapping[str, BoardDevice],
    groups: tuple[str, ...],
    plain: tuple[str, ...],
) -> None:
    """Raise `BadValue` for a parameter that belongs to no joint of the boards."""
    joints = {name for board in boards.values() for name in board.joints}
    for key in spec.parameters:
        group, _, joint = key.partition(".")
        if key not in plain and (group not in groups or joint not in joints):
            raise BadValue(f"device `{spec.name}`: there is no parameter `{key}`")


def _number(spec: DeviceSpec, key: str, usual: float) -> float:
    value = spec.parameters.get(key, usual)
    if isinstance(value, bool | str) or not np.isfinite(value):
        raise BadValue(f"device `{spec.name}`: `{key}` must be a number")
    return float(value)


def _run_until_done(
    turn: BoardLock, begin: Callable[[], None], led: Calibrator | Parking, stop: threading.Event
) -> None:
    """Call `begin`, and poll until it is complete; abort when `stop` is set."""
    with turn:
        begin()
    while True:
        with turn:
            if not led.busy:
                return
            if stop.is_set():
                led.quit()
                return
        stop.wait(POLL)


def _raise_unfinished(what: str, joints: list[str], stop: threading.Event) -> None:
    """Raise `ActionFailed` if joints are not finished."""
    if joints:
        early = "stopped before the end, " if stop.is_set() else ""
        raise ActionFailed(f"{what}: {early}{', '.join(joints)}")
