"""The latest message of each operation of a latched topic.

In: publications. Out: their encoded copies, for subscribers that start later.
"""

from __future__ import annotations

import secrets
import threading
from itertools import count
from typing import Any

from robocomp_dsl.runtime.component.interface import Operation
from robocomp_dsl.runtime.connection.endpoint import Endpoint
from robocomp_dsl.runtime.connection.ports import OperationCallable
from robocomp_dsl.runtime.presence.presence import LatestMessage, Presence, PublicationNumbers
from robocomp_dsl.runtime.presence.sequence_format import SEQUENCE_FORMAT


class LatchedMessages:
    """The latest messages of one published port."""

    def __init__(self, at: Endpoint, presence: Presence) -> None:
        self._presence = presence
        self._latest: dict[str, LatestMessage] = {}
        self._id = secrets.randbits(64)
        self._lock = threading.Lock()
        self._offered = presence.offer_latest(at, self.latest)

    def latest(self) -> list[LatestMessage]:
        """One message for each operation that has been published."""
        return list(self._latest.values())

    def keep(
        self,
        operation: Operation,
        publish: OperationCallable,
        numbers: PublicationNumbers | None,
    ) -> OperationCallable:
        """`publish`, which also keeps what it publishes; a message that cannot be sent is not."""
        name, encode, lock = operation.name, operation.encode_request, self._lock
        sequence = numbers.counter(name) if numbers else count()
        publisher_id = numbers.id if numbers else self._id

        def publish_and_keep(*arguments: Any) -> None:
            data = encode(arguments)
            with lock:
                number = int(repr(sequence)[len("count(") : -1])
                if numbers is None:
                    next(sequence)
                # Kept first: who asks now may not be reached by the publication.
                packed = SEQUENCE_FORMAT.pack(publisher_id, number)
                self._latest[name] = LatestMessage(name, packed, data)
                publish(*arguments)

        return publish_and_keep

    def rename(self, at: Endpoint) -> None:
        """Offer the messages under another name."""
        former = self._offered
        self._offered = self._presence.offer_latest(at, self.latest)
        former.close()

    def close(self) -> None:
        """Offer the messages no longer."""
        self._offered.close()
