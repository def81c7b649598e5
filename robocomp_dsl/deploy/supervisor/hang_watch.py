"""Finds out that a process hangs: by its own report, or because its heartbeats stop.

In: heartbeats, lines of output. Out: one `HangReport`, with a Python stack if there is one. A
process that cannot run Python code writes its stacks to standard error in C (`faulthandler`), after
the line `Timeout (…)!`.
"""

from __future__ import annotations

import re
import time
from collections.abc import Callable
from pathlib import Path

from robocomp_dsl.deploy.logs import LogRecord
from robocomp_dsl.deploy.supervisor.heartbeat import HeartbeatReader
from robocomp_dsl.runtime.component.hang_report import HangReport

MAX_STACK_LINES = 200
_DUMP_START = re.compile(r"Timeout \(\d+:\d\d:\d\d(\.\d+)?\)!")
_FRAME = re.compile(r'  File "(?P<file>[^"]+)", line (?P<line>\d+) in ')


class HangWatch:
    """Watches one process; calls `on_hang` once, and says whether the process ends by itself."""

    def __init__(self, on_hang: Callable[[HangReport, bool], None]) -> None:
        self._on_hang = on_hang
        self._reader = HeartbeatReader(self._on_report, self._on_silence)
        self._dump: list[str] | None = None
        self._pid = 0

    @property
    def write_end(self) -> int:
        """The descriptor for the process."""
        return self._reader.write_end

    def watch(self, pid: int) -> None:
        """The process has been started."""
        self._pid = pid
        self._reader.watch(pid)

    def close(self) -> None:
        """Stop watching."""
        self._reader.close()

    def observe(self, record: LogRecord) -> None:
        """Collect the stacks that the process writes."""
        if record.stream == "stderr" and _DUMP_START.fullmatch(record.text):
            self._dump = []
        elif record.stream == "stderr" and self._dump is not None:
            self._dump.append(record.text)
            del self._dump[MAX_STACK_LINES:]

    def _on_report(self, report: HangReport) -> None:
        self._reader.close()
        self._on_hang(report, True)

    def _on_silence(self, seconds: float) -> None:
        self._reader.close()
        stack = tuple(self._dump or ())
        self._on_hang(
            HangReport(time.time(), self._describe_process(), seconds, location_of(stack), stack),
            False,
        )

    def _describe_process(self) -> str:
        try:
            status = Path(f"/proc/{self._pid}/status").read_text(encoding="utf-8")
        except OSError:
            status = ""
        stopped = re.search(r"^State:\s+[Tt]", status, re.MULTILINE)
        return "the process, stopped by a signal," if stopped else "the process"


def location_of(stack: tuple[str, ...]) -> str:
    """`file:line` of the innermost frame of user code in a dump of `faulthandler`; "" without."""
    from robocomp_dsl.runtime.component.user_errors import (  # noqa: PLC0415 - only after a hang
        is_library_code,
    )

    frames = filter(None, map(_FRAME.match, stack))
    own = (frame for frame in frames if not is_library_code(frame["file"]))
    return next((f"{frame['file']}:{frame['line']}" for frame in own), "")
