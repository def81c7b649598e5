"""Opens `ros1` for a component: one ROS node, its ports."""

from __future__ import annotations

import logging
import os
import threading

from robocomp_dsl.runtime.connection.endpoint import Endpoint
from robocomp_dsl.runtime.connection.incoming_port import IncomingPort
from robocomp_dsl.runtime.connection.message_queue import MessageQueue
from robocomp_dsl.runtime.middleware.ros1.addresses import RosAddress, own_name, parse_address
from robocomp_dsl.runtime.middleware.ros1.client import Ros1Client
from robocomp_dsl.runtime.middleware.ros1.description import MIDDLEWARE
from robocomp_dsl.runtime.middleware.ros1.incoming import TopicReceiver
from robocomp_dsl.runtime.middleware.ros1.node import RosNode
from robocomp_dsl.runtime.middleware.ros1.parameters import show_parameters
from robocomp_dsl.runtime.middleware.ros1.port_receiver import Handler, PortReceiver
from robocomp_dsl.runtime.middleware.ros1.publisher import Ros1Publisher
from robocomp_dsl.runtime.middleware.ros1.service import ServiceServer
from robocomp_dsl.runtime.middleware.ros1.settings import read_settings
from robocomp_dsl.runtime.middleware.ros1.subscription import TopicSubscription
from robocomp_dsl.runtime.middleware.ros_common.interface_types import is_topic
from robocomp_dsl.runtime.middleware.ros_common.topics import subscribed_name
from robocomp_dsl.runtime.middleware.transport import TransportContext
from robocomp_dsl.runtime.presence.port_record import PortRecord

log = logging.getLogger("robocomp")


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
        handlers: dict[int, Handler] = {}
        for index, operation in enumerate(port.interface.operations):
            served = port.operations.get(operation.name)
            if served is None:
                continue
            if is_topic(operation, published=False):
                self._queue = self._queue or MessageQueue(port)
                receiver = TopicReceiver(node.name, name, port, served, self._queue)
                handlers[index] = receiver.handle
                self._subscriptions.append(node.add_subscription(receiver))
            else:
                server = ServiceServer(node.name, name, port, served)
                handlers[index] = server.reply
                self._servers.append(server)
                node.add_service(server)
        self._port = PortReceiver(node.name, name, port, handlers)
        node.add_port(self._port)

    def close(self) -> None:
        """See `transport.PortServer`."""
        self._node.remove_port(self._port)
        for server in self._servers:
            self._node.remove_service(server)
        for subscription in self._subscriptions:
            self._node.remove_subscription(subscription)
        if self._queue:
            self._queue.close()


class Ros1Subscription:
    """A subscribed port; components publish to its own name."""

    def __init__(self, node: RosNode, port: IncomingPort) -> None:
        own = own_name(subscribed_name(port.at))
        self.address = str(RosAddress(own, node.host, node.listener.number))
        self._node = node
        self._queue = MessageQueue(port)
        names = [own]
        names += [
            parse_address(record.address, port.at.port).name
            for record in port.at.external
            if record.middleware == MIDDLEWARE.name
        ]
        self._subscriptions: list[TopicSubscription] = []
        handlers: dict[int, Handler] = {}
        for index, operation in enumerate(port.interface.operations):
            served = port.operations.get(operation.name)
            if served is None:
                continue
            for name in dict.fromkeys(names):
                receiver = TopicReceiver(node.name, name, port, served, self._queue)
                handlers.setdefault(index, receiver.handle)
                self._subscriptions.append(node.add_subscription(receiver))
        self._port = PortReceiver(node.name, own, port, handlers)
        node.add_port(self._port)

    def close(self) -> None:
        """See `transport.Subscription`."""
        self._node.remove_port(self._port)
        for subscription in self._subscriptions:
            self._node.remove_subscription(subscription)
        self._queue.close()


class Ros1Transport:
    """See `transport.Transport`."""

    def __init__(self, context: TransportContext) -> None:
        self._context = context
        settings = read_settings(context.settings, os.environ)
        if settings.is_unreachable:
            log.warning(
                "%s: nodes on other machines, such as that of the master %s, cannot reach it at"
                " %s: set ros1.host or ROS_IP to the address of this machine",
                *(context.component, settings.master, settings.host),
            )
        self.node = RosNode(context.component, settings, context.fail)
        self._lock = threading.Lock()
        self._clients: list[Ros1Client] = []
        if context.parameters:
            show_parameters(self.node, context.parameters)

    def _name(self, at: Endpoint) -> str:
        """The name of an own port: its address if the user chose one."""
        if text := self._context.addresses.get(at.port):
            return parse_address(text, at.port).name
        return own_name(f"{at.component}/{at.port}")

    def serve(self, port: IncomingPort) -> Ros1Server:
        """See `transport.Transport`."""
        return Ros1Server(self.node, port, self._name(port.at))

    def connect(self, at: Endpoint, server: PortRecord, timeout: float) -> Ros1Client:
        """See `transport.Transport`."""
        client = Ros1Client(self.node, at, server, timeout)
        with self._lock:
            self._clients.append(client)
        return client

    def advertise(self, at: Endpoint) -> Ros1Publisher:
        """See `transport.Transport`."""
        return Ros1Publisher(self.node, at, self._name(at))

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
