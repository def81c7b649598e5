"""Leads devices through their phases, level by level, as robotinterface of YARP does.

In: a description, the kinds of devices. Out: open devices by name, and whether each phase went
well. Levels go up; the actions of one level begin in their order; calibrations and parkings run in
threads, and the next level waits for them. What fails is logged, and the rest goes on.
"""

from __future__ import annotations

import logging
import threading
from collections.abc import Callable, Mapping
from functools import partial
from types import MappingProxyType
from typing import Any

from robocomp_dsl.hardware.errors import HardwareError
from robocomp_dsl.hardware.plumbing.check import (
    PlumbingError,
    attach_order,
    calibrator_of,
    findings,
)
from robocomp_dsl.hardware.plumbing.description import (
    INTERRUPTS,
    LASTING,
    Action,
    Phase,
    Plumbing,
    Verb,
)
from robocomp_dsl.hardware.plumbing.kinds import Kind
from robocomp_dsl.hardware.plumbing.running import Running

PATIENCE = 10.0
"""Shutdown waits so long for actions that do not end [s], then it goes on without them."""

LOG = logging.getLogger("robocomp.devices")


class Conductor:
    """One life of the devices: `start`, up to three times `interrupt`, `shutdown`.

    Raises `PlumbingError` for a description that cannot be carried out. `interrupt` may be called
    by any thread at any time, the others by one thread.
    """

    def __init__(self, plan: Plumbing, kinds: Mapping[str, Kind]) -> None:
        if wrong := findings(plan, kinds):
            raise PlumbingError(wrong)
        self._plan, self._kinds = plan, kinds
        self._open: dict[str, Any] = {}
        self._attached: list[str] = []
        self.running = Running()
        self._lock = threading.Lock()
        self.devices: Mapping[str, Any] = MappingProxyType(self._open)
        self.phase, self.level = Phase.CLOSED, 0

    @property
    def ready(self) -> bool:
        """Whether startup went well and nobody has interrupted since."""
        return self.phase is Phase.RUN

    def start(self) -> bool:
        """Open all devices and go through startup; whether all went well: then they run.

        Raises the `HardwareError` of a device that cannot be opened, with all others closed.
        """
        try:
            for one in self._plan.devices:
                self._open[one.name] = self._kinds[one.kind].open(one)
        except BaseException:
            self._close()
            raise
        well = self._enter(Phase.STARTUP)
        with self._lock:
            if well and self.phase is Phase.STARTUP:
                self.phase = Phase.RUN
        return self.ready

    def interrupt(self) -> bool:
        """The first stops what lasts; the others do not even wait for it. Whether all went well."""
        done = INTERRUPTS.index(self.phase) + 1 if self.phase in INTERRUPTS else 0
        if done == len(INTERRUPTS) or self.phase in (Phase.CLOSED, Phase.SHUTDOWN):
            return False
        self.running.stop()
        return self._enter(INTERRUPTS[done])

    def give_up(self) -> None:
        """End all that lasts now, in whatever phase."""
        self.running.stop()

    def shutdown(self, *, acting: bool = True) -> bool:
        """Interrupt, if nobody has yet; the actions of shutdown; detach and close everything.

        Not `acting`, because what the devices stand on is gone: it only detaches and closes.
        """
        if not self._open:
            return True
        if not acting:
            with self._lock:
                self.phase = Phase.SHUTDOWN
            well = False
        else:
            well = True if self.phase in INTERRUPTS else self.interrupt()
            well = self._enter(Phase.SHUTDOWN) and well
        self.running.stop()
        well = self.running.wait(seconds=PATIENCE) and well
        for name in reversed(self._attached[:]):
            well = self._told(f"detach {name}", partial(self._detach, name)) and well
        return self._close() and well

    def _enter(self, phase: Phase) -> bool:
        """Go through the levels of a phase; False also when another phase came in between."""
        with self._lock:
            self.phase, self.level = phase, 0
        self.running.changed()
        well = True
        if phase not in (Phase.INTERRUPT2, Phase.INTERRUPT3):
            limit = PATIENCE if phase is Phase.SHUTDOWN else None
            well = self.running.wait(lambda: self.phase is not phase, seconds=limit)
        if phase is Phase.STARTUP:
            well = self._attach_the_rest() and well
        for level in self._levels(phase):
            if self.phase is not phase:
                return False
            self.level = level
            begun = [a for a in self._plan.actions if (a.phase, a.level) == (phase, level)]
            results = [self._do(action) for action in begun]
            ended = self.running.wait(lambda: self.phase is not phase, phase=phase)
            well = well and ended and all(results)
        failed = self.running.take_failures(phase)
        return well and not failed and self.phase is phase

    def _levels(self, phase: Phase) -> list[int]:
        down = self._plan.backwards and phase is not Phase.STARTUP
        return sorted({a.level for a in self._plan.actions if a.phase is phase}, reverse=down)

    def _attach_the_rest(self) -> bool:
        """Attach what has no action of its own for it, those below first."""
        own = {a.device for a in self._plan.actions if a.verb is Verb.ATTACH}
        well = True
        for name in attach_order(self._plan):
            if name not in own:
                well = self._told(f"attach {name}", partial(self._attach, name)) and well
        return well

    def _do(self, action: Action) -> bool:
        name, said = action.device, f"{action.verb} {action.device}"
        if action.verb in LASTING:
            by = calibrator_of(action, self._plan, self._kinds)[0]
            work = getattr(self._open[by], action.verb)

            def last(stop: threading.Event) -> bool:
                return self._told(f"{said} by {by}", lambda: work(name, stop))

            self.running.begin(name, action.phase, last)
            return True
        if action.verb is Verb.ABORT:
            self.running.stop(name)
            return True
        change = self._attach if action.verb is Verb.ATTACH else self._detach
        return self._told(said, lambda: change(name))

    def _attach(self, name: str) -> None:
        if name not in self._attached:
            below = {one: self._open[one] for one in self._plan.attached(name)}
            self._open[name].attach(below)
            self._attached.append(name)

    def _detach(self, name: str) -> None:
        if name in self._attached:
            self._attached.remove(name)
            self._open[name].detach()

    def _close(self) -> bool:
        """Close all devices, the last one first."""
        well = True
        for name, device in reversed(self._open.items()):
            well = self._told(f"close {name}", device.close) and well
        self._open.clear()
        self._attached.clear()
        self.phase = Phase.CLOSED
        return well

    def _told(self, what: str, work: Callable[[], object]) -> bool:
        """Do `work`; a failure is logged and nothing else stops for it."""
        try:
            work()
        except HardwareError as error:
            LOG.error("%s: %s failed: %s", self.phase, what, error)  # noqa: TRY400 - for the user
        except Exception:
            LOG.exception("%s: %s failed by a fault of the device's code", self.phase, what)
        else:
            return True
        return False
