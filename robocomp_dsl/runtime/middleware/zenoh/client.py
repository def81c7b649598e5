"""Calls one server over zenoh.

Queries use a declared querier with the channel that it returns: measured 1.3 times as fast as
`session.get`, and twice as fast as a callback.
"""

from __future__ import annotations

from typing import Any

import zenoh

from robocomp_dsl.runtime.codec.failures import decode_failure
from robocomp_dsl.runtime.component.interface import Operation, Pattern
from robocomp_dsl.runtime.component.statistics import OperationCounts
from robocomp_dsl.runtime.connection.endpoint import Endpoint
from robocomp_dsl.runtime.middleware.transport import BoundOperation, ServerLost
from robocomp_dsl.runtime.middleware.zenoh.options import publisher_options
from robocomp_dsl.runtime.middleware.zenoh.undeclare import undeclare
from robocomp_dsl.runtime.presence import keys
from robocomp_dsl.runtime.presence.port_record import PortRecord


class ZenohServiceClient:
    """Calls the server of one record."""

    def __init__(
        self, session: zenoh.Session, domain: str, at: Endpoint, server: PortRecord, timeout: float
    ) -> None:
        self._session = session
        self._domain = domain
        self._at = Endpoint(at.interface, server.component, server.port)
        self._options = publisher_options(at.qos)
        self._server = server.name
        self._timeout = timeout
        # zenoh itself would wait for the timeout when the server exits.
        self._ended = zenoh.CancellationToken()
        self._declared: list[Any] = []

    def bind(self, operation: Operation, counts: OperationCounts) -> BoundOperation:
        """See `ServiceClient`."""
        if operation.pattern is Pattern.COMMAND:
            return self._command(operation, counts)
        querier: Any = self._session.declare_querier(
            self._key("q", operation),
            timeout=self._timeout,
            consolidation=zenoh.ConsolidationMode.NONE,
            **self._options,
        )
        self._declared.append(querier)
        get, ended, decode = querier.get, self._ended, operation.decode_reply
        server, timeout = self._server, self._timeout

        def query(data: bytes) -> Any:
            counts.bytes_out += len(data)
            try:
                reply = get(payload=data, cancellation_token=ended).recv()
            except (zenoh.ZError, RuntimeError):  # RuntimeError: it is being undeclared
                raise ServerLost(server) from None
            sample = reply.ok
            if sample is None:
                failure = reply.err.payload.to_bytes() if reply.err else b""
                raise decode_failure(operation, server, failure, timeout)
            received = sample.payload.to_bytes()
            counts.bytes_in += len(received)
            return decode(received)

        return BoundOperation(operation.encode_request, query)

    def _command(self, operation: Operation, counts: OperationCounts) -> BoundOperation:
        publisher = self._session.declare_publisher(self._key("c", operation), **self._options)
        self._declared.append(publisher)
        put = publisher.put

        def command(data: bytes) -> None:
            try:
                put(data)
            except (zenoh.ZError, RuntimeError):
                raise ServerLost(self._server) from None
            counts.bytes_out += len(data)

        return BoundOperation(operation.encode_request, command)

    def _key(self, kind: keys.Kind, operation: Operation) -> str:
        return f"{keys.port_key(self._domain, kind, self._at)}/{keys.escape_chunk(operation.name)}"

    def set_timeout(self, seconds: float) -> None:
        """See `ServiceClient`."""
        self._timeout = seconds

    def cancel(self) -> None:
        """See `ServiceClient`."""
        self._ended.cancel()

    def close(self) -> None:
        """See `ServiceClient`."""
        undeclare(self._declared)
