"""Ports of a component in lock-step: every message is a call that returns when it was handled.

In: a middleware. Out: a `Ports` that wraps it. Each interface has a timed interface, whose
operations are all queries and carry the simulated time, to which the receiver's clock is set.
Components in lock-step use the timed interfaces; other programs still see the plain interfaces.
"""

from __future__ import annotations

import logging
from collections.abc import Callable, Iterable, Mapping
from dataclasses import replace
from functools import cache
from typing import Any

from robocomp_dsl.runtime.component.callback_group import CallbackGroup
from robocomp_dsl.runtime.component.interface import Interface, Operation
from robocomp_dsl.runtime.connection.endpoint import Endpoint
from robocomp_dsl.runtime.connection.peer_selection import matches
from robocomp_dsl.runtime.connection.ports import Channel, OperationCallable, Ports
from robocomp_dsl.runtime.data.schema import LONG
from robocomp_dsl.runtime.errors import MiddlewareError, NoServer, RemoteError
from robocomp_dsl.runtime.time.clock_interface import CLOCK, Hearer

PUBLISH_TIME_FRACTION = 0.25
"""Fraction of the step limit that handling one publication may take."""

log = logging.getLogger("robocomp")


@cache
def timed_interface(interface: Interface) -> Interface:
    """The same operations as queries, with the time as first argument."""
    return Interface(
        f"{interface.name} in step",
        *(
            Operation(
                operation.name,
                inputs=(("now_in_step", LONG), *operation.inputs),
                outputs=operation.outputs,
                throws=operation.throws,
                idempotent=operation.idempotent,
            )
            for operation in interface.operations
        ),
    )


def _timed_endpoint(at: Endpoint) -> Endpoint:
    """The timed port of `at`, on the house transport."""
    return replace(at, interface=timed_interface(at.interface), middlewares=(), external=())


class LockstepPorts:
    """Ports of a lock-step component.

    `now` returns the time in ns to send; `set_time` receives the time of incoming messages.
    """

    def __init__(
        self,
        inner: Ports,
        limit: float,
        now: Callable[[], int],
        set_time: Callable[[int], None],
    ) -> None:
        self._inner = inner
        self._limit = limit
        self._now = now
        self._set_time = set_time
        self._topics: list[LockstepTopicChannel] = []
        self.subscribers: list[Hearer] = []

    def serve(
        self, at: Endpoint, handlers: Mapping[str, OperationCallable], execution: CallbackGroup
    ) -> None:
        """See `Ports`."""
        self._inner.serve(at, handlers, execution)
        self._serve_timed(at, handlers, execution)

    def proxy(self, at: Endpoint) -> Channel:
        """See `Ports`."""
        link = self._inner.proxy(_timed_endpoint(at))
        return LockstepChannel(link, timed_interface(at.interface), self._now)

    def advertise(self, at: Endpoint) -> Channel:
        """See `Ports`."""
        link = self._inner.advertise(at)
        if at.interface.name == CLOCK.name:
            return link
        topic = LockstepTopicChannel(link, at, self._inner, self._now, self._limit)
        self._topics.append(topic)
        return topic

    def subscribe(
        self, at: Endpoint, handlers: Mapping[str, OperationCallable], execution: CallbackGroup
    ) -> None:
        """See `Ports`."""
        if at.interface.name == CLOCK.name:
            self._inner.subscribe(at, handlers, execution)
            return
        self._serve_timed(at, handlers, execution)
        peers = list(at.peers)
        self.subscribers.append(Hearer(at.component, at.port, at.interface.name, peers))

    def _serve_timed(
        self, at: Endpoint, handlers: Mapping[str, OperationCallable], execution: CallbackGroup
    ) -> None:
        timed = {name: self._timed(handler) for name, handler in handlers.items()}
        self._inner.serve(_timed_endpoint(at), timed, execution)

    def _timed(self, handler: OperationCallable) -> OperationCallable:
        set_time = self._set_time

        def timed(now: int, *arguments: Any) -> Any:
            set_time(now)
            return handler(*arguments)

        return timed

    def connect(self, everyone: Iterable[Hearer]) -> None:
        """Connect each topic to its subscribers; waits for each of them."""
        everyone = sorted(everyone, key=lambda subscriber: (subscriber.component, subscriber.port))
        for topic in self._topics:
            topic.connect(everyone)

    def find_servers(self, interface: Interface, timeout: float) -> list[str]:
        """See `Ports`."""
        return self._inner.find_servers(interface, timeout)

    def publish_state(self, state: str) -> None:
        """See `Ports`."""
        self._inner.publish_state(state)

    def interrupt(self) -> None:
        """See `Ports`."""
        self._inner.interrupt()

    def close(self) -> None:
        """See `Ports`."""
        self._inner.close()


