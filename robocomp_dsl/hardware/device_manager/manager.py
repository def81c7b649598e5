"""Runs devices through their phases, level by level, like YARP's robotinterface.

In: a plan and the kinds of devices. Out: open devices by name, and whether each phase succeeded.
Levels ascend; the actions of one level start in order; calibrations and parkings run in threads,
and the next level waits for them. Failures are logged, and the other actions continue.
"""

from __future__ import annotations

import logging
import threading
from collections.abc import Callable, Mapping
from functools import partial
from types import MappingProxyType
from typing import Any

from robocomp_dsl.hardware.device_manager.action_runner import ActionRunner
from robocomp_dsl.hardware.device_manager.check import (
    PlanError,
    attach_order,
    calibrator_of,
    findings,
)
from robocomp_dsl.hardware.device_manager.description import (
    INTERRUPTS,
    LONG_RUNNING,
    DeviceAction,
    DevicePlan,
    Phase,
    Verb,
)
from robocomp_dsl.hardware.device_manager.kinds import DeviceKind
from robocomp_dsl.hardware.devices.errors import HardwareError

SHUTDOWN_TIMEOUT_S = 10.0
"""Time limit of running actions at shutdown [s]; then shutdown continues."""

LOG = logging.getLogger("robocomp.devices")


class DeviceManager:
    """One lifecycle of the devices: `start`, up to three times `interrupt`, `shutdown`.

    Raises `PlanError` for an invalid plan. `interrupt` may be called by any thread at any time,
    the other methods by one thread.
    """

    def __init__(self, plan: DevicePlan, kinds: Mapping[str, DeviceKind]) -> None:
        if wrong := findings(plan, kinds):
            raise PlanError(wrong)
        self._plan, self._kinds = plan, kinds
        self._open: dict[str, Any] = {}
        self._attached: list[str] = []
        self.runner = ActionRunner()
        self._lock = threading.Lock()
        self.devices: Mapping[str, Any] = MappingProxyType(self._open)
        self.phase, self.level = Phase.CLOSED, 0

    @property
    def ready(self) -> bool:
        """Whether startup succeeded and no interrupt followed."""
        return self.phase is Phase.RUN

    def start(self) -> bool:
        """Open all devices and run the startup phase; True if all succeeded.

        Raises the `HardwareError` of a device that cannot be opened, after closing all others.
        """
        try:
            for device in self._plan.devices:
                self._open[device.name] = self._kinds[device.kind].open(device)
        except BaseException:
            self._close()
            raise
        well = self._enter(Phase.STARTUP)
        with self._lock:
            if well and self.phase is Phase.STARTUP:
                self.phase = Phase.RUN
        return self.ready

    def interrupt(self) -> bool:
        """The first call stops running actions; later ones do not wait. True if all succeeded."""
        done = INTERRUPTS.index(self.phase) + 1 if self.phase in INTERRUPTS else 0
        if done == len(INTERRUPTS) or self.phase in (Phase.CLOSED, Phase.SHUTDOWN):
            return False
        self.runner.stop()
        return self._enter(INTERRUPTS[done])

    def abort(self) -> None:
        """Stop all running actions, in any phase."""
        self.runner.stop()

    def shutdown(self, *, acting: bool = True) -> bool:
        """Interrupt if necessary, run the shutdown phase, detach and close everything.

        With `acting=False` (the boards are lost) it only detaches and closes.
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
        self.runner.stop()
        well = self.runner.wait(seconds=SHUTDOWN_TIMEOUT_S) and well
        for name in reversed(self._attached[:]):
            well = self._try(f"detach {name}", partial(self._detach, name)) and well
        return self._close() and well

    def _enter(self, phase: Phase) -> bool:
        """Run the levels of a phase; False also when another phase interrupted it."""
        with self._lock:
            self.phase, self.level = phase, 0
        self.runner.notify()
        well = True
        if phase not in (Phase.INTERRUPT2, Phase.INTERRUPT3):
            limit = SHUTDOWN_TIMEOUT_S if phase is Phase.SHUTDOWN else None
            well = self.runner.wait(lambda: self.phase is not phase, seconds=limit)
        if phase is Phase.STARTUP:
            well = self._attach_remaining() and well
        for level in self._levels(phase):
            if self.phase is not phase:
                return False
            self.level = level
            begun = [a for a in self._plan.actions if (a.phase, a.level) == (phase, level)]
            results = [self._perform(action) for action in begun]
            ended = self.runner.wait(lambda: self.phase is not phase, phase=phase)
            well = well and ended and all(results)
        failed = self.runner.take_failures(phase)
        return well and not failed and self.phase is phase

    def _levels(self, phase: Phase) -> list[int]:
        down = self._plan.backwards and phase is not Phase.STARTUP
        return sorted({a.level for a in self._plan.actions if a.phase is phase}, reverse=down)

    def _attach_remaining(self) -> bool:
        """Attach the devices without an attach action, in attach order."""
        own = {a.device for a in self._plan.actions if a.verb is Verb.ATTACH}
        well = True
        for name in attach_order(self._plan):
            if name not in own:
                well = self._try(f"attach {name}", partial(self._attach, name)) and well
        return well

    def _perform(self, action: DeviceAction) -> bool:
        name, description = action.device, f"{action.verb} {action.device}"
        if action.verb in LONG_RUNNING:
            by = calibrator_of(action, self._plan, self._kinds)[0]
            work = getattr(self._open[by], action.verb)

            def last(stop: threading.Event) -> bool:
                return self._try(f"{description} by {by}", lambda: work(name, stop))

            self.runner.start_action(name, action.phase, last)
            return True
        if action.verb is Verb.ABORT:
            self.runner.stop(name)
            return True
        change = self._attach if action.verb is Verb.ATTACH else self._detach
        return self._try(description, lambda: change(name))

    def _attach(self, name: str) -> None:
        if name not in self._attached:
            below = {target: self._open[target] for target in self._plan.attached_to(name)}
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
            well = self._try(f"close {name}", device.close) and well
        self._open.clear()
        self._attached.clear()
        self.phase = Phase.CLOSED
        return well

    def _try(self, what: str, work: Callable[[], object]) -> bool:
        """Run `work`; log a failure. True if it succeeded."""
        try:
            work()
        except HardwareError as error:
            LOG.error("%s: %s failed: %s", self.phase, what, error)  # noqa: TRY400 - for the user
        except Exception:
            LOG.exception("%s: %s failed: unexpected error in the device's code", self.phase, what)
        else:
            return True
        return False
