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
_HEADS = ("NAME", "STATE", "LIFE", "MACHINE", "PID", "UP", "RESTARTS", "CPU", "MEMORY", "")
_SOMETIMES = ("MACHINE",)
"""Columns that are left out where nobody has anything in them."""
_NONE = "-"


@dataclass(frozen=True, slots=True)
class Row:
    """One component.

    `up_s`: seconds since its process started; `cpu` 1.0 is one core; `memory` in bytes. `life` is
    the state of its life cycle; `machine` are the active states of its state machine, outer ones
    first, where they were asked for. `note` says why it is in this state.
    """

    name: str
    state: str
    pid: int = 0
    up_s: float = 0.0
    restarts: int = 0
    cpu: float = 0.0
    memory: int = 0
    note: str = ""
    life: str = ""
    machine: tuple[str, ...] = ()

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
    shown = [i for i, head in enumerate(_HEADS) if head not in _SOMETIMES or _any(cells, i)]
    widths = {i: max(len(line[i]) for line in cells) for i in shown}
    made = []
    for position, line in enumerate(cells):
        text = "  ".join(line[i].ljust(widths[i]) for i in shown).rstrip()[:width]
        style = "2" if position == 0 else _COLOURS.get(rows[position - 1].state, "")
        made.append(f"\x1b[{style}m{text}\x1b[0m" if colours and style else text)
    return made


def _any(cells: Sequence[tuple[str, ...]], column: int) -> bool:
    return any(line[column] != _NONE for line in cells[1:])


def _cells(row: Row) -> tuple[str, ...]:
    where = (row.name, row.state, row.life or _NONE, ", ".join(row.machine) or _NONE)
    if not row.pid:
        return (*where, _NONE, _NONE, str(row.restarts), _NONE, _NONE, row.note)
    return (
        *where,
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
