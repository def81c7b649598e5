"""Turns the output of components into one stream of log records.

In: bytes of standard output and standard error: JSON lines of the runtime's log, and anything that
user code prints. Out: `LogRecord`s (none is lost, long lines are split), formatted as text or JSON.
"""

from __future__ import annotations

import json
import re
import time
from collections.abc import Collection, Mapping
from dataclasses import asdict, dataclass
from typing import Any

MAX_LINE_BYTES = 64 * 1024
"""Maximum bytes of a line; a longer line continues in the next record."""
MAX_CLOCK_OFFSET_S = 86400.0
"""A record whose time is further off than this gets the time of its arrival instead."""
STREAMS = ("stdout", "stderr")
"""Streams of lines that user code prints; a component of a group in one process names its own."""
RCDEPLOY = "rcdeploy"
"""Component name in the records of rcdeploy itself."""

_COLOURS = ("36", "33", "32", "35", "34", "96", "93", "92", "95", "94")
_LEVELS = {"DEBUG": "2", "WARNING": "33", "ERROR": "31", "CRITICAL": "1;31"}
_CONTROL_CHARS = re.compile(r"\x1b(?!\[[0-9;]*m)|[\x00-\x08\x0b-\x1a\x1c-\x1f\x7f-\x9f]")


@dataclass(frozen=True, slots=True)
class LogRecord:
    """One line of output. `time` in s since 1970; `level` is empty for lines of user code.

    `sequence` counts the records of one run from 1; 0 before it is known. `host` is the name of the
    machine in the description; empty for a deployment on one machine.
    """

    time: float
    component: str
    level: str
    text: str
    stream: str = "log"
    sequence: int = 0
    host: str = ""

    @property
    def label(self) -> str:
        """The host, if there are several, and the component."""
        return f"{self.host} {self.component}" if self.host else self.component

    def to_json(self) -> str:
        """The record as one line of JSON."""
        return json.dumps(asdict(self), ensure_ascii=False)

    @staticmethod
    def from_json(line: str) -> LogRecord:
        """The inverse of `to_json`."""
        return LogRecord(**json.loads(line))


class LineSplitter:
    """Splits a stream of bytes into records of `component`, or of one of the `members`."""

    def __init__(self, component: str, stream: str, members: Collection[str] = ()) -> None:
        self.component = component
        self._members = frozenset(members)
        self.stream = stream
        self._rest = bytearray()

    def feed(self, data: bytes, now: float) -> list[LogRecord]:
        """The records that `data` completes."""
        self._rest += data
        if b"\n" not in data and len(self._rest) <= MAX_LINE_BYTES:
            return []  # a program that writes single characters stays cheap
        *lines, rest = bytes(self._rest).split(b"\n")
        pieces = [piece for line in lines for piece in _split_line(line)]
        *more, last = _split_line(rest)
        self._rest = bytearray(last)
        return [self._record(piece, now) for piece in pieces + more]

    def end(self, now: float) -> list[LogRecord]:
        """The last line, if it has no newline."""
        last, self._rest = bytes(self._rest), bytearray()
        return [self._record(last, now)] if last else []

    def _record(self, line: bytes, now: float) -> LogRecord:
        text = line.decode("utf-8", errors="replace").removesuffix("\r")
        fields = _parse_object(text) if text.startswith("{") else {}
        if "message" in fields and "level" in fields:
            member = str(fields.get("component"))
            component = member if member in self._members else self.component
            return _structured_record(component, fields, now)
        return LogRecord(now, self.component, "", text, self.stream)


def _split_line(line: bytes) -> list[bytes]:
    """`line` in parts of at most `MAX_LINE_BYTES`, never split within a UTF-8 character."""
    parts = []
    while len(line) > MAX_LINE_BYTES:
        cut = MAX_LINE_BYTES
        while line[cut] & 0xC0 == 0x80 and cut > MAX_LINE_BYTES - 4:
            cut -= 1
        parts.append(line[:cut])
        line = line[cut:]
    return [*parts, line]


def _parse_object(text: str) -> dict[str, Any]:
    try:
        data = json.loads(text)
    except (ValueError, RecursionError):
        return {}
    return data if isinstance(data, dict) else {}


def _structured_record(component: str, fields: Mapping[str, Any], now: float) -> LogRecord:
    logged: Any = fields.get("time")
    text = str(fields["message"])
    if trace := fields.get("exception"):
        text += f"\n{trace}"
    plausible = isinstance(logged, float) and abs(logged - now) < MAX_CLOCK_OFFSET_S
    at, level = logged if plausible else now, str(fields["level"]).upper()
    stream = fields.get("stream") if not level else None
    return LogRecord(at, component, level, text, stream if stream in STREAMS else "log")


def parse_line(component: str, text: str, time: float, members: Collection[str] = ()) -> LogRecord:
    """A stored line: a JSON line with its own time, or any text, at `time` [s since 1970].

    `members` are the components of a group in one process, whose lines have their names.
    """
    fields = _parse_object(text) if text.startswith("{") else {}
    if "message" not in fields or "level" not in fields:
        return LogRecord(time, component, "", text, "stdout")
    logged, member = fields.get("time"), str(fields.get("component"))
    owner = member if member in members else component
    return _structured_record(owner, fields, logged if isinstance(logged, float) else time)


def format_record(record: LogRecord, width: int, *, colours: bool) -> str:
    """`record` as text: time, name, level and message, further lines below it."""
    stamp = time.strftime("%H:%M:%S", time.localtime(record.time))
    stamp += f".{int(record.time % 1 * 1000):03d}"
    name = record.label.ljust(width)
    level = "" if record.level in ("", "INFO") else f"{record.level.lower()}: "
    head, *more = _CONTROL_CHARS.sub("\N{REPLACEMENT CHARACTER}", record.text).split("\n")
    if colours:
        name = f"\x1b[{colour_of(record.component)}m{name}\x1b[0m"
        stamp = f"\x1b[2m{stamp}\x1b[0m"
        style = _LEVELS.get(record.level)
        head = f"\x1b[{style}m{level}{head}\x1b[0m" if style else f"{head}\x1b[0m"
    else:
        head = level + head
    indent = " " * (len("00:00:00.000 ") + width)
    return "\n".join([f"{stamp} {name} | {head}", *(f"{indent} | {line}" for line in more)])


def colour_of(component: str) -> str:
    """The ANSI colour code of a component's name; constant per name."""
    if component == RCDEPLOY:
        return "1"
    return _COLOURS[sum(component.encode()) % len(_COLOURS)]
