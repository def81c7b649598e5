"""What is known of a port of a component: who has it, and how to reach it."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Literal

PortRole = Literal["server", "publisher", "subscriber"]


@dataclass(frozen=True, slots=True)
class PortRecord:
    """One port of a component on one middleware; a port on several has a record for each.

    Only the transport of `middleware` interprets `address`. `hash` is the type hash of the
    interface in hexadecimal; it is empty for an external peer, which has none to compare. `peers`
    are the connections of a subscriber, as in `Endpoint.peers`.
    """

    role: str
    interface: str
    component: str
    port: str
    hash: str = ""
    middleware: str = ""
    address: str = ""
    peers: tuple[str, ...] = ()

    @property
    def name(self) -> str:
        """`component.port`."""
        return f"{self.component}.{self.port}"
