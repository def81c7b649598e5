"""The state of a running deployment as rows, a table and JSON. Pure."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import asdict, dataclass
from typing import Any

WAITING = "waiting"
STARTING = "starting"
READY = "ready"
UNSEEN = "unseen"
BACKOFF = "restarting"
STOPPING = "stopping"
ENDED = "ended"
FAILED = "failed"

_COLOURS = {READY: "32", FAILED: "1;31", BACKOFF: "33", UNSEEN: "33", STARTING: "36"}
_HEADS = ("NAME", "STATE", "PID", "UP", "RESTARTS", "CPU", "MEMORY", "")


@dataclass(frozen=True, slots=True)
class Row:
    """One component.

    `up_s`: seconds since its process started; `cpu` 1.0 is one core; `memory` in bytes. `note` says
    why it is in this state.
    """

    name: str
    state: str
    pid: int = 0
    up_s: float = 0.0
    restarts: int = 0
    cpu: float = 0.0
    memory: int = 0
    note: str = ""

    def as_dict(self) -> dict[str, Any]:
        """For JSON."""
        return asdict(self)


@dataclass(frozen=True, slots=True)
class Time:
    """Simulated time of a deployment, in s since the last of `resets`.

    `factor`: simulated seconds per second of late.
    """

    seconds: float
    factor: float
    resets: int = 0
    paused: bool = False

    def as_dict(self) -> dict[str, Any]:
        """For JSON."""
        return asdict(self)

    def shown(self) -> str:
        """In words."""
        pace = "stands still" if self.paused else f"{self.factor:.2f} times real time"
        resets = f", reset {self.resets} times" if self.resets else ""
        return f"simulated time {self.seconds:.2f} s, {pace}{resets}"


def table(rows: Sequence[Row], width: int, *, colours: bool) -> list[str]:
    """`rows` as lines of at most `width` columns, a head above them."""
    cells = [_HEADS, *(_cells(row) for row in rows)]
    widths = [max(len(line[i]) for line in cells) for i in range(len(_HEADS))]
    made = []
    for position, line in enumerate(cells):
        padded = [text.ljust(size) for text, size in zip(line, widths, strict=True)]
        text = "  ".join(padded).rstrip()[:width]
        style = "2" if position == 0 else _COLOURS.get(rows[position - 1].state, "")
        made.append(f"\x1b[{style}m{text}\x1b[0m" if colours and style else text)
    return made


def _cells(row: Row) -> tuple[str, ...]:
    if not row.pid:
        return (row.name, row.state, "-", "-", str(row.restarts), "-", "-", row.note)
    return (
        row.name,
        row.state,
        str(row.pid),
        duration(row.up_s),
        str(row.restarts),
        f"{row.cpu * 100:.0f} %",
        f"{row.memory / 1e6:.0f} MB",
        row.note,
    )


def duration(seconds: float) -> str:
    """`4.2 s`, `3 min 20 s`, `5 h 12 min`."""
    if seconds < 60:
        return f"{seconds:.1f} s"
    minutes, rest = divmod(int(seconds), 60)
    if minutes < 60:
        return f"{minutes} min {rest} s"
    return f"{minutes // 60} h {minutes % 60} min"
