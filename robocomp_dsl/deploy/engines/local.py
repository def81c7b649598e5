"""The supervisor of one machine: small, in the foreground, and it leaves nothing behind.

In: a plan, a watch, and where to tell things. Out: the outcome, when all components have ended.
Everything runs in one event loop; only the watch calls from another thread.
"""

from __future__ import annotations

import asyncio
import os
import time
from asyncio import FIRST_COMPLETED
from collections.abc import Callable
from dataclasses import dataclass
from typing import Any

from robocomp_dsl.deploy.engines import sentinel
from robocomp_dsl.deploy.engines.care import UNKILLABLE_S, Care, first
from robocomp_dsl.deploy.engines.watch import Watch
from robocomp_dsl.deploy.logs import OWN, Record
from robocomp_dsl.deploy.plan import Plan
from robocomp_dsl.deploy.status import Row, Time


@dataclass(frozen=True, slots=True)
class Options:
    """How to run.

    `grace_s`: what a component has between SIGTERM and SIGKILL; `stop_within_s`: what all together
    have. `duration_s` counts from when all are ready. `keep_going`: the others run on when one has
    failed for good.
    """

    grace_s: float = 5.0
    stop_within_s: float = 15.0
    duration_s: float | None = None
    keep_going: bool = False


@dataclass(frozen=True, slots=True)
class Outcome:
    """`code` 0: stopped on request or all ended well; 1: something failed. `reason` in words."""

    code: int
    reason: str


def lacking() -> str:
    """What this system lacks to supervise processes, in words; empty if nothing."""
    try:
        os.close(os.pidfd_open(os.getpid()))
    except (AttributeError, OSError):
        return "rcdeploy runs components on Linux 5.3 or newer (it needs pidfd_open)"
    return ""


class Local:
    """Runs one plan."""

    def __init__(
        self,
        plan: Plan,
        token: str,
        watch: Watch,
        *,
        emit: Callable[[Record], None],
        changed: Callable[[], None],
        options: Options,
    ) -> None:
        self.plan = plan
        self.token = token
        self.emit = emit
        self.changed = changed
        self.options = options
        self.grace_s = options.grace_s
        self.stopping = asyncio.Event()
        self._hurry = asyncio.Event()
        self._reason = ""
        self._watch = watch
        self._cares = {p.name: Care(p, self) for p in plan.processes}

    def rows(self) -> list[Row]:
        """The status of all components."""
        return [one.row() for one in self._cares.values()]

    def time(self) -> Time | None:
        """The simulated time, if there is one."""
        return self._watch.time()

    def say(self, text: str, level: str = "INFO") -> None:
        """Tell the user something in the name of rcdeploy."""
        self.emit(Record(time.time(), OWN, level, text))

    def stop(self, reason: str) -> None:
        """End everything in order; asked for again, at once."""
        if self.stopping.is_set():
            if not self._hurry.is_set():
                self.say("asked again: killing what is left", "WARNING")
            self._hurry.set()
            return
        self._reason = reason
        self.say(f"stopping: {reason}")
        self.stopping.set()

    async def run(self) -> Outcome:
        """Start everything, care for it, until all has ended."""
        loop = asyncio.get_running_loop()
        self._watch.start(lambda *what: _in_loop(loop, self._seen, *what))
        cares = [loop.create_task(self._care(one)) for one in self._cares.values()]
        ready = loop.create_task(self._until_duration())
        stopping = loop.create_task(self._shut_down())
        try:
            everyone = asyncio.gather(*cares)
            either: list[asyncio.Future[Any]] = [everyone, stopping]
            await asyncio.wait(either, return_when=FIRST_COMPLETED)
            if everyone.done():
                everyone.result()  # a mistake of ours in a care is raised here
        finally:
            for task in (ready, stopping, *cares):
                task.cancel()
            self._watch.close()
            await asyncio.to_thread(self._sweep)
        return self._outcome()

    def _seen(self, name: str, pid: int, state: str) -> None:
        if (one := self._cares.get(name)) is not None:
            one.seen(pid, state)

    async def _care(self, one: Care) -> None:
        await one.run([self._cares[name] for name in one.process.after])
        if one.failed and not self.stopping.is_set() and not self.options.keep_going:
            self.stop(f"{one.name} has failed")

    async def _until_duration(self) -> None:
        began = time.monotonic()
        for one in self._cares.values():
            await first(one.ready, one.done)
        if not all(one.is_served for one in self._cares.values()):
            return
        took = time.monotonic() - began
        many = f"all {len(self._cares)} components are"
        self.say(f"{many if len(self._cares) > 1 else 'the component is'} ready after {took:.2f} s")
        if self.options.duration_s is not None:
            await asyncio.sleep(self.options.duration_s)
            self.stop(f"{self.options.duration_s:g} s have passed")

    async def _shut_down(self) -> None:
        """Wave after wave in reverse order; whoever needs longer than it has is killed."""
        await self.stopping.wait()
        deadline = time.monotonic() + self.options.stop_within_s
        for wave in self.plan.stop_waves():
            left = max(0.0, min(self.grace_s, deadline - time.monotonic()))
            ends = [self._end(self._cares[name], left) for name in wave]
            await asyncio.gather(*ends)
        for one in self._cares.values():
            await first(one.done, timeout=UNKILLABLE_S)

    async def _end(self, one: Care, grace_s: float) -> None:
        if not await one.end(grace_s, self._hurry):
            self.say(f"{one.name} did not end in {grace_s:g} s and was killed", "WARNING")

    def _sweep(self) -> None:
        """What a component started outside its process group."""
        for pid in sentinel.end_all(self.token, 0.0 if self._hurry.is_set() else 1.0):
            self.say(f"process {pid}, left by a component, was killed", "WARNING")

    def _outcome(self) -> Outcome:
        failed = [one.name for one in self._cares.values() if one.failed]
        if failed:
            return Outcome(1, f"failed: {', '.join(failed)}")
        return Outcome(0, self._reason or "all components have ended")


def _in_loop(loop: asyncio.AbstractEventLoop, call: Callable[..., object], *what: object) -> None:
    if not loop.is_closed():
        loop.call_soon_threadsafe(call, *what)
