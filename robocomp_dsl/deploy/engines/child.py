"""One process of a component on this machine: started, listened to, signalled, reaped.

In: a `Process` of the plan. Out: its records as they come, and its exit code. It has a session of
its own, so that a signal reaches everything it started and a Ctrl-C in the terminal nothing of it.
"""

from __future__ import annotations

import asyncio
import contextlib
import os
import signal
import subprocess
import time
from collections.abc import Callable
from typing import IO

from robocomp_dsl.deploy.engines.sentinel import MARK
from robocomp_dsl.deploy.engines.usage import Meter
from robocomp_dsl.deploy.logs import Lines, Record
from robocomp_dsl.deploy.plan import Process

_CHUNK = 64 * 1024


class Child:
    """A running process. `exited` is set when all its output has been told; then `code` is valid.

    A code of -N means that signal N ended it.
    Raises `OSError` when it cannot be started.
    """

    def __init__(self, process: Process, token: str, emit: Callable[[Record], None]) -> None:
        self._emit = emit
        self._loop = asyncio.get_running_loop()
        environment = {"PYTHONUNBUFFERED": "1", **os.environ, **dict(process.env), MARK: token}
        self._popen = subprocess.Popen(  # noqa: S603 - the command line is the user's own
            process.argv,
            cwd=process.cwd,
            env=environment,
            stdin=subprocess.DEVNULL,
            stdout=subprocess.PIPE,
            stderr=subprocess.PIPE,
            start_new_session=True,
        )
        self.pid = self._popen.pid
        self.started = time.monotonic()
        self.usage = Meter(self.pid)
        self.exited = asyncio.Event()
        self.code = 0
        self._open: dict[int, tuple[IO[bytes], Lines]] = {}
        for name, stream in (("stdout", self._popen.stdout), ("stderr", self._popen.stderr)):
            assert stream is not None  # noqa: S101 - both were asked for
            os.set_blocking(stream.fileno(), False)
            self._open[stream.fileno()] = (stream, Lines(process.name, name))
            self._loop.add_reader(stream.fileno(), self._read, stream.fileno())
        self._handle = os.pidfd_open(self.pid)
        self._loop.add_reader(self._handle, self._ended)

    def signal(self, number: signal.Signals) -> None:
        """Send `number` to it and to all that it started."""
        with contextlib.suppress(ProcessLookupError):
            os.killpg(self.pid, number)

    def owns(self, pid: int) -> bool:
        """Whether `pid` is this process or was started by it."""
        try:
            return os.getpgid(pid) == self.pid
        except ProcessLookupError:
            return False

    def _read(self, descriptor: int) -> bool:
        """One chunk of output; whether there may be more."""
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

    def _ended(self) -> None:
        # It is a zombie still, so that nothing else can have its group by now.
        self._loop.remove_reader(self._handle)
        os.close(self._handle)
        self.signal(signal.SIGKILL)
        self.code = self._popen.wait()
        for descriptor in list(self._open):
            while self._read(descriptor):
                pass
        self._close()
        self.exited.set()

    def _close(self) -> None:
        """Let go of pipes that a process outside the group keeps open."""
        for descriptor, (stream, lines) in self._open.items():
            self._loop.remove_reader(descriptor)
            for record in lines.end(time.time()):
                self._emit(record)
            stream.close()
        self._open.clear()


def told(code: int) -> str:
    """An exit code in words."""
    if code >= 0:
        return f"exit code {code}"
    try:
        return f"killed by {signal.Signals(-code).name}"
    except ValueError:
        return f"killed by signal {-code}"
