"""Recognises that a program could not be loaded: no restart helps.

In: the lines of output of a process before it was ready. Out: `ImportError: … (file:line)` of user
code that cannot be compiled or imported.
"""

from __future__ import annotations

import re
from collections import deque

from robocomp_dsl.deploy.logs import LogRecord

_ERROR = re.compile(
    r"(?P<logged>\w+ failed: )?"
    r"(?P<error>(SyntaxError|IndentationError|TabError|ImportError|ModuleNotFoundError)\b.*)"
)
_FRAME = re.compile(r'\s+File "(?P<file>[^"]+)", line (?P<line>\d+)')
_MAX_LINES = 100


class LoadErrors:
    """Reads the output of one process; `error` is the latest load error, "" without any."""

    def __init__(self) -> None:
        self.error = ""
        self._lines: deque[str] = deque(maxlen=_MAX_LINES)

    def observe(self, record: LogRecord) -> None:
        """Read a record of the process."""
        found = _ERROR.match(record.text)
        if found and found["logged"] and record.level == "ERROR":
            self.error = found["error"].partition("\n")[0]
        elif found and record.stream == "stderr":
            self.error = f"{found['error']}{self._location()}"
        elif record.stream == "stderr":
            if record.text.startswith("Traceback"):
                # The program caught the error before; the last traceback ended it.
                self.error = ""
                self._lines.clear()
            self._lines.append(record.text)

    def _location(self) -> str:
        """` (file:line)` of the last frame of the traceback."""
        frames = list(filter(None, map(_FRAME.match, self._lines)))
        own = [f for f in frames if not f["file"].startswith("<")]
        return f" ({own[-1]['file']}:{own[-1]['line']})" if own else ""
