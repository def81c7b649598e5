"""What the components of one process print, as lines that say which component it was.

In: text that a thread of a component writes to standard output or standard error. Out: a JSON line
as those of the log, without a level. What no component writes stays as it is.
"""

from __future__ import annotations

import io
import json
import threading
import time
from collections.abc import Iterable
from typing import BinaryIO, TextIO

from robocomp_dsl.runtime.component.thread_context import current_context


class MemberOutput(io.TextIOBase):
    """Replaces `sys.stdout` or `sys.stderr`, called `name`; `stream` is the former one."""

    def __init__(self, stream: TextIO, name: str) -> None:
        self._stream = stream
        self._name = name
        self._lock = threading.Lock()
        self._lines: dict[str, str] = {}

    @property
    def encoding(self) -> str:  # type: ignore[override]
        """See `TextIO`."""
        return self._stream.encoding

    @property
    def buffer(self) -> BinaryIO:
        """The bytes of the stream, which have no component."""
        return self._stream.buffer

    def fileno(self) -> int:
        """See `TextIO`."""
        return self._stream.fileno()

    def isatty(self) -> bool:
        """See `TextIO`."""
        return self._stream.isatty()

    def writable(self) -> bool:
        """See `TextIO`."""
        return True

    def write(self, text: str) -> int:
        """Write the lines that `text` completes."""
        context = current_context()
        if context is None:
            return self._stream.write(text)
        with self._lock:
            *lines, rest = (self._lines.pop(context.name, "") + text).split("\n")
            if rest:
                self._lines[context.name] = rest
            self._write_lines(context.name, lines)
        return len(text)

    def _write_lines(self, component: str, lines: Iterable[str]) -> None:
        for line in lines:
            fields = {
                "time": time.time(),
                "level": "",
                "component": component,
                "message": line,
                "stream": self._name,
            }
            self._stream.write(f"{json.dumps(fields, ensure_ascii=False)}\n")

    def flush(self) -> None:
        """Flush complete lines; others wait for their end."""
        self._stream.flush()

    def finish(self) -> None:
        """Write lines that have no end."""
        with self._lock:
            for component, rest in self._lines.items():
                self._write_lines(component, [rest])
            self._lines.clear()
        self._stream.flush()
