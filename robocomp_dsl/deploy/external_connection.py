"""The state of a connection between external programs: as an object, as text, as JSON. Pure."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import asdict, dataclass
from typing import Any

from robocomp_dsl.model.deployment import ExternalConnection

WAITING = "waiting"
CONNECTED = "connected"


@dataclass(frozen=True, slots=True)
class ConnectionStatus:
    """The state of one connection; `reason` tells why it waits."""

    middleware: str
    source: str
    target: str
    carrier: str
    state: str
    reason: str = ""

    def ends(self) -> str:
        """`/camera:o -> /view:i over yarp (tcp)`."""
        how = f" ({self.carrier})" if self.carrier else ""
        return f"{self.source} -> {self.target} over {self.middleware}{how}"

    def as_dict(self) -> dict[str, Any]:
        """The fields as a dictionary, for JSON."""
        return asdict(self)


def format_connections(statuses: Sequence[ConnectionStatus]) -> list[str]:
    """A line for each connection."""
    return [
        f"{status.ends()}: {status.state}{f' ({status.reason})' if status.reason else ''}"
        for status in statuses
    ]


def describe_connection(connection: ExternalConnection) -> str:
    """A connection of a plan as text."""
    ends = (connection.middleware, connection.source, connection.target, connection.carrier)
    return ConnectionStatus(*ends, WAITING).ends()
