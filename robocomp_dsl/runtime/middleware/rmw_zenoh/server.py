"""A served port: services, and topics for its commands.

In: requests of ROS clients. Out: replies with the attachment of the request, as `rmw_zenoh_cpp`
sends them. A ROS service has no errors: a ROS client of a handler that fails waits until its
timeout, a component of ours reads the error reply.
"""

from __future__ import annotations

import time
from collections.abc import Callable
from typing import Any

import zenoh

from robocomp_dsl.runtime.codec.failures import encode_failure
from robocomp_dsl.runtime.connection.incoming_port import IncomingOperation, IncomingPort
from robocomp_dsl.runtime.middleware.rmw_zenoh.operations import service_info
from robocomp_dsl.runtime.middleware.rmw_zenoh.session import RosSession
from robocomp_dsl.runtime.middleware.rmw_zenoh.topics import RmwZenohReceiver
from robocomp_dsl.runtime.middleware.rmw_zenoh.wire import attachment, parse_attachment
from robocomp_dsl.runtime.middleware.ros_common.interface_types import is_topic
from robocomp_dsl.runtime.middleware.ros_common.payload import padded

DEPTH = 256
"""Default queue length."""


class RmwZenohServer:
    """One served port; `address` is its ROS name."""

    def __init__(self, session: RosSession, port: IncomingPort, name: str) -> None:
        self.address = name
        self._session = session
        self._declared: list[Any] = []
        for served in port.operations.values():
            if is_topic(served.operation, published=False):
                self._declared.append(RmwZenohReceiver(session, port, served, name))
            else:
                self._serve(port, served)

    def _serve(self, port: IncomingPort, served: IncomingOperation) -> None:
        info = service_info(self.address, port.interface, served.operation)
        key = info.key(self._session.domain_id)
        queue: Any = zenoh.handlers.FifoChannel(port.at.qos.depth or DEPTH)
        # Clients of ROS query complete queryables only.
        queryable: Any = self._session.zenoh.declare_queryable(key, queue, complete=True)
        token, _ = self._session.announce("SS", info, port.at.qos)
        self._declared += [token, queryable]
        self._session.graph.watch(info, port.at.port)
        port.receive(queryable.handler.recv, _answer(served, key), zenoh.ZError)

    def close(self) -> None:
        """See `transport.Server`."""
        for entry in self._declared:
            entry.undeclare()


def _answer(served: IncomingOperation, key: str) -> Callable[[zenoh.Query], None]:
    operation, counts, handle = served.operation, served.counts, served.handle
    decode, encode = padded(operation.decode_request), operation.encode_reply

    def answer(query: zenoh.Query) -> None:
        try:
            payload, received = query.payload, query.attachment
            data = b"" if payload is None else payload.to_bytes()
            counts.bytes_in += len(data)
            sequence, _, gid = parse_attachment(b"" if received is None else received.to_bytes())
            reply = encode(handle(decode(data)))
            counts.bytes_out += len(reply)
            query.reply(key, reply, attachment=attachment(sequence, time.time_ns(), gid))
        except BaseException as error:
            served.report(error)
            query.reply_err(encode_failure(operation, error))
        query.drop()

    return answer
