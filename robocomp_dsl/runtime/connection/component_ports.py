"""All ports of one component, on any middlewares.

In: the component, its presence, and middlewares by name. Out: `Ports`. Transports are opened on
first use.
"""

from __future__ import annotations

import threading
from collections.abc import Iterable, Mapping
from dataclasses import replace

from robocomp_dsl.runtime.component.callback_group import CallbackGroup
from robocomp_dsl.runtime.component.interface import Interface
from robocomp_dsl.runtime.component.statistics import OperationCounts
from robocomp_dsl.runtime.connection.connection_events import ConnectionEvents
from robocomp_dsl.runtime.connection.connection_watch import ConnectionWatch
from robocomp_dsl.runtime.connection.endpoint import Endpoint
from robocomp_dsl.runtime.connection.incoming_port import IncomingPort
from robocomp_dsl.runtime.connection.latched_messages import LatchedMessages
from robocomp_dsl.runtime.connection.losses import LossCounter, LossCounters
from robocomp_dsl.runtime.connection.ports import ComponentContext, OperationCallable
from robocomp_dsl.runtime.connection.published_port import PublishedPort
from robocomp_dsl.runtime.connection.qos_merge import connection_qos, sender_qos
from robocomp_dsl.runtime.connection.qos_support import check_qos
from robocomp_dsl.runtime.connection.server_selector import ServerSelector
from robocomp_dsl.runtime.connection.service_channel import ServiceChannel
from robocomp_dsl.runtime.connection.serving_port import ServingPort
from robocomp_dsl.runtime.connection.subscribed_port import SubscribedPort
from robocomp_dsl.runtime.connection.topic_channel import TopicChannel
from robocomp_dsl.runtime.connection.topic_versions import TopicVersions
from robocomp_dsl.runtime.connection.usable_records import is_usable
from robocomp_dsl.runtime.middleware import registry
from robocomp_dsl.runtime.middleware.transport import (
    Publisher,
    ServiceClient,
    Transport,
    TransportContext,
)
from robocomp_dsl.runtime.presence.port_record import PortRecord
from robocomp_dsl.runtime.presence.presence import Presence


def open_ports(
    middleware: str,
    context: ComponentContext,
    used: Iterable[str] = (),
    *,
    is_visible: bool = False,
) -> ComponentPorts:
    """The ports of one component that is on `middleware`, or whose ports are on those in `used`.

    `is_visible`: other processes see it, even if no middleware connects it with them. Raises
    `UnknownMiddleware`, or `MiddlewareError` when one cannot be opened.
    """
    names = tuple(used) or (middleware,)
    if is_visible or any(registry.capabilities_of(name).between_processes for name in names):
        from robocomp_dsl.runtime.presence.zenoh_presence import open_presence  # noqa: PLC0415

        presence: Presence = open_presence(
            context.domain, context.component, context.listen_port, unique=context.unique_name
        )
    else:
        from robocomp_dsl.runtime.presence.process_presence import (  # noqa: PLC0415
            ProcessPresence,
        )

        presence = ProcessPresence(context.domain)
    ports = ComponentPorts(context, presence)
    try:
        for name in names:
            ports.transport(name)
    except BaseException:
        ports.close()
        raise
    return ports


