"""Writes lines to a file that may refuse them: a full disk, a quota, a failing device.

In: lines. Out: bytes in the file; lines that the file refuses are dropped and counted, and the next
ones are tried again. Only a closed pipe ends the output.
"""

from __future__ import annotations

import os
import select
from collections.abc import Callable, Sequence

Chunk = tuple[bytes, int]
"""Bytes, and the number of log lines that they show."""


class LineOutput:
    """Writes chunks through `write`, which returns how many bytes it took.

    `dropped` lines were refused since the last success, because of `reason`. `on_error` is called
    once, at the first refusal.
    """

    def __init__(
        self, write: Callable[[bytes], int], on_error: Callable[[str], object] = lambda _: None
    ) -> None:
        self._write = write
        self.on_error = on_error
        self.dropped = 0
        self.reason = ""
        self._reported = False
        self._within_line = False

    def write(self, chunks: Sequence[Chunk], notice: Callable[[int, str], bytes]) -> bool:
        """Write `chunks`, after the notice of dropped lines if there are any.

        Returns False if some were refused. Raises `BrokenPipeError`.
        """
        left = list(chunks)
        if self.dropped:
            start = b"\n" if self._within_line else b""
            left.insert(0, (start + notice(self.dropped, self.reason), 0))
        dropped_before, self.dropped = self.dropped, 0
        written, error = self._write_bytes(b"".join(data for data, _ in left))
        if error is None:
            self._within_line = False
            return True
        for position, (data, count) in enumerate(left):
            if written < len(data):
                self.dropped += count
                if position == 0 and dropped_before:
                    self.dropped += dropped_before
            written = max(0, written - len(data))
        self.reason = error.strerror or str(error)
        if not self._reported:
            self._reported = True
            self.on_error(self.reason)
        return False

    def _write_bytes(self, data: bytes) -> tuple[int, OSError | None]:
        """The number of written bytes, and why the others were not."""
        written = 0
        try:
            while written < len(data):
                written += self._write(data[written:])
        except BrokenPipeError:
            raise
        except OSError as error:
            if written:
                self._within_line = data[written - 1 : written] != b"\n"
            return written, error
        return written, None


def write_descriptor(descriptor: int, data: bytes) -> int:
    """Write to a file descriptor, which may be non-blocking; returns the number of bytes."""
    while True:
        try:
            return os.write(descriptor, data)
        except BlockingIOError:
            select.select([], [descriptor], [])
