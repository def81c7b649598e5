"""Output of components as one stream of records.

In: bytes of their standard output and error: JSON lines of the runtime's log, and whatever user
code prints. Out: `Record`s, none lost, long lines in pieces; and records as text or JSON.
"""

from __future__ import annotations

import json
import re
import time
from collections.abc import Mapping
from dataclasses import asdict, dataclass
from typing import Any

LONGEST = 64 * 1024
"""Bytes of a line; what is longer goes on in the next record."""
A_DAY_S = 86400.0
"""A component whose clock is further off is not believed, its lines get the time of arrival."""
OWN = "rcdeploy"
"""The name under which rcdeploy itself speaks."""

_COLOURS = ("36", "33", "32", "35", "34", "96", "93", "92", "95", "94")
_LEVELS = {"DEBUG": "2", "WARNING": "33", "ERROR": "31", "CRITICAL": "1;31"}
_STEERING = re.compile(r"\x1b(?!\[[0-9;]*m)|[\x00-\x08\x0b-\x1a\x1c-\x1f\x7f-\x9f]")


@dataclass(frozen=True, slots=True)
class Record:
    """One line. `time` in seconds since 1970; `level` is empty for what user code printed."""

    time: float
    component: str
    level: str
    text: str
    stream: str = "log"

    def as_json(self) -> str:
        """One line of JSON."""
        return json.dumps(asdict(self), ensure_ascii=False)

    @staticmethod
    def of_json(line: str) -> Record:
        """The inverse of `as_json`."""
        return Record(**json.loads(line))


class Lines:
    """Cuts a stream of bytes into records."""

    def __init__(self, component: str, stream: str) -> None:
        self.component = component
        self.stream = stream
        self._rest = bytearray()

    def feed(self, data: bytes, now: float) -> list[Record]:
        """The records that `data` completes."""
        self._rest += data
        if b"\n" not in data and len(self._rest) <= LONGEST:
            return []  # so that a program that writes letter by letter costs no more
        *lines, rest = bytes(self._rest).split(b"\n")
        pieces = [piece for line in lines for piece in _pieces(line)]
        *more, last = _pieces(rest)
        self._rest = bytearray(last)
        return [self._record(piece, now) for piece in pieces + more]

    def end(self, now: float) -> list[Record]:
        """The last line, if it has no line end."""
        last, self._rest = bytes(self._rest), bytearray()
        return [self._record(last, now)] if last else []

    def _record(self, line: bytes, now: float) -> Record:
        text = line.decode("utf-8", errors="replace").removesuffix("\r")
        said = _fields(text) if text.startswith("{") else {}
        if "message" in said and "level" in said:
            return _logged(self.component, said, now)
        return Record(now, self.component, "", text, self.stream)


def _pieces(line: bytes) -> list[bytes]:
    """`line` in pieces of `LONGEST`, none of which ends within a character of UTF-8."""
    made = []
    while len(line) > LONGEST:
        cut = LONGEST
        while line[cut] & 0xC0 == 0x80 and cut > LONGEST - 4:
            cut -= 1
        made.append(line[:cut])
        line = line[cut:]
    return [*made, line]


def _fields(text: str) -> dict[str, Any]:
    try:
        said = json.loads(text)
    except (ValueError, RecursionError):
        return {}
    return said if isinstance(said, dict) else {}


def _logged(component: str, said: Mapping[str, Any], now: float) -> Record:
    at: Any = said.get("time")
    text = str(said["message"])
    if trace := said.get("exception"):
        text += f"\n{trace}"
    near = isinstance(at, float) and abs(at - now) < A_DAY_S
    return Record(at if near else now, component, str(said["level"]).upper(), text)


def as_text(record: Record, width: int, *, colours: bool) -> str:
    """`record` for people: time, name, level and the text, further lines below it."""
    stamp = time.strftime("%H:%M:%S", time.localtime(record.time))
    stamp += f".{int(record.time % 1 * 1000):03d}"
    name = record.component.ljust(width)
    level = "" if record.level in ("", "INFO") else f"{record.level.lower()}: "
    head, *more = _STEERING.sub("\N{REPLACEMENT CHARACTER}", record.text).split("\n")
    if colours:
        name = f"\x1b[{colour(record.component)}m{name}\x1b[0m"
        stamp = f"\x1b[2m{stamp}\x1b[0m"
        style = _LEVELS.get(record.level)
        head = f"\x1b[{style}m{level}{head}\x1b[0m" if style else f"{head}\x1b[0m"
    else:
        head = level + head
    indent = " " * (len("00:00:00.000 ") + width)
    return "\n".join([f"{stamp} {name} | {head}", *(f"{indent} | {line}" for line in more)])


def colour(component: str) -> str:
    """The colour of a name: always the same for the same name."""
    if component == OWN:
        return "1"
    return _COLOURS[sum(component.encode()) % len(_COLOURS)]
