"""Calls a ROS service over rmw_zenoh.

In: the name of a service. Out: functions that send a request with its attachment, and decode the
reply. Errors name the node that serves it, where one is known.
"""

from __future__ import annotations

import time
from itertools import count
from typing import Any

import zenoh

from robocomp_dsl.runtime.codec.failures import decode_failure
from robocomp_dsl.runtime.component.interface import Operation
from robocomp_dsl.runtime.component.statistics import OperationCounts
from robocomp_dsl.runtime.connection.endpoint import Endpoint
from robocomp_dsl.runtime.errors import InterfaceMismatch, NoServer
from robocomp_dsl.runtime.middleware.rmw_zenoh.graph import mismatch
from robocomp_dsl.runtime.middleware.rmw_zenoh.operations import service_info, topic_info
from robocomp_dsl.runtime.middleware.rmw_zenoh.session import RosSession
from robocomp_dsl.runtime.middleware.rmw_zenoh.topics import RmwZenohWriter
from robocomp_dsl.runtime.middleware.rmw_zenoh.wire import TopicInfo, attachment
from robocomp_dsl.runtime.middleware.ros_common.interface_types import is_topic
from robocomp_dsl.runtime.middleware.ros_common.payload import padded
from robocomp_dsl.runtime.middleware.transport import BoundOperation, ServerLost

DISCOVERY_TIMEOUT_S = 1.0
"""A call waits this long for the service to appear."""


class RmwZenohClient:
    """Calls the services of one port; `name` is the ROS name of the port."""

    def __init__(self, session: RosSession, at: Endpoint, name: str, timeout: float) -> None:
        self._session = session
        self._at = at
        self._name = name
        self._timeout = timeout
        self._ended = zenoh.CancellationToken()
        self._is_ended = False
        self._declared: list[Any] = []

    def bind(self, operation: Operation, counts: OperationCounts) -> BoundOperation:
        """See `transport.ServiceClient`."""
        if is_topic(operation, published=False):
            info = topic_info(self._name, self._at.interface, operation)
            writer = RmwZenohWriter(self._session, info, self._at.qos, self._at.port)
            self._declared.append(writer)
            return self._command(writer, operation, counts)
        return self._query(operation, counts)

    def _command(
        self, writer: RmwZenohWriter, operation: Operation, counts: OperationCounts
    ) -> BoundOperation:
        def command(data: bytes) -> None:
            self._require("MS", writer.info)
            writer.send(data)
            counts.bytes_out += len(data)

        return BoundOperation(operation.encode_request, command)

    def _query(self, operation: Operation, counts: OperationCounts) -> BoundOperation:
        info = service_info(self._name, self._at.interface, operation)
        querier: Any = self._session.zenoh.declare_querier(
            info.key(self._session.domain_id),
            target=zenoh.QueryTarget.ALL_COMPLETE,
            consolidation=zenoh.ConsolidationMode.NONE,
            timeout=self._timeout,
        )
        token, gid = self._session.announce("SC", info, self._at.qos)
        self._declared += [token, querier]
        get, ended, timeout = querier.get, self._ended, self._timeout
        decode, numbers = padded(operation.decode_reply), count(1)

        def query(data: bytes) -> Any:
            self._require("SS", info)
            counts.bytes_out += len(data)
            try:
                reply = get(
                    payload=data,
                    attachment=attachment(next(numbers), time.time_ns(), gid),
                    cancellation_token=ended,
                ).recv()
            except zenoh.ZError:
                raise ServerLost(self._name) from None
            sample = reply.ok
            if sample is None:
                failure = reply.err.payload.to_bytes() if reply.err else b""
                raise decode_failure(operation, self._name, failure, timeout)
            received = sample.payload.to_bytes()
            counts.bytes_in += len(received)
            return decode(received)

        return BoundOperation(operation.encode_request, query)

    def _require(self, kind: str, info: TopicInfo) -> None:
        """Wait for the other side. Raises `ServerLost`, `NoServer` or `InterfaceMismatch`."""
        graph = self._session.graph
        if graph.find(kind, info):
            return

        def is_known() -> bool:
            return bool(self._is_ended or graph.find(kind, info))

        graph.wait(is_known, min(DISCOVERY_TIMEOUT_S, self._timeout))
        if self._is_ended:
            raise ServerLost(self._name)
        if graph.find(kind, info):
            return
        if other := graph.find_other(kind, info):
            raise InterfaceMismatch(f"{self._at.port}: {mismatch(other, info)}")
        what = "service" if kind == "SS" else "subscriber of the topic"
        raise NoServer(
            f"{self._at.port}: no ROS {what} {info.name} ({info.type_id}) in domain"
            f" {self._session.domain_id} of {self._session.connect}"
        )

    def set_timeout(self, seconds: float) -> None:
        """See `transport.ServiceClient`."""
        self._timeout = seconds

    def cancel(self) -> None:
        """See `transport.ServiceClient`."""
        self._is_ended = True
        self._ended.cancel()
        self._session.graph.notify()

    def close(self) -> None:
        """See `transport.ServiceClient`."""
        for entry in self._declared:
            entry.undeclare()
        self._declared.clear()
