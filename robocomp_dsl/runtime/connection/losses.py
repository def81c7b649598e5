"""Counts lost publications: exactly, for any number of publishers.

In: the sequence numbers of messages, and what publishers announce of themselves
(`presence.publications`). Out: the `drops` of an operation.

A publisher that is younger than the subscription counts from its first message. An older one, and
one on another machine, counts from the number that it has when it is discovered.
"""

from __future__ import annotations

import threading
import time
from collections import deque
from collections.abc import Iterable

from robocomp_dsl.runtime.component.callback_group import CallbackGroup
from robocomp_dsl.runtime.component.statistics import OperationCounts
from robocomp_dsl.runtime.connection.endpoint import Endpoint
from robocomp_dsl.runtime.connection.peer_selection import matches
from robocomp_dsl.runtime.connection.sequence import MAX_RATE, SequenceTracker
from robocomp_dsl.runtime.presence import keys
from robocomp_dsl.runtime.presence.publications import PublishedCount, PublisherRegistry
from robocomp_dsl.runtime.presence.sequence_format import SEQUENCE_FORMAT

SETTLE_S = 0.02
"""A message that has arrived is passed to its handler within this time, unless one is busy."""
MAX_UNKNOWN = 64
"""Publishers that have not announced themselves, and are remembered for the case that they do."""


class LossCounters:
    """All loss counters of a component."""

    def __init__(self, publishers: PublisherRegistry) -> None:
        self._publishers = publishers
        self._counters: list[LossCounter] = []
        self._closed = threading.Event()

    def add(
        self, at: Endpoint, counts: OperationCounts, group: CallbackGroup, *, is_start: bool = True
    ) -> LossCounter:
        """A new counter for an operation of `at`, which is subscribed to from now on.

        `is_start` is false for a connection that is made while the component runs: the messages of
        a publisher that is known count from the first that arrives.
        """
        counter = LossCounter(at, counts, self._publishers, group, is_start=is_start)
        self._counters.append(counter)
        return counter

    def remove(self, counter: LossCounter) -> None:
        """The operation is subscribed to no longer."""
        counter.process()
        if counter in self._counters:
            self._counters.remove(counter)

    def settle(self) -> None:
        """Ask all publishers for their numbers, and count what did not arrive in the end."""
        current = self._publishers.current_counts()
        counters = list(self._counters)
        calls = [counter.calls for counter in counters]
        # What arrived before the replies is passed to its handler in the meantime.
        self._closed.wait(SETTLE_S)
        for counter, calls_before in zip(counters, calls, strict=True):
            counter.settle(current, calls_before)

    def close(self) -> None:
        """End a `settle` that is waiting."""
        self._closed.set()


class LossCounter:
    """Counts the losses of one operation of a subscribing port.

    `pending` receives the attachment of each message, which is all that a message costs; `process`
    evaluates them, and is called when there are more than
    `MAX_PENDING_NUMBERS`.
    """

    def __init__(
        self,
        at: Endpoint,
        counts: OperationCounts,
        publishers: PublisherRegistry,
        execution: CallbackGroup,
        *,
        is_start: bool = True,
    ) -> None:
        self._at = at
        self._is_start = is_start
        self._counts = counts
        self._operation = keys.escape_chunk(counts.operation)
        self._publishers = publishers
        self._execution = execution
        self._subscribed = time.monotonic_ns()
        self._trackers: dict[int, SequenceTracker] = {}
        self._reported = 0
        self._lock = threading.Lock()
        self.pending: deque[bytes] = deque()

    @property
    def calls(self) -> int:
        """Messages that have been passed to the handler."""
        return self._counts.calls

    def has_arrived(self, publisher: int, number: int) -> bool:
        """Whether the message of a publisher with this number, or a later one, has arrived."""
        with self._lock:
            self._process()
            tracker = self._trackers.get(publisher)
            return tracker is not None and tracker.next > number

    def process(self) -> None:
        """Evaluate the attachments that have arrived."""
        with self._lock:
            self._process()
            self._update()

    def _process(self) -> None:
        pending, trackers = self.pending, self._trackers
        while pending:
            attachment = pending.popleft()
            if len(attachment) != SEQUENCE_FORMAT.size:
                continue
            publisher, number = SEQUENCE_FORMAT.unpack(attachment)
            tracker = trackers.get(publisher)
            if tracker is None:
                self._add(publisher, number)
            elif number == tracker.next and tracker.unconfirmed is None:
                tracker.next = number + 1
            else:
                tracker.accept(number)

    def _add(self, publisher: int, number: int) -> None:
        """The first message of a publisher."""
        known = self._publishers.created
        if publisher not in known:
            unknown = [each for each in self._trackers if each not in known]
            if len(unknown) >= MAX_UNKNOWN:
                del self._trackers[unknown[0]]
        self._trackers[publisher] = SequenceTracker(number)

    def _update(self) -> None:
        """Add up the losses from publishers that have announced themselves."""
        lost = 0
        for publisher, tracker in self._trackers.items():
            created = self._publishers.created.get(publisher)
            if created is None or tracker.next > self._most_published(publisher, created):
                continue
            if tracker.begin is None:
                tracker.begin = self._begin(publisher, created)
            lost += tracker.lost
        self._counts.drops += lost - self._reported
        self._reported = lost

    def _most_published(self, publisher: int, created: int) -> float:
        """The number of messages that a publisher can have published since its creation, in ns."""
        most = MAX_RATE * (1 + (time.monotonic_ns() - created) / 1e9)
        if publisher in self._publishers.remote:
            most += self._publishers.counts_at_discovery.get((publisher, self._operation), 0)
        return most

    def _begin(self, publisher: int, created: int) -> int | None:
        """The number from which the messages of a publisher count; None if not known yet."""
        if created > self._subscribed and publisher not in self._publishers.remote:
            return 0
        if not self._is_start:
            tracker = self._trackers.get(publisher)
            return tracker.first if tracker else None
        return self._publishers.counts_at_discovery.get((publisher, self._operation))

    def settle(self, current: Iterable[PublishedCount], calls_before: int) -> None:
        """Count what publishers sent after the last message that arrived, if none is waiting.

        `current`: how many messages each publisher has published; `calls_before`: `calls` when that
        was known. While a handler is busy, messages may wait for it: then nothing is counted.
        """
        with self._lock:
            self._process()
            if calls_before == self.calls and not self._execution.busy:
                for published in current:
                    self._settle(published)
            self._update()

    def _settle(self, published: PublishedCount) -> None:
        """Count the last messages of one publisher, or all if none has arrived."""
        created = self._publishers.created.get(published.publisher)
        if created is None or not self._subscribes_to(published):
            return
        tracker = self._trackers.get(published.publisher)
        if tracker is None:
            begin = self._begin(published.publisher, created)
            if begin is None or begin > published.number:
                return
            tracker = self._trackers[published.publisher] = SequenceTracker(
                begin, has_arrived=False
            )
        tracker.settle(published.number)

    def _subscribes_to(self, published: PublishedCount) -> bool:
        interface = self._at.interface
        return (
            published.operation == self._operation
            and (published.interface, published.hash) == (interface.name, interface.hash.hex())
            and matches(self._at, published.component, published.port)
        )
