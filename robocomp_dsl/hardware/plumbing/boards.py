"""Kinds of devices around control boards: the boards, their calibrators, Cartesian controllers.

In: boards or parts of them, simulated or real, by name, and the lock of the thread that steps them.
Out: kinds for a conductor. Parameters of single joints are written with a dot: `home.elbow = 0.5`.
"""

from __future__ import annotations

import threading
from collections.abc import Callable, Mapping
from contextlib import AbstractContextManager
from dataclasses import dataclass
from functools import partial
from typing import Any

import numpy as np

from robocomp_dsl.hardware.cartesian import Chain
from robocomp_dsl.hardware.cartesian_controller import CartesianController
from robocomp_dsl.hardware.control.board import Board
from robocomp_dsl.hardware.control.calibration import Calibrator, Procedure
from robocomp_dsl.hardware.control.commands import Commands
from robocomp_dsl.hardware.control.errors import BadValue
from robocomp_dsl.hardware.control.joints import Ints
from robocomp_dsl.hardware.control.modes import Mode
from robocomp_dsl.hardware.control.parking import Parking, ParkState
from robocomp_dsl.hardware.errors import CommandRefused
from robocomp_dsl.hardware.plumbing.description import DeviceSpec
from robocomp_dsl.hardware.plumbing.kinds import ActionFailed, Kind

Turn = AbstractContextManager[Any]

POLL = 0.005
"""How often it is looked whether a board has come to the end of something [s]."""


@dataclass(frozen=True, slots=True)
class BoardPart:
    """Some joints of a board, by their names."""

    board: Board
    joints: tuple[str, ...]


ChainOf = Callable[[DeviceSpec, tuple[str, ...]], tuple[Chain, tuple[str, ...]]]
"""The chain that a Cartesian controller shall have, made of joints of its board."""


class BoardDevice:
    """A board, or a part of one, that others may stand on; motors are off when it is closed."""

    def __init__(self, part: BoardPart, turn: Turn) -> None:
        self.board, self.joints, self.turn = part.board, part.joints, turn
        self.commands = Commands(part.board)

    @property
    def indices(self) -> Ints:
        """Where its joints are on the board."""
        return self.board.select.indices(self.joints)

    def close(self) -> None:
        """Switch the motors off."""
        with self.turn:
            self.commands.set_mode(self.joints, Mode.FORCE_IDLE)


@dataclass(slots=True)
class _Led:
    """A board under a calibrator."""

    device: BoardDevice
    calibrator: Calibrator
    parking: Parking


class CalibratorDevice:
    """Calibrates and parks the boards that it stands on.

    Parameters: `speed` [rad/s], `timeout` [s], and for joints `home.J`, `park.J`, `zero.J` [rad].
    """

    def __init__(self, spec: DeviceSpec) -> None:
        self._spec = spec
        self._speed, self._timeout = _number(spec, "speed", 0.3), _number(spec, "timeout", 20.0)
        self._led: dict[str, _Led] = {}

    def attach(self, devices: Mapping[str, Any]) -> None:
        """Take over boards. Raises `CommandRefused` for other devices and parameters."""
        boards = {name: _board_of(name, one) for name, one in devices.items()}
        _known_joints(self._spec, boards, ("home", "park", "zero"), ("speed", "timeout"))
        for name, one in boards.items():
            with one.turn:
                self._led[name] = self._lead(one)

    def detach(self) -> None:
        """Let go of the boards."""
        for one in self._led.values():
            with one.device.turn:
                one.device.board.leaders.remove(one.calibrator.step)
                one.device.board.leaders.remove(one.parking.step)
        self._led.clear()

    def close(self) -> None:
        """Nothing is held but boards."""

    def calibrate(self, target: str, stop: threading.Event) -> None:
        """Let all joints of a board find their zero; `ActionFailed` names those that do not."""
        one = self._led[target]
        joints = one.device.indices
        _follow(one.device.turn, partial(one.calibrator.calibrate, joints), one.calibrator, stop)
        board = one.device.board
        bad = [board.spec.names[i] for i in joints.tolist() if board.table.modes[i] in _FAILED]
        _end(f"{target}: not calibrated", bad, stop)

    def park(self, target: str, stop: threading.Event) -> None:
        """Bring all joints of a board to their places; raises `ActionFailed` as `calibrate`."""
        one = self._led[target]
        joints = one.device.indices
        _follow(one.device.turn, partial(one.parking.park, joints), one.parking, stop)
        names, states = one.device.board.spec.names, one.parking.states
        bad = [names[i] for i in joints.tolist() if states[i] is not ParkState.PARKED]
        _end(f"{target}: not parked", bad, stop)

    def _lead(self, device: BoardDevice) -> _Led:
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
        return _Led(device, Calibrator(board, procedures), parking)


