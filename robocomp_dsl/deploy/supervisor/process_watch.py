"""Watches one start of a process for what its lifecycle does not tell.

In: its output, sd_notify messages, samples of its usage. Out: calls on the managed process: it is
ready, its status text, it failed. Ends with the process.
"""

from __future__ import annotations

import asyncio
import time
from collections.abc import Mapping
from typing import Protocol

from robocomp_dsl.deploy.plan import Process
from robocomp_dsl.deploy.supervisor.child import ChildProcess
from robocomp_dsl.deploy.supervisor.notify import WATCHDOG_VARIABLE, watchdog_seconds
from robocomp_dsl.deploy.supervisor.readiness_probe import ReadinessProbe
from robocomp_dsl.host_tools.resource_limits import SAMPLE_S, LimitTracker, TreeUsage
from robocomp_dsl.model.deployment import Readiness, ResourceLimits

MAX_STATUS_CHARS = 200


class WatchedProcess(Protocol):
    """What the watch needs from a managed process."""

    process: Process

    def mark_ready(self) -> None:
        """It is ready."""

    def set_status_text(self, text: str) -> None:
        """What it says of itself."""

    def warn(self, text: str) -> None:
        """Log a warning about it."""

    async def fail(self, reason: str) -> None:
        """End it as failed; its policy decides on a restart."""


class ProcessWatch:
    """Watches `child` until it has exited."""

    def __init__(self, managed: WatchedProcess, child: ChildProcess) -> None:
        self._managed = managed
        self._child = child
        process = managed.process
        self._probe = ReadinessProbe(process.readiness, self._on_ready)
        self._accepts_ready = process.readiness == Readiness()
        self._interval_s = watchdog_seconds(dict(process.env).get(WATCHDOG_VARIABLE, ""))
        self._fed_at = 0.0
        self._watchdog: asyncio.Task[None] | None = None
        self._is_ready = False
        loop = asyncio.get_running_loop()
        self._tasks = {loop.create_task(self._end())}
        if process.limits != ResourceLimits():
            self._tasks.add(loop.create_task(self._watch_limits(process.limits)))

    def observe(self, text: str) -> None:
        """A line of its output."""
        self._probe.observe(text)

    def on_message(self, assignments: Mapping[str, str]) -> None:
        """An sd_notify message of the process or one of its children."""
        if "STATUS" in assignments:
            self._managed.set_status_text(assignments["STATUS"][:MAX_STATUS_CHARS])
        if interval_s := watchdog_seconds(assignments.get(WATCHDOG_VARIABLE, "")):
            self._interval_s = interval_s
            self._start_watchdog()
        if assignments.get("READY") == "1" and self._accepts_ready:
            self._on_ready()
        match assignments.get("WATCHDOG"):
            case "1":
                self._fed_at = time.monotonic()
            case "trigger":
                self._fail("it reported a failure through its watchdog")

    def _on_ready(self) -> None:
        self._is_ready = True
        self._managed.mark_ready()
        self._start_watchdog()

    def _start_watchdog(self) -> None:
        if self._is_ready and self._interval_s and self._watchdog is None:
            self._fed_at = time.monotonic()
            self._watchdog = asyncio.get_running_loop().create_task(self._watch_heartbeat())
            self._tasks.add(self._watchdog)

    async def _watch_heartbeat(self) -> None:
        while (left := self._fed_at + self._interval_s - time.monotonic()) > 0:
            await asyncio.sleep(left)
        self._fail(f"hangs: no WATCHDOG=1 within {self._interval_s:g} s")

    async def _watch_limits(self, limits: ResourceLimits) -> None:
        usage, tracker = TreeUsage(self._child.pid), LimitTracker(limits)
        while True:
            await asyncio.sleep(SAMPLE_S)
            usage.sample()
            for excess in tracker.add(time.monotonic(), usage.memory, usage.cpu):
                if excess.is_lasting:
                    self._fail(excess.text)
                    return
                self._managed.warn(excess.text)

    def _fail(self, reason: str) -> None:
        self._tasks.add(asyncio.get_running_loop().create_task(self._managed.fail(reason)))

    async def _end(self) -> None:
        await self._child.exited.wait()
        self._probe.close()
        for task in self._tasks:
            if task is not asyncio.current_task():
                task.cancel()