class ComponentPorts:
    """All ports of one component; a port that names no middleware is on the house transport."""

    def __init__(self, context: ComponentContext, presence: Presence) -> None:
        self._context = context
        self.presence = presence
        self._transports: dict[str, Transport] = {}
        self._lock = threading.Lock()
        self._incoming: list[IncomingPort] = []
        self.servers: list[ServingPort] = []
        self.subscribed: list[SubscribedPort] = []
        self.channels: list[ServiceChannel] = []
        self.topics: list[TopicChannel] = []
        self._losses: LossCounters | None = None
        self.events = ConnectionEvents(
            context.component, context.callback_group, context.call_hook, context.fail
        )
        self.watch = ConnectionWatch(presence, self.events, context.component)

    def transport(self, name: str) -> Transport:
        """The transport of a middleware, opened on first use. Raises as `open_ports`."""
        with self._lock:
            if name not in self._transports:
                self._transports[name] = registry.open_transport(
                    name, self._transport_context(name)
                )
            return self._transports[name]

    def _transport_context(self, name: str) -> TransportContext:
        context = self._context
        return TransportContext(
            context.component,
            context.domain,
            registry.transport_folder(context.domain, name),
            context.fail,
            {port: at for (of, port), at in context.addresses.items() if of == name},
            {key: value for (of, key), value in context.transport_settings.items() if of == name},
            self.presence,
            context.parameters,
        )

    def serve(
        self, at: Endpoint, handlers: Mapping[str, OperationCallable], execution: CallbackGroup
    ) -> None:
        """See `Ports`."""
        check_qos(at, "server", self.middlewares(at))
        served = ServingPort(self, at, handlers, execution)
        served.open()
        self.servers.append(served)

    def subscribe(
        self,
        at: Endpoint,
        handlers: Mapping[str, OperationCallable],
        execution: CallbackGroup,
        *,
        is_start: bool = True,
    ) -> None:
        """See `Ports`; for `is_start` see `LossCounters.add`."""
        check_qos(at, "subscriber", self.middlewares(at))
        subscribed = SubscribedPort(self, at, handlers, execution)
        self.subscribed.append(subscribed)
        subscribed.update(at, is_start=is_start)
        self.presence.registry.warn_on_mismatch(
            "publisher", at.interface.name, at.interface.hash.hex(), at.component
        )

    def incoming_port(
        self,
        at: Endpoint,
        handlers: Mapping[str, OperationCallable],
        execution: CallbackGroup,
        *,
        count_losses: bool = False,
        is_start: bool = True,
    ) -> IncomingPort:
        """A port for a transport; `is_start`: see `LossCounters.add`."""
        context = self._context
        losses = self._loss_counters() if count_losses else None

        def counter(counts: OperationCounts) -> LossCounter:
            assert losses is not None  # noqa: S101 - only called if there are counters
            return losses.add(at, counts, execution, is_start=is_start)

        port = IncomingPort(
            at, handlers, execution, context.statistics, context.fail, counter if losses else None
        )
        self._incoming.append(port)
        return port

    def forget(self, port: IncomingPort) -> None:
        """A port has been closed while the component runs."""
        self._incoming.remove(port)
        for operation in port.operations.values():
            if operation.losses and self._losses:
                self._losses.remove(operation.losses)

    def _loss_counters(self) -> LossCounters | None:
        publishers = self.presence.publishers()
        if self._losses is None and publishers is not None:
            self._losses = LossCounters(publishers)
            self._context.statistics.on_refresh(self._losses.settle)
        return self._losses

    def proxy(self, at: Endpoint) -> ServiceChannel:
        """See `Ports`."""
        check_qos(at, "client", at.middlewares)
        registry_ = self.presence.registry
        selector = ServerSelector(at, registry_, self._context.callback_group, is_usable)
        channel = ServiceChannel(
            self._context, registry_, selector, self._connect, self.presence.shapes_of
        )
        self.channels.append(channel)
        return channel

    def _connect(self, at: Endpoint, server: PortRecord, timeout: float) -> ServiceClient:
        at = replace(at, qos=connection_qos(at, server.name), peer_qos=())
        return self.transport(server.middleware).connect(at, server, timeout)

    def advertise(self, at: Endpoint) -> TopicChannel:
        """See `Ports`."""
        names = self.middlewares(at)
        check_qos(at, "publisher", names)
        ports = [self._published_port(middleware, at) for middleware in names]
        latched = LatchedMessages(at, self.presence) if sender_qos(at).latched else None
        self.presence.answer_probes()
        versions = TopicVersions(at, self.presence.shapes_of, self._published_port)
        channel = TopicChannel(self._context, self.presence.registry, at, ports, versions, latched)
        for port in ports:
            record = self.declare("publisher", at, port.middleware, port.publisher.address)
            channel.records.append(record)
        self.presence.registry.warn_on_mismatch(
            "subscriber", at.interface.name, at.interface.hash.hex(), at.component
        )
        self.topics.append(channel)
        return channel

    def _published_port(self, middleware: str, at: Endpoint) -> PublishedPort:
        """A published port on one middleware; `at` may have the interface of another version."""
        capabilities = registry.capabilities_of(middleware)
        numbers = self.presence.number_publications(at) if capabilities.sequence_numbers else None
        return PublishedPort(middleware, capabilities, self.publisher(middleware, at), numbers)

    def publisher(self, middleware: str, at: Endpoint) -> Publisher:
        """The publisher of a port on a middleware: of all its connections together."""
        return self.transport(middleware).advertise(replace(at, qos=sender_qos(at), peer_qos=()))

    def middlewares(self, at: Endpoint) -> tuple[str, ...]:
        """The middlewares of a served or published port."""
        return at.middlewares or (self.presence.house,)

    def declare(self, role: str, at: Endpoint, middleware: str, address: str) -> PortRecord:
        """Make a port known; after it was opened, so that it can be used when it is seen."""
        record = PortRecord(
            role,
            at.interface.name,
            at.component,
            at.port,
            at.interface.hash.hex(),
            middleware,
            address,
            at.peers if role == "subscriber" else (),
        )
        if role == "subscriber" and at.external and not at.peers:
            return record  # connected to external programs only: no component publishes to it
        self.presence.offer_shapes(at.interface)
        self.presence.declare(record)
        return record

    def find_servers(self, interface: Interface, timeout: float) -> list[str]:
        """See `Ports`."""
        return self.presence.find_servers(interface.name, timeout)

    def publish_state(self, state: str) -> None:
        """See `Ports`."""
        self.presence.publish_state(state)

    def interrupt(self) -> None:
        """See `Ports`."""
        self.presence.interrupt()

    def close(self) -> None:
        """See `Ports`."""
        self.interrupt()
        self.watch.close()
        self.events.close()
        opened: list[ServingPort | SubscribedPort] = [*self.servers, *self.subscribed]
        topics, channels = self.topics, self.channels
        self.servers, self.subscribed, self.topics, self.channels = [], [], [], []
        for port in (*opened, *topics):
            port.withdraw(self.presence)
        for each in opened:
            each.close()
        incoming_ports, self._incoming = self._incoming, []
        for incoming in incoming_ports:
            incoming.join(0.5)
        if self._losses:
            self._context.statistics.off_refresh(self._losses.settle)
            self._losses.close()
        for channel in channels:
            channel.close()
        for topic in topics:
            topic.close()
        with self._lock:
            transports, self._transports = self._transports, {}
        for transport in transports.values():
            transport.close()
        self.presence.close()
