"""The monitors of a component as data; `parse_monitors` reads them."""

from __future__ import annotations

from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from robocomp_dsl.monitors.constraint import Constraint


@dataclass(frozen=True, slots=True)
class MonitorSettings:
    """One monitor: the class `class_name` of the Python file, created with `parameters`.

    `closes_on_failure`: after a failure the connection passes nothing; otherwise messages pass
    unchanged.
    """

    file: Path
    class_name: str
    parameters: tuple[tuple[str, bool | int | float | str], ...] = ()
    closes_on_failure: bool = False


@dataclass(frozen=True, slots=True)
class ConnectionMonitors:
    """The monitors at one end of a connection of `port` with `peer` (`component.Port`).

    `position`: `receiver` or `sender`, the end that the component has; `identify`: the component
    calls a server that monitors this connection. `constraint`: the connection is arbitrated.
    """

    port: str
    peer: str
    position: str
    monitors: tuple[MonitorSettings, ...] = ()
    constraint: Constraint | None = None
