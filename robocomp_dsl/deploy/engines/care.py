"""The care for one component: start it, wait until it is ready, start it again as its policy says.

In: its `Process`, and what the watch has seen of it. Out: its row of the status, and how it ended.
"""

from __future__ import annotations

import asyncio
import signal
import time
from typing import Protocol

from robocomp_dsl.deploy import status
from robocomp_dsl.deploy.engines import watch
from robocomp_dsl.deploy.engines.child import Child, told
from robocomp_dsl.deploy.engines.restart import judge
from robocomp_dsl.deploy.logs import Record
from robocomp_dsl.deploy.plan import Process
from robocomp_dsl.deploy.status import Row

ASKED = (0, -signal.SIGTERM, 128 + signal.SIGTERM)
"""Exit codes of a process that ended because it was told to."""
NOT_STARTED = 127
TOO_LATE = 124
"""Stand for the exit code, as in a shell: no such program, ended because it took too long."""
UNKILLABLE_S = 5.0
"""After this time a process that SIGKILL does not end (it waits in a driver) is left alone."""


class Surroundings(Protocol):
    """What the care needs of the engine."""

    token: str
    grace_s: float
    stopping: asyncio.Event

    def say(self, text: str, level: str = "INFO") -> None:
        """Tell the user."""

    def emit(self, record: Record) -> None:
        """Pass on what a component said."""

    def changed(self) -> None:
        """A row is another one now."""


class Care:
    """One component. `done` is set when it will not run again; `failed` says whether for good."""

    def __init__(self, process: Process, around: Surroundings) -> None:
        self.process = process
        self.name = process.name
        self.around = around
        self.child: Child | None = None
        self.ready = asyncio.Event()
        self.done = asyncio.Event()
        self.failed = False
        self.restarts: list[float] = []
        self._state = status.WAITING
        self._note = ""
        self._life_state = ""
        self._started = False
        self._was_ready = False
        self._killed = False

    def row(self) -> Row:
        """How it is now."""
        child = self.child
        if child is None:
            return Row(self.name, self._state, restarts=len(self.restarts), note=self._note)
        child.usage.look()
        return Row(
            self.name,
            self._state,
            child.pid,
            time.monotonic() - child.started,
            len(self.restarts),
            child.usage.cpu,
            child.usage.memory,
            self._note,
            self._life_state,
        )

    def seen(self, pid: int, state: str) -> None:
        """The watch has seen it change its state; of an earlier life nothing is believed."""
        child = self.child
        if child is None or self._state == status.STOPPING or not child.owns(pid):
            return
        self._life_state = state
        if state in watch.READY:
            self.ready.set()
        if self.ready.is_set():
            self._become(status.READY if state else status.UNSEEN, "")
        else:
            self._become(status.STARTING, "")

    async def run(self, needed: list[Care]) -> None:
        """Until it will not run again. `needed` must be ready before it starts."""
        try:
            if await self._needed_are_ready(needed):
                await self._lives()
        finally:
            self.child = None
            self.done.set()
            self.around.changed()

    async def _needed_are_ready(self, needed: list[Care]) -> bool:
        for one in needed:
            self._become(status.WAITING, f"for {one.name}")
            await first(one.ready, one.done, self.around.stopping)
            if self.around.stopping.is_set() or one.failed or not one.is_served:
                self._become(status.ENDED, f"not started, {one.name} was not ready")
                return False
        return not self.around.stopping.is_set()

    @property
    def is_served(self) -> bool:
        """Whether who needs it can start: it is ready, or has done its work and ended."""
        return self.ready.is_set() or (self.done.is_set() and self._started and not self.failed)

    async def _lives(self) -> None:
        """One life after the other, with waits between them."""
        while not self.around.stopping.is_set():
            code = await self._life()
            if self.around.stopping.is_set():
                self._stopped(code)
                return
            verdict = judge(self.process.restart, self.restarts, time.monotonic(), failed=code != 0)
            if verdict.wait_s is None or (self._killed and not self._was_ready):
                self._over(code, verdict.reason)
                return
            said = f"{self.name}: {self._note}, starts again in {verdict.wait_s:g} s"
            self.around.say(said, "WARNING")
            self._become(status.BACKOFF, self._note)
            await first(self.around.stopping, timeout=verdict.wait_s)
            self.restarts.append(time.monotonic())
        self._become(status.ENDED, self._note)

    async def _life(self) -> int:
        """From the start to the exit code, or what stands for it."""
        self.ready.clear()
        self._killed = False
        try:
            self.child = Child(self.process, self.around.token, self.around.emit)
        except OSError as error:
            self._note = f"cannot be started: {error.strerror or error}"
            return NOT_STARTED
        self._started = True
        self._life_state = ""
        self._become(status.STARTING, "")
        child = self.child
        await first(child.exited, self.ready, timeout=self.process.ready_within_s)
        if self.ready.is_set():
            self._was_ready = True
            up = time.monotonic() - child.started
            self.around.say(f"{self.name} is ready after {up:.2f} s (pid {child.pid})")
        elif not child.exited.is_set() and not self.around.stopping.is_set():
            await self._too_late()
        await child.exited.wait()
        self.child = None
        if self._killed:
            return TOO_LATE
        self._note = told(child.code)
        return child.code

    async def _too_late(self) -> None:
        assert self.child is not None  # noqa: S101 - called within a life
        where = f" (its state: {self._life_state})" if self._life_state else ""
        said = f"not ready within {self.process.ready_within_s:g} s{where}"
        self.around.say(f"{self.name}: {said}", "ERROR")
        self._killed = True
        await self.end(self.around.grace_s)
        self._note = said

    async def end(self, grace_s: float, hurry: asyncio.Event | None = None) -> bool:
        """SIGTERM, and SIGKILL after `grace_s` or when `hurry` is set; False: it was needed."""
        if self.child is None:
            return True
        child = self.child
        self._become(status.STOPPING, self._note)
        child.signal(signal.SIGTERM)
        await first(child.exited, *filter(None, [hurry]), timeout=grace_s)
        if child.exited.is_set():
            return True
        child.signal(signal.SIGKILL)
        await first(child.exited, timeout=UNKILLABLE_S)
        return False

    def _stopped(self, code: int) -> None:
        if code in ASKED:
            self._become(status.ENDED, "stopped")
            return
        self.failed = True
        self._become(status.FAILED, f"{told(code)} while it was stopping")
        self.around.say(f"{self.name}: {self._note}", "ERROR")

    def _over(self, code: int, reason: str) -> None:
        if code == 0:
            self.around.say(f"{self.name} has ended")
            self._become(status.ENDED, "")
            return
        self.failed = True
        self._become(status.FAILED, self._note)
        why = f" ({reason})" if reason else ""
        self.around.say(f"{self.name} has failed for good: {self._note}{why}", "ERROR")

    def _become(self, state: str, note: str) -> None:
        self._state, self._note = state, note
        self.around.changed()


async def first(*events: asyncio.Event, timeout: float | None = None) -> None:
    """Until one of `events` is set, or `timeout` s have passed."""
    tasks = [asyncio.ensure_future(event.wait()) for event in events]
    try:
        await asyncio.wait(tasks, timeout=timeout, return_when=asyncio.FIRST_COMPLETED)
    finally:
        for task in tasks:
            task.cancel()
