"""Ports of components as data: interface, name, peers, quality of service."""

from __future__ import annotations

from dataclasses import dataclass

from robocomp_dsl.runtime.component.interface import Interface
from robocomp_dsl.runtime.presence.port_record import PortRecord


@dataclass(frozen=True, slots=True)
class Qos:
    """Quality of service of one port; None: the default of the middleware.

    `depth` is the length of the receive queue; `deadline` in s is the maximum time between two
    publications before one counts as missed.
    """

    reliable: bool | None = None
    depth: int | None = None
    priority: str | None = None
    deadline: float | None = None
    keep_all: bool | None = None
    latched: bool | None = None


@dataclass(frozen=True, slots=True)
class Endpoint:
    """One port of one running component. `peers`: its connections, empty for any peer.

    A peer is `component`, `component.port`, or `*.port` for that port of any component. "Any" means
    components on the same branch (`naming.on_same_branch`); of servers, the nearest. `middlewares`
    in order of preference; empty: the house transport, for a proxy any. `external` are peers that
    are no components.
    """

    interface: Interface
    component: str
    port: str
    peers: tuple[str, ...] = ()
    qos: Qos = Qos()
    middlewares: tuple[str, ...] = ()
    external: tuple[PortRecord, ...] = ()

    @property
    def name(self) -> str:
        """`component.port`."""
        return f"{self.component}.{self.port}"
