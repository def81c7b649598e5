"""All ports of one component, on any middlewares.

In: the component, its presence, and middlewares by name. Out: `Ports`. Transports are opened on
first use.
"""

from __future__ import annotations

import os
import threading
from collections.abc import Iterable, Mapping

from robocomp_dsl.runtime.component.callback_group import CallbackGroup
from robocomp_dsl.runtime.component.interface import Interface
from robocomp_dsl.runtime.component.statistics import OperationCounts
from robocomp_dsl.runtime.connection.endpoint import Endpoint
from robocomp_dsl.runtime.connection.incoming_port import IncomingPort
from robocomp_dsl.runtime.connection.losses import LossCounter, LossCounters
from robocomp_dsl.runtime.connection.peer_selection import with_deadline_check
from robocomp_dsl.runtime.connection.ports import ComponentContext, OperationCallable
from robocomp_dsl.runtime.connection.server_selector import ServerSelector
from robocomp_dsl.runtime.connection.service_channel import ServiceChannel
from robocomp_dsl.runtime.connection.topic_channel import PublishedPort, TopicChannel
from robocomp_dsl.runtime.middleware import registry
from robocomp_dsl.runtime.middleware.capabilities import Capabilities
from robocomp_dsl.runtime.middleware.transport import (
    PortServer,
    ServiceClient,
    Subscription,
    Transport,
    TransportContext,
)
from robocomp_dsl.runtime.presence.port_record import PortRecord
from robocomp_dsl.runtime.presence.presence import Presence


def open_ports(
    middleware: str, context: ComponentContext, used: Iterable[str] = ()
) -> ComponentPorts:
    """The ports of one component that is on `middleware`, or whose ports are on those in `used`.

    Raises `UnknownMiddleware`, or `MiddlewareError` when one cannot be opened.
    """
    names = tuple(used) or (middleware,)
    if any(registry.capabilities_of(name).between_processes for name in names):
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
        self._opened: list[tuple[PortRecord, PortServer | Subscription | None]] = []
        self._served: list[IncomingPort] = []
        self._channels: list[ServiceChannel | TopicChannel] = []
        self._losses: LossCounters | None = None

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
        for middleware in self._middlewares(at):
            port = self._served_port(at, handlers, execution)
            server = self.transport(middleware).serve(port)
            self._declare("server", at, middleware, server.address, server)

    def subscribe(
        self, at: Endpoint, handlers: Mapping[str, OperationCallable], execution: CallbackGroup
    ) -> None:
        """See `Ports`."""
        if at.qos.deadline:
            handlers = {
                name: with_deadline_check(
                    handler, at.qos.deadline, self._context.statistics.of(at.port, name)
                )
                for name, handler in handlers.items()
            }
        for middleware in self._subscribed_middlewares(at):
            numbered = registry.capabilities_of(middleware).sequence_numbers
            port = self._served_port(at, handlers, execution, count_losses=numbered)
            subscription = self.transport(middleware).subscribe(port)
            self._declare("subscriber", at, middleware, subscription.address, subscription)
        self.presence.registry.warn_on_mismatch(
            "publisher", at.interface.name, at.interface.hash.hex(), at.component
        )

    def _served_port(
        self,
        at: Endpoint,
        handlers: Mapping[str, OperationCallable],
        execution: CallbackGroup,
        *,
        count_losses: bool = False,
    ) -> IncomingPort:
        context = self._context
        losses = self._loss_counters() if count_losses else None

        def counter(counts: OperationCounts) -> LossCounter:
            assert losses is not None  # noqa: S101 - only called if there are counters
            return losses.add(at, counts, execution)

        port = IncomingPort(
            at, handlers, execution, context.statistics, context.fail, counter if losses else None
        )
        self._served.append(port)
        return port

    def _loss_counters(self) -> LossCounters | None:
        publishers = self.presence.publishers()
        if self._losses is None and publishers is not None:
            self._losses = LossCounters(publishers)
            self._context.statistics.on_refresh(self._losses.settle)
        return self._losses

    def proxy(self, at: Endpoint) -> ServiceChannel:
        """See `Ports`."""
        registry_ = self.presence.registry

        def is_usable(record: PortRecord) -> bool:
            return self._is_usable(at, record)

        selector = ServerSelector(at, registry_, self._context.callback_group, is_usable)
        channel = ServiceChannel(self._context, registry_, selector, self._connect)
        self._channels.append(channel)
        return channel

    def _connect(self, at: Endpoint, server: PortRecord, timeout: float) -> ServiceClient:
        return self.transport(server.middleware).connect(at, server, timeout)

    def _is_usable(self, at: Endpoint, record: PortRecord) -> bool:
        """Whether this port can be connected to a server or publisher."""
        if at.middlewares and record.middleware not in at.middlewares:
            return False
        capabilities = registry.known_capabilities(record.middleware)
        return capabilities is not None and _is_reachable(record, capabilities)

    def advertise(self, at: Endpoint) -> TopicChannel:
        """See `Ports`."""
        ports = []
        for middleware in self._middlewares(at):
            capabilities = registry.capabilities_of(middleware)
            numbers = (
                self.presence.number_publications(at) if capabilities.sequence_numbers else None
            )
            publisher = self.transport(middleware).advertise(at)
            ports.append(PublishedPort(middleware, capabilities, publisher, numbers))
            self._declare("publisher", at, middleware, publisher.address, None)
        self.presence.registry.warn_on_mismatch(
            "subscriber", at.interface.name, at.interface.hash.hex(), at.component
        )
        channel = TopicChannel(self._context, self.presence.registry, at, ports)
        self._channels.append(channel)
        return channel

    def _middlewares(self, at: Endpoint) -> tuple[str, ...]:
        return at.middlewares or (self.presence.house,)

    def _subscribed_middlewares(self, at: Endpoint) -> Iterable[str]:
        """Of a port that names none: those of the publishers that are known, or the house's."""
        if at.middlewares:
            return at.middlewares
        found = self.presence.registry.find("publisher", at.interface.name)
        used = [r.middleware for r in found if r.name in at.peers or r.component in at.peers]
        usable = [name for name in used if registry.known_capabilities(name)]
        return dict.fromkeys(usable or (self.presence.house,))

    def _declare(
        self,
        role: str,
        at: Endpoint,
        middleware: str,
        address: str,
        port: PortServer | Subscription | None,
    ) -> None:
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
        self._opened.append((record, port))
        if role == "subscriber" and at.external and not at.peers:
            return  # connected to external programs only: no component publishes to it
        self.presence.declare(record)

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
        opened, self._opened = self._opened, []
        for record, _ in opened:
            self.presence.withdraw(record)
        for _, port in opened:
            if port:
                port.close()
        served, self._served = self._served, []
        for incoming in served:
            incoming.join(0.5)
        if self._losses:
            self._context.statistics.off_refresh(self._losses.settle)
            self._losses.close()
        channels, self._channels = self._channels, []
        for channel in channels:
            channel.close()
        with self._lock:
            transports, self._transports = self._transports, {}
        for transport in transports.values():
            transport.close()
        self.presence.close()


def _is_reachable(record: PortRecord, capabilities: Capabilities) -> bool:
    """Whether the port is in this process, or its middleware connects processes.

    The address of a port that only its process can reach starts with the process id.
    """
    return capabilities.between_processes or record.address.startswith(f"{os.getpid()}-")
