"""Log output of a component: text for a terminal, or JSON lines for programs.

In: records of the standard `logging`. Out: lines on standard error. A JSON line has `time` (s since
1970), `level`, `component`, `host`, `pid`, `message`, `logger`, and `exception` if there is one;
the fields of `extra={"fields": {...}}` are added.
"""

from __future__ import annotations

import json
import logging
import os
import socket
import sys
import time
from collections.abc import Callable
from typing import TextIO, TypeAlias

ComponentOf: TypeAlias = Callable[[logging.LogRecord], str]
"""The component whose log a record belongs to."""
HOST_VARIABLE = "ROBOCOMP_HOST"
"""The name of this machine in the deployment; the default is its own name."""
LEVELS = ("debug", "info", "warning", "error", "critical")
_COLOURS = {"DEBUG": "2", "WARNING": "33", "ERROR": "31", "CRITICAL": "1;31"}


class JsonFormatter(logging.Formatter):
    """One JSON object per record."""

    def __init__(self, component_of: ComponentOf) -> None:
        super().__init__()
        self._component_of = component_of
        self._constant_fields = {
            "host": os.environ.get(HOST_VARIABLE) or socket.gethostname(),
            "pid": os.getpid(),
        }

    def format(self, record: logging.LogRecord) -> str:
        """See `logging.Formatter`."""
        fields = {
            "time": record.created,
            "level": record.levelname,
            "component": self._component_of(record),
            **self._constant_fields,
            "message": record.getMessage(),
            "logger": record.name,
        }
        if record.exc_info:
            fields["exception"] = self.formatException(record.exc_info)
        return json.dumps(fields | getattr(record, "fields", {}), ensure_ascii=False, default=str)


class TextFormatter(logging.Formatter):
    """Time, component, level and message; coloured on a terminal."""

    def __init__(self, component_of: ComponentOf, *, colours: bool) -> None:
        super().__init__()
        self._component_of = component_of
        self._colours = colours

    def format(self, record: logging.LogRecord) -> str:
        """See `logging.Formatter`."""
        stamp = time.strftime("%H:%M:%S", time.localtime(record.created))
        level = "" if record.levelno == logging.INFO else f"{record.levelname.lower()}: "
        text = f"{level}{record.getMessage()}"
        if record.exc_info:
            text += f"\n{self.formatException(record.exc_info)}"
        style = _COLOURS.get(record.levelname) if self._colours else None
        text = f"\x1b[{style}m{text}\x1b[0m" if style else text
        return f"{stamp}.{int(record.msecs):03d} {self._component_of(record)} | {text}"


def set_up(
    component: str,
    level: str,
    output_format: str,
    component_of: ComponentOf | None = None,
    stream: TextIO | None = None,
) -> None:
    """Send all logs of this process to `stream` (standard error), as `text` or `json`.

    `component_of` is for a process with several components; the default is `component`.
    """
    of = component_of or (lambda _record: component)
    out = stream or sys.stderr
    handler = logging.StreamHandler(out)
    colours = out.isatty() and "NO_COLOR" not in os.environ
    json_lines = output_format == "json"
    handler.setFormatter(JsonFormatter(of) if json_lines else TextFormatter(of, colours=colours))
    logging.basicConfig(handlers=[handler], level=level.upper(), force=True)


def set_level(level: str) -> None:
    """Set the minimum level. Raises `ValueError` for an unknown level."""
    if level.lower() not in LEVELS:
        raise ValueError(f"unknown log level `{level}`; valid: {', '.join(LEVELS)}")
    logging.getLogger().setLevel(level.upper())
