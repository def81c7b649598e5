"""The ROS node of a component: what it publishes, receives and serves, and how peers reach it."""

from __future__ import annotations

import threading
from collections.abc import Callable, Sequence
from typing import Any

from robocomp_dsl.runtime.errors import MiddlewareError
from robocomp_dsl.runtime.middleware.ros1.addresses import own_name
from robocomp_dsl.runtime.middleware.ros1.handshake import refuse
from robocomp_dsl.runtime.middleware.ros1.incoming import TopicReceiver
from robocomp_dsl.runtime.middleware.ros1.incoming_links import IncomingLink
from robocomp_dsl.runtime.middleware.ros1.listener import TcprosListener
from robocomp_dsl.runtime.middleware.ros1.node_api import NodeApi
from robocomp_dsl.runtime.middleware.ros1.port_receiver import PORT_KEY, PortReceiver
from robocomp_dsl.runtime.middleware.ros1.publication import Publication
from robocomp_dsl.runtime.middleware.ros1.registration import MasterRegistration
from robocomp_dsl.runtime.middleware.ros1.service import ServiceServer
from robocomp_dsl.runtime.middleware.ros1.settings import Ros1Settings
from robocomp_dsl.runtime.middleware.ros1.subscription import TopicSubscription
from robocomp_dsl.runtime.middleware.ros1.tcpros import TcprosStream


