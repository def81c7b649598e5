"""Ice transport: servants, proxies and publishers of one component.

In: a `TransportContext`. Out: a `Transport`. Settings: `TopicManager` is the proxy of IceStorm's
TopicManager, `Host` the address where ports listen (127.0.0.1), and `Ice.*` are properties of Ice.
"""

from __future__ import annotations

import contextlib
import secrets
import threading
import uuid
from collections.abc import Callable
from typing import Any

import Ice

from robocomp_dsl.runtime.component.interface import Pattern
from robocomp_dsl.runtime.connection.endpoint import Endpoint
from robocomp_dsl.runtime.connection.incoming_port import IncomingPort
from robocomp_dsl.runtime.connection.message_queue import MessageQueue
from robocomp_dsl.runtime.errors import MiddlewareError
from robocomp_dsl.runtime.middleware.ice import communicator, icestorm
from robocomp_dsl.runtime.middleware.ice.acknowledged_queue import AcknowledgedQueue
from robocomp_dsl.runtime.middleware.ice.addresses import ICESTORM, join_proxies, parse_fixed
from robocomp_dsl.runtime.middleware.ice.client import IceServiceClient
from robocomp_dsl.runtime.middleware.ice.server import service_servant, topic_servant
from robocomp_dsl.runtime.middleware.ice.topics import (
    IcePublisher,
    IceSubscription,
    StormSubscription,
)
from robocomp_dsl.runtime.middleware.transport import TransportContext
from robocomp_dsl.runtime.presence.port_record import PortRecord

_SETTINGS = ("TopicManager", "Host")


def open_transport(context: TransportContext) -> IceTransport:
    """The transport of one component. Raises `MiddlewareError` for a setting that is unknown."""
    return IceTransport(context)


class IcePort:
    """A served port: its servants in one or two adapters, and the queue of its commands."""

    def __init__(self, address: str, close: Callable[[], None]) -> None:
        self.address = address
        self.close = close


class IceTransport:
    """All Ice connections of one component."""

    def __init__(self, context: TransportContext) -> None:
        self._context = context
        settings = context.settings
        for key in settings:
            if key not in _SETTINGS and not key.startswith("Ice."):
                known = ", ".join(_SETTINGS)
                raise MiddlewareError(f"unknown setting `ice.{key}`; known: {known} and Ice.*")
        properties = {key: value for key, value in settings.items() if key.startswith("Ice.")}
        self._host = settings.get("Host", "127.0.0.1")
        self._topic_manager = settings.get("TopicManager", icestorm.MANAGER)
        self._outgoing = communicator.open_outgoing(properties)
        self._incoming = communicator.open_incoming(properties)
        self._lock = threading.Lock()
        self._adapters: dict[str, Any] = {}

    def serve(self, port: IncomingPort) -> IcePort:
        """See `Transport`."""
        patterns = {operation.pattern for operation in port.interface.operations}
        queue = MessageQueue(port) if Pattern.COMMAND in patterns else None
        servant = service_servant(port, queue)
        adapter, identity = self._adapter_of(port, ordered=False)
        adapters = [adapter]
        if queue and port.at.port not in self._context.addresses:
            adapters.append(self._own_adapter(ordered=True))
        proxies = [str(each.add(servant, identity)) for each in adapters]

        def close() -> None:
            for each in adapters:
                _remove(each, identity)
            if queue:
                queue.close()

        return IcePort(join_proxies(proxies[0], proxies[-1]), close)

    def subscribe(self, port: IncomingPort) -> IceSubscription:
        """See `Transport`."""
        at = port.at
        names = [record.address for record in at.external if record.middleware == "ice"]
        if wrong := [name for name in names if not name.startswith(ICESTORM)]:
            raise MiddlewareError(
                f"{at.name} subscribes to `{wrong[0]}`, but Ice has no address of a publisher:"
                " name a topic of IceStorm, such as icestorm:LaserPub, or let the publisher send"
                f" to an address of this port: --address '{at.port}=ice:tcp -p 10010'"
            )
        queue = AcknowledgedQueue(port) if at.qos.holds_publisher else MessageQueue(port)
        servant = topic_servant(port, queue)
        adapter, identity = self._adapter_of(port, ordered=True)
        proxy = adapter.add(servant, identity)
        topics = []
        for name in names:
            topic = name.removeprefix(ICESTORM)
            # Subscribers of IceStorm need identities that no other program has.
            unique = adapter.addWithUUID(servant)
            topics.append(StormSubscription(self._outgoing, at, self._topic_manager, topic, unique))
        return IceSubscription(str(proxy), lambda: _remove(adapter, identity), queue.close, topics)

    def connect(self, at: Endpoint, server: PortRecord, timeout: float) -> IceServiceClient:
        """See `Transport`."""
        connection = uuid.uuid4().hex
        return IceServiceClient(self._outgoing, connection, at, server, timeout)

    def advertise(self, at: Endpoint) -> IcePublisher:
        """See `Transport`."""
        return IcePublisher(self._outgoing, at, self._topic_manager)

    def _adapter_of(self, port: IncomingPort, *, ordered: bool) -> tuple[Any, Any]:
        """The adapter of a port, and the identity of its object.

        A port at an address of the user has an adapter of its own. If it receives commands, the
        messages of each client are handled in order there.
        """
        at = port.at
        text = self._context.addresses.get(at.port)
        if text is None:
            # Ice has no passwords: who does not know the record cannot name the object.
            name = f"{at.port}.{secrets.token_hex(16)}"
            return self._own_adapter(ordered=ordered), Ice.Identity(name, at.component)
        try:
            identity, endpoints = parse_fixed(text, at.port)
        except ValueError as error:
            raise MiddlewareError(f"{at.name}: {error}") from None
        with self._lock:
            if endpoints not in self._adapters:
                name = f"fixed{len(self._adapters)}"
                in_order = any(o.pattern is Pattern.COMMAND for o in port.interface.operations)
                in_order |= self._is_shared(endpoints)
                self._incoming.getProperties().setProperty(
                    f"{name}.ThreadPool.Serialize", "1" if in_order else "0"
                )
                try:
                    self._adapters[endpoints] = communicator.create_adapter(
                        self._incoming, name, endpoints, ordered=ordered
                    )
                except MiddlewareError as error:
                    raise MiddlewareError(f"{at.name}: {error}") from None
            return self._adapters[endpoints], Ice.Identity(identity, "")

    def _is_shared(self, endpoints: str) -> bool:
        """Whether several ports are at these endpoints."""
        texts = self._context.addresses.values()
        return sum(text.strip().endswith(endpoints) for text in texts) > 1

    def _own_adapter(self, *, ordered: bool) -> Any:
        """The adapter of all ports without an address, created on first use."""
        name = "ordered" if ordered else "queries"
        with self._lock:
            if name not in self._adapters:
                self._adapters[name] = communicator.create_adapter(
                    self._incoming, name, f"tcp -h {self._host}", ordered=ordered
                )
            return self._adapters[name]

    def close(self) -> None:
        """See `Transport`."""
        communicator.close(self._outgoing)
        communicator.close(self._incoming)


def _remove(adapter: Any, identity: Any) -> None:
    with contextlib.suppress(Ice.Exception):
        adapter.remove(identity)
