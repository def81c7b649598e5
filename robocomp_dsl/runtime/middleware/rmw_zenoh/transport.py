"""Opens `rmw_zenoh` for a component: one session, one ROS node, its ports."""

from __future__ import annotations

from robocomp_dsl.runtime.component.interface import Operation
from robocomp_dsl.runtime.connection.endpoint import Endpoint
from robocomp_dsl.runtime.connection.incoming_port import IncomingPort
from robocomp_dsl.runtime.middleware.rmw_zenoh.client import RmwZenohClient
from robocomp_dsl.runtime.middleware.rmw_zenoh.description import MIDDLEWARE
from robocomp_dsl.runtime.middleware.rmw_zenoh.operations import topic_info
from robocomp_dsl.runtime.middleware.rmw_zenoh.server import RmwZenohServer
from robocomp_dsl.runtime.middleware.rmw_zenoh.session import RosSession
from robocomp_dsl.runtime.middleware.rmw_zenoh.topics import RmwZenohSubscription, RmwZenohWriter
from robocomp_dsl.runtime.middleware.ros_common.interface_types import require_ros_types
from robocomp_dsl.runtime.middleware.ros_common.names import absolute_name, port_name
from robocomp_dsl.runtime.middleware.ros_common.publisher import RosPublisher
from robocomp_dsl.runtime.middleware.ros_common.topics import subscribed_topics
from robocomp_dsl.runtime.middleware.transport import TransportContext
from robocomp_dsl.runtime.presence.port_record import PortRecord


def open_transport(context: TransportContext) -> RmwZenohTransport:
    """Open the middleware for one component. Raises `MiddlewareError`."""
    return RmwZenohTransport(context)


class RmwZenohTransport:
    """All ROS endpoints of one component."""

    def __init__(self, context: TransportContext) -> None:
        self._context = context
        self._session = RosSession(context.component, context.settings)

    def serve(self, port: IncomingPort) -> RmwZenohServer:
        """See `transport.Transport`."""
        require_ros_types(port.interface, port.at.port, published=False)
        return RmwZenohServer(self._session, port, port_name(port.at, self._context.addresses))

    def connect(self, at: Endpoint, server: PortRecord, timeout: float) -> RmwZenohClient:
        """See `transport.Transport`."""
        require_ros_types(at.interface, at.port, published=False)
        name = absolute_name(server.address, at.port)
        return RmwZenohClient(self._session, at, name, timeout)

    def advertise(self, at: Endpoint) -> RosPublisher:
        """See `transport.Transport`."""
        require_ros_types(at.interface, at.port, published=True)

        def open_topic(name: str, operation: Operation) -> RmwZenohWriter:
            info = topic_info(name, at.interface, operation)
            return RmwZenohWriter(self._session, info, at.qos, at.port)

        name = port_name(at, self._context.addresses)
        return RosPublisher(at, name, MIDDLEWARE.name, open_topic)

    def subscribe(self, port: IncomingPort) -> RmwZenohSubscription:
        """See `transport.Transport`."""
        require_ros_types(port.interface, port.at.port, published=True)
        topics = subscribed_topics(port.at, MIDDLEWARE.name)
        return RmwZenohSubscription(self._session, port, topics)

    def close(self) -> None:
        """See `transport.Transport`."""
        self._session.close()
