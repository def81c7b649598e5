"""Counts lost publications: exactly, for any number of publishers.

In: attachments of messages, and what publishers announce of themselves: a liveliness token with id
and time of creation, and a queryable for the number of messages so far. Out: the `drops` of an
operation.

A publisher that is younger than the subscription counts from its first message. An older one
counts from the number that it has when it is discovered.
"""

from __future__ import annotations

import contextlib
import secrets
import threading
import time
from collections import deque
from collections.abc import Iterable, Iterator
from dataclasses import dataclass
from itertools import count
from typing import Any
from urllib.parse import unquote

import zenoh

from robocomp_dsl.runtime.component.callback_group import CallbackGroup
from robocomp_dsl.runtime.component.statistics import OperationCounts
from robocomp_dsl.runtime.connection.endpoint import Endpoint
from robocomp_dsl.runtime.connection.peer_selection import matches
from robocomp_dsl.runtime.connection.sequence import (
    MAX_RATE,
    SEQUENCE_FORMAT,
    SequenceTracker,
)
from robocomp_dsl.runtime.presence import keys

COUNT_TIMEOUT_S = 0.2
"""A publisher replies within a millisecond; one that hangs is not waited for."""
_ALL_REPLIES: dict[str, Any] = {
    "timeout": COUNT_TIMEOUT_S,
    "target": zenoh.QueryTarget.ALL,
    "consolidation": zenoh.ConsolidationMode.NONE,
}
SETTLE_S = 0.02
"""A message that has arrived is passed to its handler within this time, unless one is busy."""
MAX_PENDING = 32
"""Attachments are evaluated in batches: this takes a fifth of the time of one by one."""
MAX_UNKNOWN = 64
"""Publishers that have not announced themselves, and are remembered for the case that they do."""


class PublisherCounter:
    """The publishing side of one port: its id, and a counter for each operation."""

    def __init__(self, session: zenoh.Session, domain: str, at: Endpoint) -> None:
        self.id = secrets.randbits(64)
        self._prefix = keys.port_key(domain, "n", at)
        self._counters: dict[str, count[int]] = {}
        token = keys.PublisherToken(at.component, at.port, self.id, time.monotonic_ns())
        reply = zenoh.handlers.Callback(self._reply, indirect=False)
        self._queryable = session.declare_queryable(f"{self._prefix}/*", reply)
        self._token = session.liveliness().declare_token(token.key(domain))

    def counter(self, operation: str) -> count[int]:
        """The counter of an operation; `next` of it is safe in any thread."""
        return self._counters.setdefault(keys.escape_chunk(operation), count())

    def close(self) -> None:
        """Take back the announcement."""
        self._token.undeclare()
        self._queryable.undeclare()

    def _reply(self, query: zenoh.Query) -> None:
        with contextlib.suppress(zenoh.ZError):  # the session is closing
            for operation, counter in list(self._counters.items()):
                number = int(repr(counter)[len("count(") : -1])
                query.reply(f"{self._prefix}/{operation}", SEQUENCE_FORMAT.pack(self.id, number))
            query.drop()


class PublisherRegistry:
    """The publishers of a domain that have announced themselves.

    `created`: their ids, with the time of creation (monotonic clock of the machine, ns).
    """

    def __init__(self, session: zenoh.Session, domain: str) -> None:
        self._session = session
        self._domain = domain
        self.created: dict[int, int] = {}
        self.counts_at_discovery: dict[tuple[int, str], int] = {}
        self._loss_counters: list[LossCounter] = []
        self._closed = threading.Event()
        self._subscriber = session.liveliness().declare_subscriber(
            f"{keys.domain_prefix(domain)}/a/**", self._on_token, history=True
        )

    def _on_token(self, sample: zenoh.Sample) -> None:
        token = keys.parse_publisher_token(str(sample.key_expr))
        if token is None or sample.kind == zenoh.SampleKind.DELETE:
            return  # messages of a publisher that exited may still be in a queue
        self.created[token.id] = token.created
        key = keys.counts_key(self._domain, token.component, token.port)
        with contextlib.suppress(zenoh.ZError):  # the session is closing
            self._session.get(key, self._on_count, **_ALL_REPLIES)

    def _on_count(self, reply: zenoh.Reply) -> None:
        for published in _published_counts((reply,)):
            key = (published.publisher, published.operation)
            self.counts_at_discovery.setdefault(key, published.number)

    def loss_counter(
        self, at: Endpoint, counts: OperationCounts, execution: CallbackGroup
    ) -> LossCounter:
        """A new counter for an operation of `at`, which is subscribed to from now on."""
        self._loss_counters.append(LossCounter(at, counts, self, execution))
        return self._loss_counters[-1]

    def settle(self) -> None:
        """Ask all publishers for their numbers, and count what did not arrive in the end."""
        try:
            key = f"{keys.domain_prefix(self._domain)}/n/**"
            replies = list(self._session.get(key, **_ALL_REPLIES))
        except zenoh.ZError:  # the session is closing
            return
        current = list(_published_counts(replies))
        counters = list(self._loss_counters)
        calls = [counter.calls for counter in counters]
        # What arrived before the replies is passed to its handler in the meantime.
        self._closed.wait(SETTLE_S)
        for counter, calls_before in zip(counters, calls, strict=True):
            counter.settle(current, calls_before)

    def close(self) -> None:
        """End a `settle` that is waiting."""
        self._closed.set()


@dataclass(frozen=True, slots=True)
class PublishedCount:
    """How many messages a publisher has published in one operation."""

    publisher: int
    interface: str
    hash: str
    component: str
    port: str
    operation: str
    number: int


def _published_counts(replies: Iterable[zenoh.Reply]) -> Iterator[PublishedCount]:
    """The number in each valid reply."""
    for reply in replies:
        sample = reply.ok
        if sample is None:
            continue
        data, chunks = sample.payload.to_bytes(), str(sample.key_expr).split("/")
        if len(data) == SEQUENCE_FORMAT.size and len(chunks) == 8:
            publisher, number = SEQUENCE_FORMAT.unpack(data)
            interface, hash_, component, port = map(unquote, chunks[3:7])
            yield PublishedCount(publisher, interface, hash_, component, port, chunks[7], number)


class LossCounter:
    """Counts the losses of one operation of a subscribing port.

    `pending` receives the attachment of each message, which is all that a message costs; `process`
    evaluates them, and is called when there are more than `MAX_PENDING`.
    """

    def __init__(
        self,
        at: Endpoint,
        counts: OperationCounts,
        publishers: PublisherRegistry,
        execution: CallbackGroup,
    ) -> None:
        self._at = at
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
            if created is None or tracker.next > _most_published(created):
                continue
            if tracker.begin is None:
                tracker.begin = self._begin(publisher, created)
            lost += tracker.lost
        self._counts.drops += lost - self._reported
        self._reported = lost

    def _begin(self, publisher: int, created: int) -> int | None:
        """The number from which the messages of a publisher count; None if not known yet."""
        if created > self._subscribed:
            return 0
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


def _most_published(created: int) -> float:
    """The number of messages that a publisher can have published since its creation, in ns."""
    return MAX_RATE * (1 + (time.monotonic_ns() - created) / 1e9)
