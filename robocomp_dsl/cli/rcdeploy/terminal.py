"""Terminal output of a deployment: lines of all components above a permanent table.

In: records and redraw requests, from the event loop. Out: text on one stream, written by its own
thread, so that a stopped terminal (Ctrl-S) blocks nothing else. Lines that a full disk refuses are
dropped and counted.
"""

from __future__ import annotations

import shutil
import threading
import time
from collections import deque
from collections.abc import Callable, Iterator
from functools import partial
from typing import TextIO

from robocomp_dsl.deploy.line_output import LineOutput, write_descriptor
from robocomp_dsl.deploy.logs import RCDEPLOY, LogRecord, format_record
from robocomp_dsl.deploy.session import Display
from robocomp_dsl.deploy.status import ProcessStatus, format_table

MAX_QUEUED_LINES = 50_000
"""Maximum lines in the queue of a slow terminal; then the oldest are dropped with a message."""
_REFRESH_S = 1.0
FLUSH_TIMEOUT_S = 2.0


class Terminal(Display):
    """Shows one deployment until `close`. `live`: with the table; `as_json`: JSON lines."""

    def __init__(
        self, stream: TextIO, names: list[str], *, live: bool, colours: bool, as_json: bool
    ) -> None:
        self._stream = stream
        self._width = max(map(len, [*names, "rcdeploy"]))
        self._live = live
        self._colours = colours
        self._as_json = as_json
        self._waiting: deque[LogRecord] = deque()
        self._lost = 0
        self._dirty = True
        self._ending = False
        self._shown = 0
        self._wake = threading.Condition()
        self._rows: Callable[[], list[ProcessStatus]] = list
        self._abort: Callable[[str], object] = lambda _: None
        self._output = LineOutput(self._writer())
        self._thread = threading.Thread(target=self._run, name="terminal", daemon=True)
        self._thread.start()

    def record(self, record: LogRecord) -> None:
        """Queue a line."""
        with self._wake:
            if len(self._waiting) >= MAX_QUEUED_LINES:
                self._waiting.popleft()
                self._lost += 1
            self._waiting.append(record)
            self._wake.notify()

    def attach(
        self,
        statuses: Callable[[], list[ProcessStatus]],
        abort: Callable[[str], object],
        log: Callable[[str], object],
    ) -> None:
        """Set the source of the table, what a closed output ends, and where errors are logged."""
        self._rows, self._abort = statuses, abort
        self._output.on_error = lambda reason: log(
            f"standard output refuses log lines ({reason}); they are dropped until it takes them"
        )

    def changed(self) -> None:
        """Request a redraw of the table."""
        if self._live:
            with self._wake:
                self._dirty = True
                self._wake.notify()

    def close(self) -> None:
        """Write the queued output, with a time limit for a blocked terminal."""
        with self._wake:
            self._ending = True
            self._wake.notify()
        self._thread.join(FLUSH_TIMEOUT_S)

    def _run(self) -> None:
        try:
            while self._refresh():
                pass
        except BrokenPipeError:  # as in `| head`
            self._abort("output closed (broken pipe)")

    def _refresh(self) -> bool:
        with self._wake:
            self._wake.wait_for(self._needs_refresh, timeout=_REFRESH_S if self._live else None)
            records, self._waiting = self._waiting, deque()
            lost, self._lost = self._lost, 0
            ending = self._ending
            self._dirty = False
        chunks = [
            (self._encode(text), count) for text, count in self._screen(records, lost, ending)
        ]
        if chunks or self._output.dropped:
            self._output.write(chunks, lambda *what: self._encode(self._notice(*what)))
        return not ending

    def _needs_refresh(self) -> bool:
        return bool(self._waiting) or (self._dirty and self._live) or self._ending

    def _screen(
        self, records: deque[LogRecord], lost: int, ending: bool
    ) -> Iterator[tuple[str, int]]:
        """Texts, each with the number of records that it shows."""
        if self._shown:
            yield f"\x1b[{self._shown}F\x1b[J", 0
        self._shown = 0
        if lost:
            yield self._notice(lost, "the terminal was too slow"), lost
        for record in records:
            yield self._format(record), 1
        if self._live and not ending:
            yield "".join(self._table()), 0

    def _format(self, record: LogRecord) -> str:
        if self._as_json:
            return record.to_json() + "\n"
        return format_record(record, self._width, colours=self._colours) + "\n"

    def _notice(self, lost: int, reason: str) -> str:
        text = f"… {lost} line{'s were' if lost > 1 else ' was'} dropped: {reason}"
        if self._as_json:
            return LogRecord(time.time(), RCDEPLOY, "WARNING", text).to_json() + "\n"
        return f"{text}\n"

    def _table(self) -> Iterator[str]:
        columns, lines = shutil.get_terminal_size()
        rows = format_table(self._rows(), columns - 1, colours=self._colours)
        room = max(lines // 2, 2)
        if len(rows) > room:
            rows = [*rows[: room - 1], f"… and {len(rows) - room + 1} more (rcdeploy status)"]
        if len(rows) > 1:
            self._shown = len(rows)
            yield "".join(f"{row}\n" for row in rows)

    def _encode(self, text: str) -> bytes:
        return text.encode(self._stream.encoding or "utf-8", "backslashreplace")

    def _writer(self) -> Callable[[bytes], int]:
        """Writes past the buffer of the stream, which would keep what the file refuses."""
        try:
            self._stream.flush()
            return partial(write_descriptor, self._stream.fileno())
        except OSError:  # no file, as in tests and notebooks
            return self._write_stream

    def _write_stream(self, data: bytes) -> int:
        self._stream.write(data.decode(self._stream.encoding or "utf-8"))
        return len(data)
