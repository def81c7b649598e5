"""The latest messages of publishers that were there before the subscriber (`latched`).

In: the publishers of a subscription. Out: their latest messages, passed to the handlers unless a
later message of the publisher has arrived already. A message that was on its way meanwhile may
arrive twice, but never in the wrong order.
"""

from __future__ import annotations

import math
import time

from robocomp_dsl.runtime.connection.connection_events import ConnectionEvents
from robocomp_dsl.runtime.connection.incoming_port import IncomingOperation, IncomingPort
from robocomp_dsl.runtime.presence.port_record import PortRecord
from robocomp_dsl.runtime.presence.presence import LatestMessage, Presence
from robocomp_dsl.runtime.presence.sequence_format import SEQUENCE_FORMAT

ASK_AGAIN_S = 0.25
"""A publisher may have published before it knew the subscriber: it is asked a second time."""


class LatestValues:
    """The latest messages for one subscription."""

    def __init__(self, port: IncomingPort, presence: Presence, events: ConnectionEvents) -> None:
        self._port = port
        self._presence = presence
        self._events = events
        self._asked: dict[PortRecord, float] = {}
        self._interruptions = presence.registry.interruptions
        self._delivered: dict[tuple[int, str], int] = {}
        self._calls = {name: o.counts.calls for name, o in port.operations.items()}
        self._own_calls = dict.fromkeys(port.operations, 0)

    def update(self, publishers: list[PortRecord]) -> None:
        """Ask the publishers that have appeared."""
        now = time.monotonic()
        asked, self._asked = self._asked, {}
        if self._interruptions != self._presence.registry.interruptions:
            # What was published while a router was away has not arrived.
            self._interruptions = self._presence.registry.interruptions
            asked = {}
        for record in publishers:
            if record in self._port.at.external:
                continue
            self._asked[record] = asked.get(record, now + ASK_AGAIN_S)
            if record not in asked:
                self._ask(record)

    def check(self, now: float) -> float:
        """Ask again when it is time; returns when to check again."""
        for record, again in self._asked.items():
            if again <= now:
                self._asked[record] = math.inf
                self._ask(record)
        return min(self._asked.values(), default=math.inf)

    def _ask(self, record: PortRecord) -> None:
        def on_message(message: LatestMessage) -> None:
            self._events.run(lambda: self._deliver(message), self._port.at.name)

        self._presence.fetch_latest(self._port.at, record, on_message)

    def _deliver(self, message: LatestMessage) -> None:
        """Pass a message to its handler, in the thread of the events."""
        operation = self._port.operations.get(message.operation)
        if operation is None:
            return
        publisher, number = SEQUENCE_FORMAT.unpack(message.number)
        key = (publisher, message.operation)
        if number <= self._delivered.get(key, -1):
            return
        self._delivered[key] = number

        def skip() -> bool:
            """Whether a later message has arrived."""
            if operation.losses is not None:
                return operation.losses.has_arrived(publisher, number)
            if self._has_other_message(operation):
                return True
            self._own_calls[message.operation] += 1
            return False

        try:
            operation.handle_unless(skip, operation.operation.decode_request(message.data))
        except BaseException as error:
            operation.report(error)

    def _has_other_message(self, operation: IncomingOperation) -> bool:
        """Whether the only publisher of a port without sequence numbers has published meanwhile."""
        counts = operation.counts
        own, before = self._own_calls[counts.operation], self._calls[counts.operation]
        return len(self._asked) == 1 and counts.calls - before > own
