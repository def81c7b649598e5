"""Queue of a reliable subscription: a full queue holds its publishers, for a limited time.

In: samples from a receive thread of zenoh. Out: the samples, in order. A subscriber that takes
nothing for `hold_s` seconds gets no more samples until its queue has room again; the sequence
numbers count what it lost. Held for longer, the receive thread could not serve other links: peers
would take the process for dead after 10 s.
"""

from __future__ import annotations

from queue import SimpleQueue
from threading import Semaphore

import zenoh

from robocomp_dsl.runtime.component.receiver import QueueClosed

HOLD_S = 1.0
"""How long a subscriber that takes nothing may hold its publishers."""


class ReliableQueue:
    """Queue of at most `depth` samples."""

    def __init__(self, depth: int, hold_s: float) -> None:
        self._hold_s = hold_s
        self._room = Semaphore(depth)
        self._samples: SimpleQueue[zenoh.Sample | None] = SimpleQueue()
        self._is_stalled = self._is_closed = False

    def put(self, sample: zenoh.Sample) -> None:
        """Wait for room, and add `sample`; drop it if the subscriber takes nothing."""
        has_room = self._room.acquire(timeout=0.0 if self._is_stalled else self._hold_s)
        self._is_stalled = not has_room
        if has_room and not self._is_closed:
            self._samples.put(sample)

    def take(self) -> zenoh.Sample:
        """The next sample. Raises `QueueClosed`."""
        sample = self._samples.get()
        if sample is None:
            self._samples.put(None)  # for the other threads of the subscription
            raise QueueClosed
        self._room.release()
        return sample

    def close(self) -> None:
        """End `put` and `take`, also those that wait."""
        self._is_closed = self._is_stalled = True
        self._room.release()
        self._samples.put(None)
