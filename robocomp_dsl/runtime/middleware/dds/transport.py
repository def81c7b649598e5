"""Opens `dds` for a component: one participant, its topics."""

from __future__ import annotations

from typing import NoReturn

from robocomp_dsl.runtime.component.interface import Operation
from robocomp_dsl.runtime.component.statistics import OperationCounts
from robocomp_dsl.runtime.connection.endpoint import Endpoint
from robocomp_dsl.runtime.connection.incoming_port import IncomingPort
from robocomp_dsl.runtime.errors import MiddlewareError
from robocomp_dsl.runtime.middleware.dds.description import MIDDLEWARE
from robocomp_dsl.runtime.middleware.dds.participant import Participant
from robocomp_dsl.runtime.middleware.dds.topics import DdsSubscription, DdsWriter
from robocomp_dsl.runtime.middleware.ros_common.interface_types import require_ros_types
from robocomp_dsl.runtime.middleware.ros_common.names import port_name
from robocomp_dsl.runtime.middleware.ros_common.publisher import RosPublisher
from robocomp_dsl.runtime.middleware.ros_common.topics import subscribed_topics
from robocomp_dsl.runtime.middleware.transport import TransportContext
from robocomp_dsl.runtime.presence.port_record import PortRecord


def open_transport(context: TransportContext) -> DdsTransport:
    """Open the middleware for one component. Raises `MiddlewareError`."""
    return DdsTransport(context)


class DdsTransport:
    """All topics of one component."""

    def __init__(self, context: TransportContext) -> None:
        self._context = context
        self._participant = Participant(context.component, context.settings)

    def serve(self, port: IncomingPort) -> NoReturn:
        """Refused: over DDS there are only topics."""
        raise _no_services(port.at.port)

    def connect(self, at: Endpoint, server: PortRecord, timeout: float) -> NoReturn:  # noqa: ARG002
        """Refused: over DDS there are only topics."""
        raise _no_services(at.port)

    def advertise(self, at: Endpoint) -> RosPublisher:
        """See `transport.Transport`."""
        require_ros_types(at.interface, at.port, published=True)

        def open_topic(name: str, operation: Operation) -> DdsWriter:
            counts = OperationCounts(at.port, operation.name)
            return DdsWriter(self._participant, at, name, operation, counts)

        name = port_name(at, self._context.addresses)
        return RosPublisher(at, name, MIDDLEWARE.name, open_topic)

    def subscribe(self, port: IncomingPort) -> DdsSubscription:
        """See `transport.Transport`."""
        require_ros_types(port.interface, port.at.port, published=True)
        topics = subscribed_topics(port.at, MIDDLEWARE.name)
        return DdsSubscription(self._participant, port, topics)

    def close(self) -> None:
        """See `transport.Transport`."""
        self._participant.close()


def _no_services(port: str) -> MiddlewareError:
    return MiddlewareError(
        f"{port}: `dds` has topics only; use `ros2` or `rmw_zenoh` for a service"
    )