class LockstepChannel:
    """Calls a server through its timed interface."""

    def __init__(self, link: Channel, interface: Interface, now: Callable[[], int]) -> None:
        self._channel = link
        self._interface = interface
        self._now = now

    @property
    def timeout(self) -> float:
        """See `ports.Channel`."""
        return self._channel.timeout

    @timeout.setter
    def timeout(self, seconds: float) -> None:
        self._channel.timeout = seconds

    def bind(self, operation: Operation) -> OperationCallable:
        """See `ports.Channel`."""
        call, now = self._channel.bind(self._interface.operation(operation.name)), self._now
        return lambda *arguments: call(now(), *arguments)

    def wait(self, timeout: float) -> bool:
        """See `ports.Channel`."""
        return self._channel.wait(timeout)

    def has_subscribers(self) -> bool:
        """See `ports.Channel`."""
        return self._channel.has_subscribers()


class LockstepTopicChannel:
    """Publishes to its subscribers one after the other, in the order of their names."""

    def __init__(
        self, link: Channel, at: Endpoint, inner: Ports, now: Callable[[], int], limit: float
    ) -> None:
        self._channel = link
        self._at = at
        self._inner = inner
        self._now = now
        self._limit = limit
        self._channels: dict[str, Channel] = {}
        self._calls: dict[str, dict[str, OperationCallable]] = {}
        self.timeout = 0.0

    def connect(self, everyone: Iterable[Hearer]) -> None:
        """Connect to those of `everyone` that subscribe to this topic."""
        calls: dict[str, dict[str, OperationCallable]] = {}
        for subscriber in everyone:
            if self._is_subscriber(subscriber):
                name = f"{subscriber.component}.{subscriber.port}"
                link = self._channels.get(name) or self._open_channel(name)
                self._channels[name] = link
                link.wait(self._limit * PUBLISH_TIME_FRACTION)
                operations = timed_interface(self._at.interface).operations
                calls[name] = {each.name: link.bind(each) for each in operations}
        self._calls = calls

    def _is_subscriber(self, subscriber: Hearer) -> bool:
        at = Endpoint(
            self._at.interface, subscriber.component, subscriber.port, tuple(subscriber.publishers)
        )
        named = subscriber.declared == self._at.interface.name
        return named and matches(at, self._at.component, self._at.port)

    def _open_channel(self, name: str) -> Channel:
        port = f"{self._at.port} to {name}"
        at = Endpoint(timed_interface(self._at.interface), self._at.component, port, (name,))
        channel = self._inner.proxy(at)
        channel.timeout = self._limit * PUBLISH_TIME_FRACTION
        return channel

    def bind(self, operation: Operation) -> OperationCallable:
        """See `ports.Channel`."""
        plain, name = self._channel.bind(operation), operation.name

        def publish(*arguments: Any) -> None:
            plain(*arguments)
            for hearer, calls in list(self._calls.items()):
                try:
                    calls[name](self._now(), *arguments)
                except RemoteError:
                    pass  # logged by the subscriber
                except MiddlewareError as error:
                    self._drop(hearer, error)

        return publish

    def _drop(self, hearer: str, error: MiddlewareError) -> None:
        if self._calls.pop(hearer, None) is not None:
            # The source logs lost members.
            level = logging.DEBUG if isinstance(error, NoServer) else logging.WARNING
            log.log(level, "%s no longer receives %s: %s", hearer, self._at.port, error)

    def wait(self, timeout: float) -> bool:
        """See `ports.Channel`."""
        return bool(self._calls) or self._channel.wait(timeout)

    def has_subscribers(self) -> bool:
        """See `ports.Channel`."""
        return bool(self._calls) or self._channel.has_subscribers()