class RosNode:
    """One node. Raises `MiddlewareError` if it cannot listen."""

    def __init__(self, component: str, settings: Ros1Settings, fail: Callable[[str], None]) -> None:
        self.name = own_name(component)
        self.master = settings.master
        self.host = settings.host
        self._fail = fail
        self._lock = threading.Lock()
        self._publications: dict[str, Publication] = {}
        self._subscriptions: dict[str, list[TopicSubscription]] = {}
        self._ports: dict[str, list[PortReceiver]] = {}
        self._services: dict[str, ServiceServer] = {}
        self.on_parameter: Callable[[str, Any], None] = lambda _key, _value: None
        handlers = {
            PORT_KEY: self._accept_component,
            "service": self._accept_client,
            "topic": self._accept_subscriber,
        }
        self.listener = TcprosListener(self.name, settings.host, handlers)
        try:
            self._api = NodeApi(settings.host, self)
        except MiddlewareError:
            self.listener.close()
            raise
        self.api_uri = self._api.uri
        service_uri = f"rosrpc://{settings.host}:{self.listener.number}"
        self.registration = MasterRegistration(
            self.name, self._api.uri, service_uri, settings.master
        )

    def add_publication(self, publication: Publication) -> None:
        """Publish a topic. Raises `MiddlewareError` if the node publishes it already."""
        topic = publication.topic
        with self._lock:
            if topic.name in self._publications:
                raise MiddlewareError(
                    f"{self.name} publishes {topic.name} with two ports; give one of them another"
                    " topic with --address"
                )
            self._publications[topic.name] = publication
        self.registration.add("Publisher", topic.name, topic.type.name)

    def remove_publication(self, publication: Publication) -> None:
        """Publish a topic no longer."""
        with self._lock:
            self._publications.pop(publication.topic.name, None)
        self.registration.remove("Publisher", publication.topic.name)
        publication.close()

    def add_subscription(self, receiver: TopicReceiver) -> TopicSubscription:
        """Receive a topic of ROS."""
        topic = receiver.topic
        subscription = TopicSubscription(receiver, self.name)
        with self._lock:
            self._subscriptions.setdefault(topic.name, []).append(subscription)
        self.registration.add(
            "Subscriber",
            topic.name,
            topic.type.name,
            lambda publishers: self.update_publishers(topic.name, publishers),
        )
        return subscription

    def remove_subscription(self, subscription: TopicSubscription) -> None:
        """Receive a topic no longer."""
        name = subscription.receiver.topic.name
        with self._lock:
            remaining = [s for s in self._subscriptions.get(name, []) if s is not subscription]
            self._subscriptions[name] = remaining
            if not remaining:
                del self._subscriptions[name]
        if not remaining:
            self.registration.remove("Subscriber", name)
        subscription.close()

    def add_service(self, server: ServiceServer) -> None:
        """Serve a service."""
        with self._lock:
            self._services[server.service.name] = server
        self.registration.add("Service", server.service.name, server.service.type.name)

    def remove_service(self, server: ServiceServer) -> None:
        """Serve a service no longer."""
        with self._lock:
            if self._services.get(server.service.name) is server:
                del self._services[server.service.name]
        self.registration.remove("Service", server.service.name)
        server.close()

    def add_port(self, receiver: PortReceiver) -> None:
        """Let components connect to a port."""
        with self._lock:
            several = self._ports.get(receiver.name, [])
            self._ports[receiver.name] = [*several, receiver]

    def remove_port(self, receiver: PortReceiver) -> None:
        """Undo `add_port`."""
        with self._lock:
            several = self._ports.pop(receiver.name, [])
            if remaining := [each for each in several if each is not receiver]:
                self._ports[receiver.name] = remaining
        receiver.close()

    def _accept_subscriber(self, stream: TcprosStream, header: dict[str, str]) -> bool:
        publication = self._publications.get(header["topic"])
        if publication is None:
            refuse(stream, f"{self.name} does not publish {header['topic']}")
            return False
        if reason := publication.refusal(header):
            refuse(stream, reason)
            self.listener.report(reason, f"refused a subscriber: {reason}")
            return False
        publication.accept(stream, header.get("callerid", "a node"))
        return True

    def _accept_component(self, stream: TcprosStream, header: dict[str, str]) -> bool:
        several = self._ports.get(header[PORT_KEY], [])
        if not several:
            refuse(stream, f"{self.name} has no port {header[PORT_KEY]}")
            return False
        refusals = [receiver.refusal(header) for receiver in several]
        for receiver, reason in zip(several, refusals, strict=True):
            if not reason:
                receiver.accept(stream, header)
                return False
        refuse(stream, refusals[0])
        self.listener.report(refusals[0], f"refused a component: {refusals[0]}")
        return False

    def _accept_client(self, stream: TcprosStream, header: dict[str, str]) -> bool:
        server = self._services.get(header["service"])
        if server is None:
            refuse(stream, f"{self.name} does not serve {header['service']}")
        elif reason := server.accept(stream, header):
            self.listener.report(reason, f"refused a client: {reason}")
        return False

    def publications(self) -> list[tuple[str, str]]:
        """See `NodeState`."""
        return [(p.topic.name, p.topic.type.name) for p in list(self._publications.values())]

    def subscriptions(self) -> list[tuple[str, str]]:
        """See `NodeState`."""
        topics = [several[0].receiver.topic for several in list(self._subscriptions.values())]
        return [(topic.name, topic.type.name) for topic in topics]

    def bus_info(self) -> list[list[Any]]:
        """See `NodeState`."""
        rows: list[list[Any]] = [
            [link.number, link.peer, "o", "TCPROS", name, link.is_connected]
            for name, publication in list(self._publications.items())
            for link in publication.links
        ]
        rows += [
            [connection.number, connection.peer, "i", "TCPROS", name, True]
            for name, connection in self._connections()
        ]
        return rows

    def _connections(self) -> list[tuple[str, IncomingLink]]:
        """All incoming connections, by topic or port."""
        ends: list[tuple[str, TopicReceiver | PortReceiver]] = [
            (name, each.receiver)
            for name, several in list(self._subscriptions.items())
            for each in several
        ]
        ends += [(name, port) for name, several in list(self._ports.items()) for port in several]
        return [(name, connection) for name, end in ends for connection in end.connections.links]

    def bus_stats(self) -> list[list[Any]]:
        """See `NodeState`."""
        published: list[Any] = []
        for name, publication in list(self._publications.items()):
            links = publication.links
            rows = [[n.number, n.body_bytes, n.messages_out, n.is_connected] for n in links]
            published.append([name, sum(link.body_bytes for link in links), rows])
        received = [
            [name, [[c.number, c.stream.bytes_in, c.messages_in, 0, True]]]
            for name, c in self._connections()
        ]
        served = [sum(each.requests for each in list(self._services.values())), 0, 0]
        return [published, received, served]

    def update_publishers(self, topic: str, publishers: Sequence[str]) -> None:
        """See `NodeState`."""
        with self._lock:
            subscriptions = list(self._subscriptions.get(topic, ()))
        for subscription in subscriptions:
            subscription.update(publishers)

    def update_parameter(self, key: str, value: Any) -> None:
        """See `NodeState`."""
        self.on_parameter(key, value)

    def tcpros_address(self, topic: str) -> tuple[str, int] | None:
        """See `NodeState`."""
        known = topic in self._publications
        return (self.host, self.listener.number) if known else None

    def request_shutdown(self, caller: str, reason: str) -> None:
        """See `NodeState`."""
        self.registration.stop()
        self._fail(f"{caller} asked the ROS node {self.name} to end: {reason or 'no reason'}")

    def close(self) -> None:
        """End all connections."""
        self.registration.close()
        with self._lock:
            publications = list(self._publications.values())
            subscriptions = [s for several in self._subscriptions.values() for s in several]
            services = list(self._services.values())
            ports = [port for several in self._ports.values() for port in several]
        for port in ports:
            port.close()
        for service in services:
            service.close()
        for subscription in subscriptions:
            subscription.close()
        for publication in publications:
            publication.close()
        self._api.close()
        self.listener.close()
