"""Calls ROS services through rclpy.

In: the name of a service. Out: functions that send a request and wait for the reply, which the
executor's thread receives.
"""

from __future__ import annotations

import threading
import time
from queue import Empty, SimpleQueue
from typing import Any

from rclpy.serialization import deserialize_message, serialize_message

from robocomp_dsl.runtime.component.interface import Operation
from robocomp_dsl.runtime.component.statistics import OperationCounts
from robocomp_dsl.runtime.connection.endpoint import Endpoint
from robocomp_dsl.runtime.errors import InterfaceMismatch, NoServer, Timeout
from robocomp_dsl.runtime.middleware.ros2.graph_check import GraphCheck
from robocomp_dsl.runtime.middleware.ros2.node import RclpyNode
from robocomp_dsl.runtime.middleware.ros2.ros_types import service_class
from robocomp_dsl.runtime.middleware.ros2.topics import Ros2Writer
from robocomp_dsl.runtime.middleware.ros_common.interface_types import is_topic, service_type
from robocomp_dsl.runtime.middleware.ros_common.names import operation_name
from robocomp_dsl.runtime.middleware.ros_common.payload import padded
from robocomp_dsl.runtime.middleware.transport import BoundOperation, ServerLost

DISCOVERY_TIMEOUT_S = 2.0
"""A call waits this long for the service to appear; DDS needs up to a second."""
_POLL_S = 0.01


class Ros2Client:
    """Calls the services of one port; `name` is the ROS name of the port."""

    def __init__(
        self, ros: RclpyNode, graph: GraphCheck, at: Endpoint, name: str, timeout: float
    ) -> None:
        self._ros = ros
        self._graph = graph
        self._at = at
        self._name = name
        self._timeout = timeout
        self._ended = threading.Event()
        self._waiting: set[SimpleQueue[Any]] = set()
        self._clients: list[Any] = []
        self._writers: list[Ros2Writer] = []

    def bind(self, operation: Operation, counts: OperationCounts) -> BoundOperation:
        """See `transport.ServiceClient`."""
        if is_topic(operation, published=False):
            return self._command(operation, counts)
        return self._query(operation, counts)

    def _command(self, operation: Operation, counts: OperationCounts) -> BoundOperation:
        writer = Ros2Writer(self._ros, self._graph, self._at, self._name, operation)
        self._writers.append(writer)

        def command(data: bytes) -> None:
            if not self._wait(writer.has_subscribers):
                what = f"subscriber of the topic {writer.topic}"
                raise NoServer(f"{self._at.port}: no ROS {what} in domain {self._ros.domain_id}")
            writer.send(data)
            counts.bytes_out += len(data)

        return BoundOperation(operation.encode_request, command)

    def _query(self, operation: Operation, counts: OperationCounts) -> BoundOperation:
        type_ = service_type(operation)
        class_ = service_class(type_, self._at.port)
        name = operation_name(self._name, self._at.interface, operation)
        client = self._ros.create("client", class_, name, port=self._at.port)
        self._clients.append(client)
        decode, timeout, waiting = padded(operation.decode_reply), self._timeout, self._waiting

        def query(data: bytes) -> Any:
            if not self._wait(client.service_is_ready):
                raise self._no_service(name, type_.type_id)
            counts.bytes_out += len(data)
            replies: SimpleQueue[Any] = SimpleQueue()
            waiting.add(replies)
            try:
                future = client.call_async(deserialize_message(data, class_.Request))
                future.add_done_callback(lambda done: replies.put(done.result()))
                if self._ended.is_set():
                    raise ServerLost(name)
                response = replies.get(timeout=timeout)
            except Empty:
                client.remove_pending_request(future)
                raise Timeout(f"{name} did not reply within {timeout:g} s") from None
            finally:
                waiting.discard(replies)
            if response is None:
                client.remove_pending_request(future)
                raise ServerLost(name)
            received = serialize_message(response)
            counts.bytes_in += len(received)
            return decode(received)

        return BoundOperation(operation.encode_request, query)

    def _wait(self, is_ready: Any) -> bool:
        """Wait until `is_ready`; False if it is not in time. Raises `ServerLost`."""
        until = time.monotonic() + min(DISCOVERY_TIMEOUT_S, self._timeout)
        while not self._ended.is_set():
            if is_ready():
                return True
            if time.monotonic() > until:
                return False
            self._ended.wait(_POLL_S)
        raise ServerLost(self._name)

    def _no_service(self, name: str, type_id: str) -> Exception:
        if text := self._graph.service_mismatch(name, type_id):
            return InterfaceMismatch(f"{self._at.port}: {text}")
        return NoServer(
            f"{self._at.port}: no ROS service {name} ({type_id}) in domain {self._ros.domain_id}"
        )

    def set_timeout(self, seconds: float) -> None:
        """See `transport.ServiceClient`."""
        self._timeout = seconds

    def cancel(self) -> None:
        """See `transport.ServiceClient`."""
        self._ended.set()
        for replies in list(self._waiting):
            replies.put(None)

    def close(self) -> None:
        """See `transport.ServiceClient`."""
        for client in self._clients:
            self._ros.node.destroy_client(client)
        for writer in self._writers:
            writer.undeclare()
        self._clients.clear()
        self._writers.clear()
