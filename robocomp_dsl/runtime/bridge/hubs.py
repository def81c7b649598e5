"""Hubs: which messages of several inputs belong together, by one of three policies.

In: messages, in order of arrival. Out: sets with one message of each input. A hub never blocks and
holds a bounded number of messages; what it drops is counted at the input, with the reason.
"""

from __future__ import annotations

from bisect import insort_right
from collections import deque
from collections.abc import Callable, Sequence
from dataclasses import dataclass
from operator import attrgetter
from typing import Any, TypeAlias

from robocomp_dsl.runtime.bridge.spec import HubSpec

QUEUE_LENGTH = 10
"""Messages that a hub with the policy `all` or `synchronised` holds for each input."""
JUMP_NS = 1_000_000_000
"""A time stamp that is so much older than the newest one: the clock of the sender was set back."""
QUEUE_FULL = "the other inputs of the hub are behind"
UNMATCHED = "no message of the other inputs has a time stamp within the tolerance"
SET_BACK = "the time stamps of the input jumped back"


@dataclass(slots=True)
class ReceivedMessage:
    """A message of an input: its time stamp in ns, and its arrival in s on the component's clock.

    `begun_ns` is the arrival on the clock of `time.perf_counter_ns`, for the latency.
    """

    value: Any
    stamp_ns: int
    arrival: float
    begun_ns: int


MessageSet: TypeAlias = tuple[ReceivedMessage, ...]
Drop: TypeAlias = Callable[[int, str], None]
"""Counts a dropped message of the input with this index in the hub, with the reason."""
_stamp = attrgetter("stamp_ns")
_NANOSECONDS = 1_000_000_000


class LatestHub:
    """The newest message of each input; a new set with each message after the first set."""

    uses_once = False

    def __init__(self, spec: HubSpec, _drop: Drop) -> None:
        self.spec = spec
        self.max_age = spec.max_age
        self.messages: MessageSet | None = None
        self._newest: list[ReceivedMessage | None] = [None] * len(spec.inputs)
        self._missing = len(spec.inputs)

    def add(self, index: int, message: ReceivedMessage) -> bool:
        """Take a message of an input; returns whether there is a new set."""
        if self._newest[index] is None:
            self._missing -= 1
        self._newest[index] = message
        if self._missing:
            return False
        self.messages = tuple(self._newest)  # type: ignore[arg-type]  # none is missing
        return True

    def missing(self) -> list[str]:
        """The inputs without a message."""
        return [
            name
            for name, message in zip(self.spec.inputs, self._newest, strict=True)
            if message is None
        ]


class QueueHub:
    """Base of the hubs that use every message at most once.

    `uses_once`: an output uses each set at most once, also at a rate.
    """

    uses_once = False

    def __init__(self, spec: HubSpec, drop: Drop) -> None:
        self.spec = spec
        self.max_age = spec.max_age
        self.messages: MessageSet | None = None
        self._drop = drop
        self._queues: list[deque[ReceivedMessage]] = [deque() for _ in spec.inputs]
        self._empty = len(spec.inputs)

    def missing(self) -> list[str]:
        """The inputs without a waiting message."""
        return [
            name for name, queue in zip(self.spec.inputs, self._queues, strict=True) if not queue
        ]

    def _take(self, index: int) -> ReceivedMessage:
        """Remove the oldest message of an input."""
        queue = self._queues[index]
        message = queue.popleft()
        self._empty += not queue
        return message

    def _take_set(self) -> None:
        self.messages = tuple([self._take(i) for i in range(len(self._queues))])


class AllHub(QueueHub):
    """The n-th message of each input, in order of arrival."""

    uses_once = True

    def add(self, index: int, message: ReceivedMessage) -> bool:
        """Take a message of an input; returns whether there is a new set."""
        queue = self._queues[index]
        if len(queue) == QUEUE_LENGTH:
            self._take(index)
            self._drop(index, QUEUE_FULL)
        self._empty -= not queue
        queue.append(message)
        if self._empty:
            return False
        self._take_set()
        return True


class SynchronisedHub(QueueHub):
    """One message of each input whose time stamps differ by the tolerance at most.

    Messages of an input may arrive out of order. A stamp that jumps back by more than `JUMP_NS`
    discards the newer messages of its input, as after a restart of a simulation.
    """

    def __init__(self, spec: HubSpec, drop: Drop) -> None:
        super().__init__(spec, drop)
        self.tolerance_ns = round(spec.tolerance * _NANOSECONDS)
        self._newest_stamp: list[int | None] = [None] * len(spec.inputs)

    def set_tolerance(self, seconds: float) -> None:
        """Change the tolerance in s."""
        self.tolerance_ns = round(seconds * _NANOSECONDS)

    def add(self, index: int, message: ReceivedMessage) -> bool:
        """Take a message of an input; returns whether there is a new set."""
        stamp = message.stamp_ns
        newest = self._newest_stamp[index]
        if newest is None or stamp > newest:
            self._newest_stamp[index] = stamp
        elif stamp < newest - max(JUMP_NS, 10 * self.tolerance_ns):
            self._discard_newer(index, stamp)
            self._newest_stamp[index] = stamp
        queue = self._queues[index]
        if len(queue) == QUEUE_LENGTH:
            self._take(index)
            self._drop(index, QUEUE_FULL)
        self._empty -= not queue
        if not queue or stamp >= queue[-1].stamp_ns:
            queue.append(message)
        else:
            insort_right(queue, message, key=_stamp)
        return self._match()

    def _discard_newer(self, index: int, stamp: int) -> None:
        queue = self._queues[index]
        while queue and queue[-1].stamp_ns > stamp:
            queue.pop()
            self._drop(index, SET_BACK)
            self._empty += not queue

    def _match(self) -> bool:
        """Form a set of the oldest messages that fit; drop older ones that cannot match."""
        while not self._empty:
            oldest = [queue[0].stamp_ns for queue in self._queues]
            limit = max(oldest) - self.tolerance_ns
            late = [index for index, stamp in enumerate(oldest) if stamp < limit]
            if not late:
                self._take_set()
                return True
            for index in late:
                self._take(index)
                self._drop(index, UNMATCHED)
        return False


Hub: TypeAlias = LatestHub | AllHub | SynchronisedHub
_HUBS: dict[str, type[LatestHub | AllHub | SynchronisedHub]] = {
    "latest": LatestHub,
    "all": AllHub,
    "synchronised": SynchronisedHub,
}


def hub_of(spec: HubSpec, drop: Drop) -> Hub:
    """The hub that a specification describes."""
    return _HUBS[spec.policy](spec, drop)


def age_of(messages: Sequence[ReceivedMessage], now: float) -> float:
    """The age in s of the oldest message of a set, `now` on the component's clock."""
    return now - min(message.arrival for message in messages)
