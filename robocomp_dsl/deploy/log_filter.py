"""Selects log records by component, level, time and text. Pure, except for the time of day."""

from __future__ import annotations

import re
from collections.abc import Collection
from dataclasses import dataclass
from datetime import datetime

from robocomp_dsl.deploy.logs import LogRecord

LEVELS = ("debug", "info", "warning", "error", "critical")
_UNITS = {"s": 1.0, "min": 60.0, "h": 3600.0, "d": 86400.0}
_AGE = re.compile(r"(\d+(?:\.\d+)?)\s*([a-z]+)")
_FORMATS = ("%H:%M", "%H:%M:%S", "%Y-%m-%d", "%Y-%m-%d %H:%M", "%Y-%m-%d %H:%M:%S")


@dataclass(frozen=True, slots=True)
class LogFilter:
    """Accepts the records that satisfy all conditions; an empty condition accepts all.

    `level` is the lowest one; a line without level, as user code prints it, counts as `info`.
    `since` in s since 1970.
    """

    components: Collection[str] = ()
    level: str = ""
    since: float = 0.0
    pattern: re.Pattern[str] | None = None

    def matches(self, record: LogRecord) -> bool:
        """Whether the record is accepted."""
        return (
            (not self.components or record.component in self.components)
            and record.time >= self.since
            and (not self.level or _rank(record.level) >= LEVELS.index(self.level))
            and (self.pattern is None or self.pattern.search(record.text) is not None)
        )


def _rank(level: str) -> int:
    name = level.lower() or "info"
    return LEVELS.index(name) if name in LEVELS else LEVELS.index("info")


def parse_since(text: str, now: float) -> float:
    """`10 min` ago, `20:15` today or the day before, `2026-11-22`, `2026-11-22 20:15`.

    The result in s since 1970; raises `ValueError`.
    """
    words = text.strip()
    if (age := _AGE.fullmatch(words)) and age[2] in _UNITS:
        return now - float(age[1]) * _UNITS[age[2]]
    for pattern in _FORMATS:
        try:
            moment = datetime.strptime(words.replace("T", " "), pattern)
        except ValueError:
            continue
        if not pattern.startswith("%H"):
            return moment.timestamp()
        today = datetime.fromtimestamp(now)
        result = moment.replace(year=today.year, month=today.month, day=today.day).timestamp()
        return result if result <= now else result - _UNITS["d"]
    raise ValueError(f"`{text}` is no time: use `10 min`, `20:15` or `2026-11-22 20:15`")
