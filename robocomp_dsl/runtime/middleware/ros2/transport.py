"""Opens `ros2` for a component: one ROS node, its ports."""

from __future__ import annotations

from robocomp_dsl.runtime.component.interface import Operation
from robocomp_dsl.runtime.connection.endpoint import Endpoint
from robocomp_dsl.runtime.connection.incoming_port import IncomingPort
from robocomp_dsl.runtime.middleware.ros2.client import Ros2Client
from robocomp_dsl.runtime.middleware.ros2.description import MIDDLEWARE
from robocomp_dsl.runtime.middleware.ros2.graph_check import GraphCheck
from robocomp_dsl.runtime.middleware.ros2.node import RclpyNode
from robocomp_dsl.runtime.middleware.ros2.parameters import RosParameters
from robocomp_dsl.runtime.middleware.ros2.server import Ros2Server
from robocomp_dsl.runtime.middleware.ros2.topics import Ros2Subscription, Ros2Writer
from robocomp_dsl.runtime.middleware.ros_common.interface_types import require_ros_types
from robocomp_dsl.runtime.middleware.ros_common.names import absolute_name, port_name
from robocomp_dsl.runtime.middleware.ros_common.publisher import RosPublisher
from robocomp_dsl.runtime.middleware.ros_common.topics import subscribed_topics
from robocomp_dsl.runtime.middleware.transport import TransportContext
from robocomp_dsl.runtime.presence.port_record import PortRecord


def open_transport(context: TransportContext) -> Ros2Transport:
    """Open the middleware for one component. Raises `MiddlewareError`."""
    return Ros2Transport(context)


class Ros2Transport:
    """All ROS endpoints of one component."""

    def __init__(self, context: TransportContext) -> None:
        self._context = context
        self._ros = RclpyNode(context.component, context.settings)
        self._graph = GraphCheck(self._ros)
        if context.parameters:
            self._parameters = RosParameters(self._ros.node, context.parameters)

    def serve(self, port: IncomingPort) -> Ros2Server:
        """See `transport.Transport`."""
        require_ros_types(port.interface, port.at.port, published=False)
        name = port_name(port.at, self._context.addresses)
        return Ros2Server(self._ros, self._graph, port, name)

    def connect(self, at: Endpoint, server: PortRecord, timeout: float) -> Ros2Client:
        """See `transport.Transport`."""
        require_ros_types(at.interface, at.port, published=False)
        name = absolute_name(server.address, at.port)
        return Ros2Client(self._ros, self._graph, at, name, timeout)

    def advertise(self, at: Endpoint) -> RosPublisher:
        """See `transport.Transport`."""
        require_ros_types(at.interface, at.port, published=True)

        def open_topic(name: str, operation: Operation) -> Ros2Writer:
            return Ros2Writer(self._ros, self._graph, at, name, operation)

        name = port_name(at, self._context.addresses)
        return RosPublisher(at, name, MIDDLEWARE.name, open_topic)

    def subscribe(self, port: IncomingPort) -> Ros2Subscription:
        """See `transport.Transport`."""
        require_ros_types(port.interface, port.at.port, published=True)
        topics = subscribed_topics(port.at, MIDDLEWARE.name)
        return Ros2Subscription(self._ros, self._graph, port, topics)

    def close(self) -> None:
        """See `transport.Transport`."""
        self._ros.close()
