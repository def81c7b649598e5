"""The publishing side of a topic, over one or several transports.

In: a port, and its publisher on each middleware. Out: functions that publish. Subscribers are
attached when the port registry changes, by the thread that publishes.
"""

from __future__ import annotations

import threading
from collections.abc import Callable
from typing import Any

from robocomp_dsl.runtime.component.interface import Operation, Pattern
from robocomp_dsl.runtime.component.statistics import OperationCounts
from robocomp_dsl.runtime.connection.endpoint import Endpoint
from robocomp_dsl.runtime.connection.latched_messages import LatchedMessages
from robocomp_dsl.runtime.connection.ports import ComponentContext, OperationCallable
from robocomp_dsl.runtime.connection.published_port import PublishedPort
from robocomp_dsl.runtime.connection.subscriber_selection import SubscriberSelection
from robocomp_dsl.runtime.connection.topic_versions import TopicVersions
from robocomp_dsl.runtime.errors import NotPublishable
from robocomp_dsl.runtime.middleware.transport import Publisher
from robocomp_dsl.runtime.presence.port_record import PortRecord
from robocomp_dsl.runtime.presence.port_registry import PortRegistry
from robocomp_dsl.runtime.presence.presence import Presence
from robocomp_dsl.runtime.presence.sequence_format import SEQUENCE_FORMAT


