"""Hosts the devices that a deployment defines for one component.

In: the environment that the supervisor passes to the process, and the boards of the component,
simulated or real. Out: devices that run through their phases. Startup has its own thread, since
it takes simulated time; shutdown runs when the component stops. If the world follows the clock of
a deployment, startup advances only in `raise_if_failed`.
"""

from __future__ import annotations

import json
import logging
import threading
import time
from collections.abc import Callable, Mapping
from typing import Any

from robocomp_dsl.hardware.device_manager.boards import (
    BoardLock,
    BoardPart,
    ChainFactory,
    board_kinds,
)
from robocomp_dsl.hardware.device_manager.description import DevicePlan
from robocomp_dsl.hardware.device_manager.manager import DeviceManager
from robocomp_dsl.hardware.device_manager.read import InvalidPlan, read_plan
from robocomp_dsl.hardware.devices.errors import HardwareError

DEVICES_VARIABLE = "ROBOCOMP_DEVICES"
"""Environment variable with the plan as JSON, in the format of `read.py`."""

STOP_TIMEOUT_S = 20.0
"""Wall time for interrupt and shutdown; then running actions are aborted."""

POLL_S = 0.02

LOG = logging.getLogger("robocomp.devices")


def plan_from_environment(environment: Mapping[str, str]) -> DevicePlan:
    """The plan in the environment, empty if there is none. Raises `InvalidPlan`."""
    text = environment.get(DEVICES_VARIABLE, "")
    if not text:
        return DevicePlan(())
    try:
        data = json.loads(text)
    except ValueError as error:
        raise InvalidPlan(f"{DEVICES_VARIABLE} is not valid JSON: {error}") from None
    return read_plan(data)


class DeviceHost:
    """The devices of one component, by name. `boards` returns the current boards.

    When the boards change, because a world was reset or motors failed, all devices start again.
    Raises `InvalidPlan` and `PlanError`.
    """

    def __init__(
        self,
        environment: Mapping[str, str],
        boards: Callable[[], Mapping[str, BoardPart]],
        turn: BoardLock,
        chain: ChainFactory,
        on_deployment_clock: Callable[[], bool] = bool,
    ) -> None:
        self._plan = plan_from_environment(environment)
        self._boards, self._lock, self._chain = boards, turn, chain
        self._on_deployment_clock = on_deployment_clock
        self._current_boards: Mapping[str, BoardPart] = {}
        self._manager = self._create_manager()
        self._thread: threading.Thread | None = None
        self._failure, self._ending = "", False

    def _create_manager(self) -> DeviceManager:
        return DeviceManager(self._plan, board_kinds(self._current_boards, self._lock, self._chain))

    @property
    def ready(self) -> bool:
        """Whether startup has succeeded."""
        return self._manager.ready

    def __getitem__(self, name: str) -> Any:
        """The open device of that name. Raises `HardwareError` if there is none."""
        try:
            return self._manager.devices[name]
        except KeyError:
            there = ", ".join(self._manager.devices) or "none"
            raise HardwareError(f"there is no device `{name}` now; available: {there}") from None

    def raise_if_failed(self) -> None:
        """Start the devices on the current boards, and step them. Raises `HardwareError`."""
        if not self._plan.devices:
            return
        with self._lock:
            found = dict(self._boards())
        same = found.keys() == self._current_boards.keys() and all(
            found[name].board is self._current_boards[name].board for name in found
        )
        if not same:
            if self._thread:
                LOG.warning("the boards have changed: all devices start again")
                self._shut_down(acting=False)
            self._current_boards = found
            self._start()
        if self._on_deployment_clock() and not self._manager.runner.step(STOP_TIMEOUT_S):
            self._failure = f"the devices do not respond for {STOP_TIMEOUT_S:g} s"
        if self._failure:
            raise HardwareError(self._failure)

    def _start(self) -> None:
        self._manager, self._failure, self._ending = self._create_manager(), "", False
        self._manager.runner.set_lockstep(self._on_deployment_clock())
        self._manager.runner.enter_phase()
        self._thread = threading.Thread(target=self._run_startup, name="devices", daemon=True)
        self._thread.start()

    def _run_startup(self) -> None:
        well, why = False, "the startup of the devices failed; see the log"
        try:
            well = self._manager.start()
        except HardwareError as error:
            why = f"the devices cannot be opened: {error}"
        finally:
            if not well and not self._ending:
                self._failure = why
            self._manager.runner.leave_phase()

    def stop(self, advance: Callable[[], object] | None = None) -> None:
        """Interrupt, park and close all devices; `advance` drives the clock if no thread does."""
        if self._thread is None:
            return
        ending = threading.Thread(target=self._shut_down, name="devices end", daemon=True)
        ending.start()
        latest = time.monotonic() + STOP_TIMEOUT_S
        while ending.is_alive():
            if advance:
                advance()
            else:
                ending.join(POLL_S)
            if time.monotonic() > latest:
                self._manager.abort()

    def _shut_down(self, *, acting: bool = True) -> None:
        self._ending = True
        self._manager.runner.set_lockstep(False)
        if acting:
            self._manager.interrupt()
        else:
            self._manager.abort()
        if self._thread:
            self._thread.join()
        self._manager.shutdown(acting=acting)
        self._thread = None
