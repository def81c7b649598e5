"""Turns the log file of a component on a host into records. Pure.

In: bytes of the file, in order. Out: `LogRecord`s with the host. A line without time, as programs
print it, gets the time of the line before, or that of the file's last change if that is later.
"""

from __future__ import annotations

from collections.abc import Collection
from dataclasses import replace

from robocomp_dsl.deploy.logs import LineSplitter, LogRecord, parse_line


class FileRecords(LineSplitter):
    """The records of one file."""

    def __init__(self, component: str, host: str, members: Collection[str] = ()) -> None:
        super().__init__(component, "log", members)
        self.host = host
        self._latest = 0.0

    def _record(self, line: bytes, now: float) -> LogRecord:
        text = line.decode("utf-8", errors="replace").removesuffix("\r")
        record = parse_line(self.component, text, self._latest or now, self._members)
        self._latest = max(self._latest, record.time)
        return replace(record, host=self.host)

    def arrived(self, changed: float) -> None:
        """The next lines were written now, at `changed` [s since 1970]."""
        self._latest = max(self._latest, changed)