class TopicChannel:
    """Publishes to all subscribers."""

    def __init__(
        self,
        context: ComponentContext,
        registry: PortRegistry,
        at: Endpoint,
        ports: list[PublishedPort],
        versions: TopicVersions,
        latched: LatchedMessages | None = None,
    ) -> None:
        self.timeout = 0.0
        self._context = context
        self._registry = registry
        self._at = at
        self._ports = ports
        self._versions = versions
        self._latched = latched
        self.records: list[PortRecord] = []
        self._rebind: list[Callable[[], None]] = []
        self._change_latched: list[Callable[[], None]] = []
        self._retired: list[Publisher] = []
        self._selection = SubscriberSelection(registry, at, ports)
        self._attached: dict[tuple[str, PortRecord], PublishedPort] = {}
        attaching = self._selection.attaching
        self._counting = ports.index(attaching[0]) if attaching else 0
        self._version = -1
        self._lock = threading.Lock()

    def bind(self, operation: Operation) -> OperationCallable:
        """See `ports.Channel`."""
        if operation.pattern is Pattern.QUERY:
            return self._not_publishable(operation)
        functions = [self._bind_port(i, operation) for i in range(len(self._ports))]
        publish = self._publication(operation, functions)

        def change() -> None:
            nonlocal publish
            publish = self._publication(operation, functions)

        self._change_latched.append(change)
        others = self._versions.bind(operation)

        def attach_and_publish(*arguments: Any) -> None:
            if self._version != self._registry.version:
                self._attach()
            publish(*arguments)
            if others:
                for publish_to_version in tuple(others):
                    publish_to_version(*arguments)

        return attach_and_publish

    def _not_publishable(self, operation: Operation) -> OperationCallable:
        """An operation of the interface that is not part of the topic, because it has a reply."""
        at = self._at

        def fail(*_arguments: Any) -> None:
            raise NotPublishable(
                f"{operation.name} of {at.interface.name} returns something, so the topic {at.name}"
                " does not have it; a component that requires the interface can call it"
            )

        return fail

    def _publication(
        self, operation: Operation, functions: list[OperationCallable]
    ) -> OperationCallable:
        """The publication on all middlewares, as the port is latched now."""
        publish = functions[0] if len(functions) == 1 else self._publish_on_all(functions)
        if self._latched:
            return self._latched.keep(operation, publish, self._ports[0].numbers)
        return publish

    def _bind_port(self, index: int, operation: Operation) -> OperationCallable:
        """The publication on one middleware; `replace_publishers` binds it again."""
        port = self._ports[index]
        counts = self._context.statistics.of(self._at.port, operation.name)
        # A publication on several middlewares counts once.
        is_counted = index == self._counting
        calls = counts if is_counted else OperationCounts(self._at.port, operation.name)
        encode: Any
        send: Any
        encode, send = port.publisher.bind(operation, counts)
        encode = encode or _unchanged
        numbers = port.numbers

        def rebind() -> None:
            nonlocal encode, send
            encode, send = self._ports[index].publisher.bind(operation, counts)
            encode = encode or _unchanged

        self._rebind.append(rebind)
        if numbers is None:

            def publish_plain(*arguments: Any) -> None:
                send(encode(arguments), b"")
                calls.calls += 1

            return publish_plain
        publisher_id, sequence = numbers.id, numbers.counter(operation.name)
        pack = SEQUENCE_FORMAT.pack

        def publish(*arguments: Any) -> None:
            data = encode(arguments)
            send(data, pack(publisher_id, next(sequence)))
            calls.calls += 1

        return publish

    def _publish_on_all(self, functions: list[OperationCallable]) -> OperationCallable:
        """A publication on each port, unless it is known that nobody subscribes there.

        Kept messages have the numbers of a port, which counts all of them.
        """
        if self._latched:
            return _in_turn(functions)
        pairs = [
            (None if port.capabilities.attaches_subscribers else port, function)
            for port, function in zip(self._ports, functions, strict=True)
        ]

        def publish(*arguments: Any) -> None:
            for port, function in pairs:
                if port is None or port.publisher.has_subscribers() is not False:
                    function(*arguments)

        return publish

    @property
    def ports(self) -> list[PublishedPort]:
        """The port on each of its middlewares."""
        return self._ports

    @property
    def is_latched(self) -> bool:
        """Whether the latest messages are kept."""
        return self._latched is not None

    def set_latched(self, latched: LatchedMessages | None) -> None:
        """Keep the messages that are published from now on, or none of them."""
        with self._lock:
            former, self._latched = self._latched, latched
            for change in self._change_latched:
                change()
        if former:
            former.close()

    @property
    def at(self) -> Endpoint:
        """The port as it is now."""
        return self._at

    def replace_publishers(self, at: Endpoint, publishers: list[Publisher]) -> None:
        """Publish with others from now on, one for each middleware; messages keep their numbers."""
        with self._lock:
            former = [port.publisher for port in self._ports]
            if self._latched and at.name != self._at.name:
                self._latched.rename(at)
            self._at = self._selection.at = at
            for port, publisher in zip(self._ports, publishers, strict=True):
                port.publisher = publisher
            for (_, record), port in self._attached.items():
                port.publisher.attach(record)
            for rebind in self._rebind:
                rebind()
        # A thread may still be publishing with a former publisher: it is closed with the channel.
        self._retired += former
        for publisher in former:
            for _, record in list(self._attached):
                publisher.detach(record)

    def _attach(self) -> None:
        """Attach the subscribers that have appeared, and detach those that are gone."""
        with self._lock:
            version = self._registry.version
            current = self._selection.to_attach()
            for key, port in list(self._attached.items()):
                if key not in current:
                    del self._attached[key]
                    port.publisher.detach(key[1])
            for key, port in current.items():
                if key not in self._attached:
                    self._attached[key] = port
                    port.publisher.attach(key[1])
            self._versions.update(self._at, self._selection.of_all_versions())
            self._version = version

    def wait(self, timeout: float) -> bool:
        """See `ports.Channel`."""
        if self._at.external:
            return True
        paused = self._context.callback_group.pause()
        try:
            name = self._at.interface.name
            return bool(self._registry.wait("subscriber", name, self._selection.is_other, timeout))
        finally:
            if paused:
                self._context.callback_group.resume(paused)

    def has_subscribers(self) -> bool:
        """See `ports.Channel`; subscribers that are no components count, too."""
        if self._version != self._registry.version:
            self._attach()
        if self._attached or self._versions.has_subscribers():
            return True
        for port in self._ports:
            known = port.publisher.has_subscribers()
            if known or (known is None and self._selection.is_any_known()):
                return True
        return False

    def withdraw(self, presence: Presence) -> None:
        """Make the port unknown, before it is closed."""
        for record in self.records:
            presence.withdraw(record)

    def close(self) -> None:
        """End the port on all middlewares."""
        ports, self._ports = self._ports, []
        self._selection.clear()
        self._attached.clear()
        self._versions.close()
        for port in ports:
            port.publisher.close()
            if port.numbers:
                port.numbers.close()
        for publisher in self._retired:
            publisher.close()
        if self._latched:
            self._latched.close()


def _unchanged(arguments: tuple[Any, ...]) -> tuple[Any, ...]:
    return arguments


def _in_turn(functions: list[OperationCallable]) -> OperationCallable:
    def publish(*arguments: Any) -> None:
        for function in functions:
            function(*arguments)

    return publish
