"""Ports of components as data: interface, name, peers, quality of service."""

from __future__ import annotations

from dataclasses import dataclass

from robocomp_dsl.runtime.component.interface import Interface
from robocomp_dsl.runtime.presence.port_record import PortRecord

NOBODY = "-"
"""The only peer of a port that is disconnected from all: no component has this name."""


@dataclass(frozen=True, slots=True)
class Qos:
    """Quality of service of a port or a connection; None: the default of the middleware.

    `reliable`: a publisher waits for a subscriber that is behind, for a limited time. `depth` is
    the length of the receive queue, which drops its oldest message. `keep_all`: the queue drops
    none; a full one holds the publisher as `reliable` does. `latched`: a subscriber that starts
    later gets the latest message. `priority` is that of the messages on the wire. `deadline` in s
    is the maximum time between two messages. `liveliness` in s is the maximum time without a sign
    of life of a publisher. `thread_priority` of the receiving thread, 1 to 99 (SCHED_FIFO).
    """

    reliable: bool | None = None
    depth: int | None = None
    priority: str | None = None
    deadline: float | None = None
    keep_all: bool | None = None
    latched: bool | None = None
    liveliness: float | None = None
    thread_priority: int | None = None

    @property
    def holds_publisher(self) -> bool:
        """Whether a full queue holds the publisher."""
        return bool(self.reliable or self.keep_all)


@dataclass(frozen=True, slots=True)
class Endpoint:
    """One port of one running component. `peers`: its connections, empty for any peer.

    A peer is `component`, `component.port`, or `*.port` for that port of any component. "Any" means
    components on the same branch (`naming.on_same_branch`); of servers, the nearest. `middlewares`
    in order of preference; empty: the house transport, for a proxy any. `external` are peers that
    are no components. `peer_qos` are the items of single connections, by peer.
    """

    interface: Interface
    component: str
    port: str
    peers: tuple[str, ...] = ()
    qos: Qos = Qos()
    middlewares: tuple[str, ...] = ()
    external: tuple[PortRecord, ...] = ()
    peer_qos: tuple[tuple[str, Qos], ...] = ()

    @property
    def name(self) -> str:
        """`component.port`."""
        return f"{self.component}.{self.port}"
