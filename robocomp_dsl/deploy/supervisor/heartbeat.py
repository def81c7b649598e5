"""Receives the heartbeats and hang reports of one process, and notices when they stop.

In: the pipe of `runtime/component/supervisor_pipe.py`. Out: `on_report` for a hang that the process
found itself, `on_silence` with the seconds without a heartbeat if no Python code runs in it any
more: it is stopped (SIGSTOP), or code in C holds the interpreter lock. A process that sends no
heartbeat is not watched, nor is one that a debugger traces.
"""

from __future__ import annotations

import asyncio
import os
import time
from collections.abc import Callable
from pathlib import Path

from robocomp_dsl.runtime.component.debugger import tracer_of
from robocomp_dsl.runtime.component.hang_report import HangReport

MARGIN = 0.5
"""Additional time for a heartbeat, as a fraction of the time that it promises."""
MIN_MARGIN_S = 0.5
_CHUNK = 64 * 1024
_MAX_LINE_BYTES = 1024 * 1024


class HeartbeatReader:
    """The reading end of the pipe; runs in the event loop of the supervisor."""

    def __init__(
        self,
        on_report: Callable[[HangReport], None],
        on_silence: Callable[[float], None],
    ) -> None:
        self._on_report = on_report
        self._on_silence = on_silence
        self._loop = asyncio.get_running_loop()
        self._descriptor, self.write_end = os.pipe()
        os.set_blocking(self._descriptor, False)
        self._loop.add_reader(self._descriptor, self._read)
        self._rest = b""
        self._timer: asyncio.TimerHandle | None = None
        self._heard_at = 0.0
        self._status = Path()

    def watch(self, pid: int) -> None:
        """The process has been started; its end of the pipe is closed here."""
        self._status = Path(f"/proc/{pid}/status")
        self.close_write_end()

    def close_write_end(self) -> None:
        """Close the end of the process in this process."""
        if self.write_end >= 0:
            os.close(self.write_end)
            self.write_end = -1

    def close(self) -> None:
        """Stop watching."""
        self.close_write_end()
        self._set_timer(0.0)
        if self._descriptor >= 0:
            self._loop.remove_reader(self._descriptor)
            os.close(self._descriptor)
            self._descriptor = -1

    def _read(self) -> None:
        data = os.read(self._descriptor, _CHUNK)
        if not data:
            self.close()
            return
        *lines, rest = (self._rest + data).split(b"\n")
        self._rest = rest[:_MAX_LINE_BYTES]
        for line in lines:
            self._handle(line.decode(errors="replace"))

    def _handle(self, line: str) -> None:
        """Handle a heartbeat or a report; anything else is ignored."""
        try:
            if line.startswith("{"):
                self._on_report(HangReport.from_json(line))
            else:
                self._heard_at = time.monotonic()
                self._set_timer(float(line))
        except ValueError:
            pass

    def _set_timer(self, seconds: float) -> None:
        """Expect a heartbeat within `seconds` and a margin; 0: expect none."""
        if self._timer:
            self._timer.cancel()
            self._timer = None
        if seconds > 0:
            limit = seconds + max(MARGIN * seconds, MIN_MARGIN_S)
            due = self._loop.time() + limit
            self._timer = self._loop.call_later(limit, self._expire, due, seconds)

    def _expire(self, due: float, seconds: float) -> None:
        # If this process was itself stopped, heartbeats may still be in the pipe.
        if self._loop.time() - due > MIN_MARGIN_S or tracer_of(self._status):
            self._set_timer(seconds)
        else:
            self._on_silence(time.monotonic() - self._heard_at)
