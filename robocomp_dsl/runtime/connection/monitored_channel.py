"""The calling side of a monitored connection.

In: a channel. Out: a channel that monitors each call.
"""

from __future__ import annotations

from robocomp_dsl.runtime.component.interface import Operation, Pattern
from robocomp_dsl.runtime.connection.monitored_connection import MonitoredConnection
from robocomp_dsl.runtime.connection.ports import Channel, OperationCallable


def is_query(operation: Operation, *, is_topic: bool) -> bool:
    """Whether a caller waits for a reply to `operation`."""
    unmarked_query = operation.pattern is Pattern.UNMARKED and not is_topic
    return operation.pattern is Pattern.QUERY or unmarked_query


class MonitoredChannel:
    """A channel of a required or published port whose messages pass through monitors."""

    def __init__(
        self, channel: Channel, connection: MonitoredConnection, *, is_topic: bool
    ) -> None:
        self._channel = channel
        self._connection = connection
        self._is_topic = is_topic

    @property
    def timeout(self) -> float:
        """See `ports.Channel`."""
        return self._channel.timeout

    @timeout.setter
    def timeout(self, seconds: float) -> None:
        self._channel.timeout = seconds

    def bind(self, operation: Operation) -> OperationCallable:
        """See `ports.Channel`."""
        return self._connection.wrap(
            operation,
            self._channel.bind(operation),
            is_query=is_query(operation, is_topic=self._is_topic),
            is_sender=True,
        )

    def wait(self, timeout: float) -> bool:
        """See `ports.Channel`."""
        return self._channel.wait(timeout)

    def has_subscribers(self) -> bool:
        """See `ports.Channel`."""
        return self._channel.has_subscribers()
