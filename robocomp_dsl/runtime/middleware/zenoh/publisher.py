"""Publishes the operations of a topic with zenoh publishers."""

from __future__ import annotations

from dataclasses import replace
from typing import Any

import zenoh

from robocomp_dsl.runtime.component.interface import Operation
from robocomp_dsl.runtime.component.statistics import OperationCounts
from robocomp_dsl.runtime.connection.endpoint import Endpoint
from robocomp_dsl.runtime.errors import MiddlewareError
from robocomp_dsl.runtime.middleware.transport import BoundOperation
from robocomp_dsl.runtime.middleware.zenoh.held_publisher import HeldPublisher
from robocomp_dsl.runtime.middleware.zenoh.options import publisher_options
from robocomp_dsl.runtime.middleware.zenoh.undeclare import undeclare
from robocomp_dsl.runtime.presence import keys
from robocomp_dsl.runtime.presence.port_record import PortRecord


class ZenohPublisher:
    """A published port. zenoh routes to all subscribers by key."""

    def __init__(self, session: zenoh.Session, domain: str, at: Endpoint, address: str) -> None:
        self.address = address
        self._session = session
        self._domain = domain
        self._at = at
        self._publishers: list[zenoh.Publisher] = []
        self._listeners: list[Any] = []
        self._stale, self._has_subscribers = True, False

    def bind(self, operation: Operation, counts: OperationCounts) -> BoundOperation:
        """See `Publisher`."""
        key = f"{keys.port_key(self._domain, 't', self._at)}/{keys.escape_chunk(operation.name)}"
        publisher: Any
        if self._at.qos.holds_publisher:
            # The transport gave a session that holds what it would drop.
            options = publisher_options(replace(self._at.qos, reliable=False))
            declared = self._session.declare_publisher(key, **options)
            publisher = HeldPublisher(declared, counts)
        else:
            options = publisher_options(self._at.qos)
            publisher = declared = self._session.declare_publisher(key, **options)
        self._publishers.append(declared)
        put = publisher.put

        def send(data: bytes, number: bytes) -> None:
            try:
                put(data, attachment=number)
            except (zenoh.ZError, RuntimeError):  # RuntimeError: it is being undeclared
                raise MiddlewareError(
                    f"{self._at.name} is closed: it publishes no longer"
                ) from None
            counts.bytes_out += len(data)

        return BoundOperation(operation.encode_request, send)

    def attach(self, subscriber: PortRecord) -> None:
        """Nothing to do: subscribers declare their interest."""

    def detach(self, subscriber: PortRecord) -> None:
        """Nothing to do: subscribers end their interest."""

    def has_subscribers(self) -> bool:
        """See `Publisher`; subscribers of other zenoh programs count, too."""
        for publisher in self._publishers[len(self._listeners) :]:
            callback = zenoh.handlers.Callback(self._on_matching_changed, indirect=False)
            self._listeners.append(publisher.declare_matching_listener(callback))
        if self._stale:
            self._stale = False  # first, so that a change that comes meanwhile is not missed
            statuses: list[Any] = [publisher.matching_status for publisher in self._publishers]
            self._has_subscribers = any(status.matching for status in statuses)
        return self._has_subscribers

    def _on_matching_changed(self, _status: object) -> None:
        self._stale = True

    def close(self) -> None:
        """See `Publisher`."""
        self._stale = self._has_subscribers = False
        undeclare(self._listeners)
        undeclare(self._publishers)
