"""What a middleware offers to a component, as Protocols. In: endpoints and handlers. Out: calls.

A middleware is one package here, or in another distribution, under an entry point of the group
`robocomp_dsl.middleware`: a function that takes a `Host` and gives a `Middleware`. The suite in
`tests/middleware/` says what it must do; failures are those of `robocomp_dsl.runtime.errors`.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import dataclass
from typing import Any, Protocol, TypeAlias

from robocomp_dsl.runtime.execution import Execution
from robocomp_dsl.runtime.interface import Interface, Operation
from robocomp_dsl.runtime.statistics import Statistics

Bound: TypeAlias = Callable[..., Any]


@dataclass(frozen=True, slots=True)
class Qos:
    """Quality of service of one port; None: as the middleware has it.

    `depth` is the length of the queue in front of a handler; `deadline` in s is the longest time
    between two publications that is not counted as missed.
    """

    reliable: bool | None = None
    depth: int | None = None
    priority: str | None = None
    deadline: float | None = None


@dataclass(frozen=True, slots=True)
class Endpoint:
    """One port of one running component. `peers`: the components it is wired to, empty for any.

    A peer is `component` or `component.port`, or `*.port` for that port of any component. `any` are
    those that are `naming.related`; of servers the `naming.nearest` count.
    """

    interface: Interface
    component: str
    port: str
    peers: tuple[str, ...] = ()
    qos: Qos = Qos()


@dataclass(frozen=True, slots=True)
class Host:
    """The component that a middleware works for. Components of other domains are not seen.

    `listen_port` 0: as the middleware likes.
    """

    component: str
    domain: str
    execution: Execution
    statistics: Statistics
    listen_port: int = 0


class Link(Protocol):
    """The calling side of a port: what a proxy is bound to. `timeout` in s bounds every call."""

    timeout: float

    def bind(self, operation: Operation) -> Bound:
        """The function that carries out `operation`; it takes the inputs in order."""

    def wait(self, timeout: float) -> bool:
        """Whether there is a peer, waiting for one up to `timeout` s."""

    def heard(self) -> bool:
        """Whether anything would become of a publication now; without waiting, at hardly a cost."""


class Middleware(Protocol):
    """All connections of one component."""

    def serve(self, at: Endpoint, handlers: Mapping[str, Bound], execution: Execution) -> None:
        """Answer queries and commands with `handlers`, by operation name, under `execution`."""

    def proxy(self, at: Endpoint) -> Link:
        """Call a peer that serves the interface."""

    def advertise(self, at: Endpoint) -> Link:
        """Publish to whoever subscribes."""

    def subscribe(self, at: Endpoint, handlers: Mapping[str, Bound], execution: Execution) -> None:
        """Hand publications to `handlers`, by operation name, in the order of each publisher."""

    def announce(self, state: str) -> None:
        """Tell all who watch the domain the state of the life cycle; "" before the end."""

    def interrupt(self) -> None:
        """Let calls that wait raise at once, and all later ones."""

    def close(self) -> None:
        """End all of it; nothing is handled or called afterwards."""