class CartesianDevice:
    """A Cartesian controller; `controller` is there while it stands on a board."""

    def __init__(self, spec: DeviceSpec, chain: ChainOf) -> None:
        self._spec, self._chain = spec, chain
        self.controller: CartesianController | None = None
        self._below: BoardDevice | None = None

    def attach(self, devices: Mapping[str, Any]) -> None:
        """Take over the arm of one board."""
        (name,) = devices
        self._below = _board_of(name, devices[name])
        with self._below.turn:
            made = self._chain(self._spec, self._below.joints)
            self.controller = CartesianController(self._below.board, *made)

    def detach(self) -> None:
        """Stop, and let go of the arm."""
        if self._below is not None and self.controller is not None:
            with self._below.turn:
                self.controller.stop()
                self._below.board.leaders.remove(self.controller.step)
        self.controller = self._below = None

    def close(self) -> None:
        """Nothing is held but the board."""


_FAILED = (Mode.HW_FAULT, Mode.NOT_CONFIGURED, Mode.CALIBRATING)


def board_kinds(boards: Mapping[str, BoardPart], turn: Turn, chain: ChainOf) -> dict[str, Kind]:
    """The kinds `control_board` (parameter `part`), `calibrator` and `cartesian`."""

    def board(spec: DeviceSpec) -> BoardDevice:
        return BoardDevice(_chosen(spec, "part", boards), turn)

    return {
        "control_board": Kind(board),
        "calibrator": Kind(CalibratorDevice, most=64, calibrates=True),
        "cartesian": Kind(lambda spec: CartesianDevice(spec, chain), most=1),
    }


def _chosen(spec: DeviceSpec, key: str, among: Mapping[str, Any]) -> Any:
    """What a parameter names; the device's own name where it is not given."""
    wanted = str(spec.parameters.get(key, spec.name))
    if wanted not in among:
        there = ", ".join(among) or "none"
        raise CommandRefused(f"device `{spec.name}`: there is no {key} `{wanted}`: {there}")
    return among[wanted]


def _board_of(name: str, device: object) -> BoardDevice:
    if not isinstance(device, BoardDevice):
        raise CommandRefused(f"`{name}` is no control board")
    return device


def _known_joints(
    spec: DeviceSpec,
    boards: Mapping[str, BoardDevice],
    groups: tuple[str, ...],
    plain: tuple[str, ...],
) -> None:
    """Raise `BadValue` for a parameter that belongs to no joint of the boards."""
    joints = {name for one in boards.values() for name in one.joints}
    for key in spec.parameters:
        group, _, joint = key.partition(".")
        if key not in plain and (group not in groups or joint not in joints):
            raise BadValue(f"device `{spec.name}`: there is no parameter `{key}`")


def _number(spec: DeviceSpec, key: str, usual: float) -> float:
    value = spec.parameters.get(key, usual)
    if isinstance(value, bool | str) or not np.isfinite(value):
        raise BadValue(f"device `{spec.name}`: `{key}` must be a number")
    return float(value)


def _follow(
    turn: Turn, begin: Callable[[], None], led: Calibrator | Parking, stop: threading.Event
) -> None:
    """Begin, and look until it is over; end it when `stop` is set."""
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


def _end(what: str, joints: list[str], stop: threading.Event) -> None:
    """Pass when no joint is left over."""
    if joints:
        early = "stopped before the end, " if stop.is_set() else ""
        raise ActionFailed(f"{what}: {early}{', '.join(joints)}")
