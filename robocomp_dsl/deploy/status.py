"""Status of the processes of a deployment: as objects, as a table and as JSON. Pure."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import asdict, dataclass
from typing import Any

from robocomp_dsl.runtime.component.hang_report import HangReport

WAITING = "waiting"
STARTING = "starting"
READY = "ready"
UNKNOWN = "unknown"
BACKOFF = "restarting"
STOPPING = "stopping"
EXITED = "exited"
FAILED = "failed"
HUNG = "hung"

_COLOURS = {READY: "32", FAILED: "1;31", HUNG: "1;31", BACKOFF: "33", UNKNOWN: "33", STARTING: "36"}
_COLUMNS = (
    "NAME",
    "HOST",
    "STATE",
    "LIFE",
    "MACHINE",
    "PID",
    "UP",
    "RESTARTS",
    "CPU",
    "MEMORY",
    "OVERRUNS",
    "",
)
_OPTIONAL_COLUMNS = ("HOST", "MACHINE", "OVERRUNS")
"""Columns that are left out if all their cells are empty."""
_EMPTY = "-"


@dataclass(frozen=True, slots=True)
class ProcessStatus:
    """Status of one component's process.

    `up_s`: seconds since its start; `cpu`: 1.0 is one core; `memory` in bytes. `life` is the
    lifecycle state; `machine` are the active states of the state machine, outer ones first, if they
    were queried. `note` is the reason for the state. `overruns` counts cycles that exceeded the
    period; `hang` is the latest hang, also of an earlier process of the component. `host` is empty
    if the supervisor of this machine runs it. `members` are the components of a group in one
    process, each with its lifecycle state.
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
    overruns: int = 0
    hang: HangReport | None = None
    host: str = ""
    members: tuple[tuple[str, str], ...] = ()

    @staticmethod
    def from_dict(fields: Mapping[str, Any]) -> ProcessStatus:
        """The inverse of `as_dict`."""
        hang = HangReport.from_fields(fields["hang"]) if fields.get("hang") else None
        lists = {
            "machine": tuple(fields["machine"]),
            "members": tuple((name, life) for name, life in fields.get("members", ())),
        }
        return ProcessStatus(**{**fields, **lists, "hang": hang})

    def as_dict(self) -> dict[str, Any]:
        """The fields as a dictionary, for JSON."""
        return asdict(self)


@dataclass(frozen=True, slots=True)
class SimulatedTime:
    """Simulated time of a deployment, in s since the last reset.

    `factor` is the recent real-time factor: simulated seconds per second of wall time.
    """

    seconds: float
    factor: float
    resets: int = 0
    paused: bool = False

    def as_dict(self) -> dict[str, Any]:
        """The fields as a dictionary, for JSON."""
        return asdict(self)

    def format(self) -> str:
        """As text: `simulated time 4.20 s, 1.00 times real time`."""
        speed = "paused" if self.paused else f"{self.factor:.2f} times real time"
        resets = f", reset {self.resets} times" if self.resets else ""
        return f"simulated time {self.seconds:.2f} s, {speed}{resets}"


def format_table(rows: Sequence[ProcessStatus], width: int, *, colours: bool) -> list[str]:
    """`rows` as text lines of at most `width` characters, with a header."""
    shown = [each for row in rows for each in (row, *_member_rows(row))]
    cells = [_COLUMNS, *map(_cells, shown)]
    columns = [
        i
        for i, name in enumerate(_COLUMNS)
        if name not in _OPTIONAL_COLUMNS or _has_values(cells, i)
    ]
    widths = {i: max(len(line[i]) for line in cells) for i in columns}
    lines = []
    for position, line in enumerate(cells):
        text = "  ".join(line[i].ljust(widths[i]) for i in columns).rstrip()[:width]
        style = "2" if position == 0 else _COLOURS.get(shown[position - 1].state, "")
        lines.append(f"\x1b[{style}m{text}\x1b[0m" if colours and style else text)
    return lines


def _member_rows(row: ProcessStatus) -> list[ProcessStatus]:
    """A line for each component of a group in one process; what is of the process is above."""
    return [ProcessStatus(f"  {name}", "", life=life) for name, life in row.members]


def _has_values(cells: Sequence[tuple[str, ...]], column: int) -> bool:
    return any(line[column] != _EMPTY for line in cells[1:])


def _cells(row: ProcessStatus) -> tuple[str, ...]:
    machine = ", ".join(row.machine) or _EMPTY
    states = (row.name, row.host or _EMPTY, row.state, row.life or _EMPTY, machine)
    if not row.state:  # a component of a group
        return (*states, *[""] * (len(_COLUMNS) - len(states)))
    if not row.pid:
        empty = (_EMPTY, _EMPTY, str(row.restarts), _EMPTY, _EMPTY, _EMPTY)
        return (*states, *empty, row.note)
    return (
        *states,
        str(row.pid),
        format_duration(row.up_s),
        str(row.restarts),
        f"{row.cpu * 100:.0f} %",
        f"{row.memory / 1e6:.0f} MB",
        str(row.overruns or _EMPTY),
        row.note,
    )


def format_hangs(rows: Sequence[ProcessStatus], now: float) -> list[str]:
    """The latest hang of each component, with its Python stack, as text lines."""
    lines = []
    for row in rows:
        if row.hang:
            ago = format_duration(max(now - row.hang.at, 0.0))
            lines += ["", f"{row.name}, {ago} ago: {row.hang.summary()}", *row.hang.stack]
    return lines


def format_duration(seconds: float) -> str:
    """`4.2 s`, `3 min 20 s`, `5 h 12 min`."""
    if seconds < 60:
        return f"{seconds:.1f} s"
    minutes, rest = divmod(int(seconds), 60)
    if minutes < 60:
        return f"{minutes} min {rest} s"
    return f"{minutes // 60} h {minutes % 60} min"
