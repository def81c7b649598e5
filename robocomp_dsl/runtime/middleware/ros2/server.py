"""A served port: services of rclpy, and topics for its commands.

A ROS service has no errors: a client whose request fails here gets no reply, and waits until its
timeout.
"""

from __future__ import annotations

from typing import Any

from rclpy.serialization import deserialize_message, serialize_message

from robocomp_dsl.runtime.connection.incoming_port import IncomingOperation, IncomingPort
from robocomp_dsl.runtime.connection.message_queue import MessageQueue
from robocomp_dsl.runtime.middleware.ros2.graph_check import GraphCheck
from robocomp_dsl.runtime.middleware.ros2.node import RclpyNode
from robocomp_dsl.runtime.middleware.ros2.ros_types import service_class
from robocomp_dsl.runtime.middleware.ros2.topics import Ros2Receiver
from robocomp_dsl.runtime.middleware.ros_common.interface_types import is_topic, service_type
from robocomp_dsl.runtime.middleware.ros_common.names import operation_name
from robocomp_dsl.runtime.middleware.ros_common.payload import padded


class Ros2Server:
    """One served port; `address` is its ROS name."""

    def __init__(self, ros: RclpyNode, graph: GraphCheck, port: IncomingPort, name: str) -> None:
        self.address = name
        self._queue = MessageQueue(port)
        self._endpoints: list[_ServiceEndpoint | Ros2Receiver] = []
        for served in port.operations.values():
            if is_topic(served.operation, published=False):
                receiver = Ros2Receiver(ros, graph, port, served, name, self._queue)
                self._endpoints.append(receiver)
            else:
                self._endpoints.append(_ServiceEndpoint(ros, port, served, name, self._queue))

    def close(self) -> None:
        """See `transport.Server`."""
        for endpoint in self._endpoints:
            endpoint.undeclare()
        self._queue.close()


class _ServiceEndpoint:
    """The service of one operation.

    rclpy sends what the callback returns. The callback returns the request, and `send_response` of
    the service, which rclpy calls with it, is replaced: it queues the request for the thread of the
    port, which replies later. The executor waits for no handler.
    """

    def __init__(
        self,
        ros: RclpyNode,
        port: IncomingPort,
        served: IncomingOperation,
        name: str,
        queue: MessageQueue,
    ) -> None:
        self._ros = ros
        self._served = served
        self._queue = queue
        operation = served.operation
        self._decode = padded(operation.decode_request)
        self._encode = operation.encode_reply
        class_ = service_class(service_type(operation), port.at.port)
        self._response_class = class_.Response
        full = operation_name(name, port.interface, operation)
        self._service: Any = ros.create("service", class_, full, _request, port=port.at.port)
        self._send_response = self._service.send_response
        self._service.send_response = self._enqueue

    def _enqueue(self, request: Any, header: Any) -> None:
        self._queue.put(self._served, self._answer, (request, header))

    def _answer(self, arguments: tuple[Any, ...]) -> None:
        request, header = arguments
        counts = self._served.counts
        data = serialize_message(request)
        counts.bytes_in += len(data)
        reply = self._encode(self._served.handle(self._decode(data)))
        counts.bytes_out += len(reply)
        self._send_response(deserialize_message(reply, self._response_class), header)

    def undeclare(self) -> None:
        """Accept no further calls."""
        self._ros.node.destroy_service(self._service)


def _request(request: Any, _response: Any) -> Any:
    """The callback of all services; see `_ServiceEndpoint`."""
    return request
