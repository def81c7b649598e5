"""The devices of a component as its deployment describes them, for a component that hosts devices.

In: the environment that the deployment engine gives to the process, and the boards of the
component, simulated or real. Out: devices that are led through their phases: startup in a thread of
its own, since it takes the time of the world, shutdown when the component ends. Where the time of
the world is that of a deployment, startup takes its steps in `judge`, and in nothing else.
"""

from __future__ import annotations

import json
import logging
import threading
import time
from collections.abc import Callable, Mapping
from typing import Any

from robocomp_dsl.hardware.errors import HardwareError
from robocomp_dsl.hardware.plumbing.boards import BoardPart, ChainOf, Turn, board_kinds
from robocomp_dsl.hardware.plumbing.conductor import Conductor
from robocomp_dsl.hardware.plumbing.description import Plumbing
from robocomp_dsl.hardware.plumbing.read import BadDescription, plumbing_of

VARIABLE = "ROBOCOMP_DEVICES"
"""Holds the description as JSON, in the form of `read.py`."""

PATIENCE_S = 20.0
"""The wall clock's time for interrupt and shutdown; then what lasts is ended."""

POLL_S = 0.02

LOG = logging.getLogger("robocomp.devices")


def described(environment: Mapping[str, str]) -> Plumbing:
    """The description; one without devices where nothing is said. Raises `BadDescription`."""
    text = environment.get(VARIABLE, "")
    if not text:
        return Plumbing(())
    try:
        data = json.loads(text)
    except ValueError as error:
        raise BadDescription(f"{VARIABLE} is no JSON: {error}") from None
    return plumbing_of(data)


class Hosted:
    """The devices of one component, by name. `boards` tells those that are there now.

    When these are others, because a world was reset or motors were lost, all starts again. Raises
    `BadDescription` and `PlumbingError` for what cannot be meant.
    """

    def __init__(
        self,
        environment: Mapping[str, str],
        boards: Callable[[], Mapping[str, BoardPart]],
        turn: Turn,
        chain: ChainOf,
        in_step: Callable[[], bool] = bool,
    ) -> None:
        self._plan = described(environment)
        self._boards, self._turn, self._chain = boards, turn, chain
        self._in_step = in_step
        self._on: Mapping[str, BoardPart] = {}
        self._conductor = self._made()
        self._thread: threading.Thread | None = None
        self._failure, self._ending = "", False

    def _made(self) -> Conductor:
        return Conductor(self._plan, board_kinds(self._on, self._turn, self._chain))

    @property
    def ready(self) -> bool:
        """Whether startup is over and went well."""
        return self._conductor.ready

    def __getitem__(self, name: str) -> Any:
        """The device of that name, open. Raises `HardwareError` where there is none."""
        try:
            return self._conductor.devices[name]
        except KeyError:
            there = ", ".join(self._conductor.devices) or "none"
            raise HardwareError(f"there is no device `{name}` now: there are {there}") from None

    def judge(self) -> None:
        """See that they run on the boards that are there. Raises `HardwareError` if they cannot."""
        if not self._plan.devices:
            return
        with self._turn:
            found = dict(self._boards())
        same = found.keys() == self._on.keys() and all(
            found[name].board is self._on[name].board for name in found
        )
        if not same:
            if self._thread:
                LOG.warning("the boards are others now: all devices start again")
                self._end(acting=False)
            self._on = found
            self._start()
        if self._in_step() and not self._conductor.running.beat(PATIENCE_S):
            self._failure = f"the devices do nothing for {PATIENCE_S:g} s"
        if self._failure:
            raise HardwareError(self._failure)

    def _start(self) -> None:
        self._conductor, self._failure, self._ending = self._made(), "", False
        self._conductor.running.keep_step(self._in_step())
        self._conductor.running.lead()
        self._thread = threading.Thread(target=self._begin, name="devices", daemon=True)
        self._thread.start()

    def _begin(self) -> None:
        well, why = False, "the startup of the devices failed; the log tells which"
        try:
            well = self._conductor.start()
        except HardwareError as error:
            why = f"the devices cannot be opened: {error}"
        finally:
            if not well and not self._ending:
                self._failure = why
            self._conductor.running.rest()

    def stop(self, passes: Callable[[], object] | None = None) -> None:
        """Interrupt, park and close all; `passes` lets time go on where nothing else does."""
        if self._thread is None:
            return
        ending = threading.Thread(target=self._end, name="devices end", daemon=True)
        ending.start()
        latest = time.monotonic() + PATIENCE_S
        while ending.is_alive():
            if passes:
                passes()
            else:
                ending.join(POLL_S)
            if time.monotonic() > latest:
                self._conductor.give_up()

    def _end(self, *, acting: bool = True) -> None:
        self._ending = True
        self._conductor.running.keep_step(False)
        if acting:
            self._conductor.interrupt()
        else:
            self._conductor.give_up()
        if self._thread:
            self._thread.join()
        self._conductor.shutdown(acting=acting)
        self._thread = None
