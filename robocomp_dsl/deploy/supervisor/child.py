"""Runs one process of a component: starts, reads, signals and reaps it.

In: a `Process` of the plan. Out: its log records, and its exit code. The process has its own
session: a signal reaches all its children, and Ctrl-C in the terminal does not reach it.
"""

from __future__ import annotations

import asyncio
import contextlib
import os
import select
import signal
import time
from collections.abc import Callable
from typing import IO

from robocomp_dsl.deploy.logs import LineSplitter, LogRecord
from robocomp_dsl.deploy.plan import Process
from robocomp_dsl.deploy.supervisor.hang_watch import HangWatch
from robocomp_dsl.deploy.supervisor.process_start import StartedProcess
from robocomp_dsl.host_tools.resource_usage import ResourceUsage

_CHUNK = 64 * 1024


class ChildProcess:
    """A running process. `exited` is set after all its output was emitted; then `code` is valid.

    A code of -N means that signal N terminated it.
    """

    def __init__(
        self,
        process: Process,
        started: StartedProcess,
        emit: Callable[[LogRecord], None],
        hang_watch: HangWatch,
    ) -> None:
        self._emit = emit
        self._loop = asyncio.get_running_loop()
        self._hang_watch = hang_watch
        self._started = started
        self.pid = started.pid
        hang_watch.watch(self.pid)
        self.started = time.monotonic()
        self.usage = ResourceUsage(self.pid)
        self.exited = asyncio.Event()
        self.code = 0
        self._open: dict[int, tuple[IO[bytes], LineSplitter]] = {}
        members = [member.name for member in process.members]
        for name, stream in (("stdout", started.stdout), ("stderr", started.stderr)):
            os.set_blocking(stream.fileno(), False)
            self._open[stream.fileno()] = (stream, LineSplitter(process.name, name, members))
            self._loop.add_reader(stream.fileno(), self._read_chunk, stream.fileno())
        self._handle = os.pidfd_open(self.pid)
        self._has_exited = False
        self._finishing: asyncio.Task[None] | None = None
        self._loop.add_reader(self._handle, self._on_exit)

    def signal(self, number: signal.Signals) -> None:
        """Send the signal to the process and its children."""
        with contextlib.suppress(ProcessLookupError):
            os.killpg(self.pid, number)

    @property
    def has_exited(self) -> bool:
        """Whether the process has exited, also if the event loop does not know it yet."""
        if not self._has_exited:
            poll = select.poll()
            poll.register(self._handle, select.POLLIN)
            self._has_exited = bool(poll.poll(0))
        return self._has_exited

    def owns(self, pid: int) -> bool:
        """Whether `pid` is this process or one of its children."""
        try:
            return os.getpgid(pid) == self.pid
        except ProcessLookupError:
            return False

    def _read_chunk(self, descriptor: int) -> bool:
        """Read one chunk of output; returns whether there may be more."""
        stream, lines = self._open[descriptor]
        try:
            data = os.read(descriptor, _CHUNK)
        except BlockingIOError:
            return False
        now = time.time()
        for record in lines.feed(data, now) if data else lines.end(now):
            self._emit(record)
        if not data:
            self._loop.remove_reader(descriptor)
            del self._open[descriptor]
            stream.close()
        return bool(data)

    def _on_exit(self) -> None:
        # The process is still a zombie, so its group id cannot be reused yet.
        self._has_exited = True
        self._loop.remove_reader(self._handle)
        os.close(self._handle)
        self._hang_watch.close()
        self.signal(signal.SIGKILL)
        self._finishing = self._loop.create_task(self._finish())

    async def _finish(self) -> None:
        self.code = await self._started.exit_code()
        for descriptor in list(self._open):
            while self._read_chunk(descriptor):
                pass
        self._close_pipes()
        self.exited.set()

    def _close_pipes(self) -> None:
        """Close pipes that a process outside the group holds open."""
        for descriptor, (stream, lines) in self._open.items():
            self._loop.remove_reader(descriptor)
            for record in lines.end(time.time()):
                self._emit(record)
            stream.close()
        self._open.clear()


def describe_exit(code: int) -> str:
    """An exit code as text: `exit code 3`, `killed by SIGKILL`."""
    if code >= 0:
        return f"exit code {code}"
    try:
        return f"killed by {signal.Signals(-code).name}"
    except ValueError:
        return f"killed by signal {-code}"
