"""Opens `ros1` for a component: one ROS node, its ports."""

from __future__ import annotations

import os
import threading

from robocomp_dsl.runtime.connection.endpoint import Endpoint
from robocomp_dsl.runtime.connection.incoming_port import IncomingPort
from robocomp_dsl.runtime.connection.message_queue import MessageQueue
from robocomp_dsl.runtime.middleware.ros1.addresses import RosAddress, parse_address
from robocomp_dsl.runtime.middleware.ros1.client import Ros1Client
from robocomp_dsl.runtime.middleware.ros1.description import MIDDLEWARE
from robocomp_dsl.runtime.middleware.ros1.incoming import TopicReceiver
from robocomp_dsl.runtime.middleware.ros1.node import RosNode
from robocomp_dsl.runtime.middleware.ros1.publisher import Ros1Publisher
from robocomp_dsl.runtime.middleware.ros1.service import ServiceServer
from robocomp_dsl.runtime.middleware.ros1.settings import read_settings
from robocomp_dsl.runtime.middleware.ros1.subscription import TopicSubscription
from robocomp_dsl.runtime.middleware.ros_common.interface_types import is_topic
from robocomp_dsl.runtime.middleware.ros_common.names import port_name
from robocomp_dsl.runtime.middleware.ros_common.topics import subscribed_topics
from robocomp_dsl.runtime.middleware.transport import TransportContext
from robocomp_dsl.runtime.presence.port_record import PortRecord


def open_transport(context: TransportContext) -> Ros1Transport:
    """Open the middleware for one component. Raises `MiddlewareError`."""
    return Ros1Transport(context)


class Ros1Server:
    """A served port; `address` is its name, and where the node listens."""

    def __init__(self, node: RosNode, port: IncomingPort, name: str) -> None:
        self.address = str(RosAddress(name, node.host, node.listener.number))
        self._node = node
        self._queue: MessageQueue | None = None
        self._servers: list[ServiceServer] = []
        self._subscriptions: list[TopicSubscription] = []
        for served in port.operations.values():
            if is_topic(served.operation, published=False):
                self._queue = self._queue or MessageQueue(port)
                receiver = TopicReceiver(node.name, name, port, served, self._queue)
                self._subscriptions.append(node.add_subscription(receiver))
            else:
                server = ServiceServer(node.name, name, port, served)
                self._servers.append(server)
                node.add_service(server)

    def close(self) -> None:
        """See `transport.PortServer`."""
        for server in self._servers:
            self._node.remove_service(server)
        for subscription in self._subscriptions:
            self._node.remove_subscription(subscription)
        if self._queue:
            self._queue.close()


class Ros1Subscription:
    """A subscribed port; `address` is the topic on which components publish to it."""

    def __init__(self, node: RosNode, port: IncomingPort) -> None:
        own, *others = subscribed_topics(port.at, MIDDLEWARE.name)
        external = {
            parse_address(r.address, port.at.port).name
            for r in port.at.external
            if r.middleware == MIDDLEWARE.name
        }
        self.address = str(RosAddress(own, node.host, node.listener.number))
        self._node = node
        self._queue = MessageQueue(port)
        self._subscriptions = [
            node.add_subscription(TopicReceiver(node.name, topic, port, served, self._queue))
            for topic in (own, *(each for each in others if each in external))
            for served in port.operations.values()
        ]

    def close(self) -> None:
        """See `transport.Subscription`."""
        for subscription in self._subscriptions:
            self._node.remove_subscription(subscription)
        self._queue.close()


class Ros1Transport:
    """See `transport.Transport`."""

    def __init__(self, context: TransportContext) -> None:
        self._context = context
        settings = read_settings(context.settings, os.environ)
        self.node = RosNode(context.component, settings, context.fail)
        self._lock = threading.Lock()
        self._clients: list[Ros1Client] = []

    def serve(self, port: IncomingPort) -> Ros1Server:
        """See `transport.Transport`."""
        return Ros1Server(self.node, port, port_name(port.at, self._context.addresses))

    def connect(self, at: Endpoint, server: PortRecord, timeout: float) -> Ros1Client:
        """See `transport.Transport`."""
        client = Ros1Client(self.node, at, server, timeout)
        with self._lock:
            self._clients.append(client)
        return client

    def advertise(self, at: Endpoint) -> Ros1Publisher:
        """See `transport.Transport`."""
        return Ros1Publisher(self.node, at, port_name(at, self._context.addresses))

    def subscribe(self, port: IncomingPort) -> Ros1Subscription:
        """See `transport.Transport`."""
        return Ros1Subscription(self.node, port)

    def close(self) -> None:
        """See `transport.Transport`."""
        with self._lock:
            clients, self._clients = self._clients, []
        for client in clients:
            client.close()
        self.node.close()
