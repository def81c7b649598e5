"""Sequence numbers of publications, and what a subscriber concludes from them.

In: the attachment of each message: the id of its publisher and the number of messages that it
published before in this operation (8 bytes each, little endian). Out: the number of lost messages.

Any program of the domain can publish anything. A number counts only if the publisher has announced
its id, if it lies within what can have been published, and if the following messages agree.
"""

from __future__ import annotations

import time

MAX_RATE = 1_000_000
"""Messages per second; a gap is not longer than what can have been published since."""
MAX_LISTED_GAP = 1024
"""The numbers of shorter gaps are listed; their messages may come late."""
MAX_LATE = 4096
"""Listed numbers of one publisher; then the oldest are lost for good."""
CONFIRMATIONS = 8
"""A long gap can be taken back until so many messages have followed it in order."""


class SequenceTracker:
    """The numbers of one operation of one publisher.

    `next` is the number that is expected; `begin` the one from which messages count, if known;
    `unconfirmed` the state before a long gap that the following messages have to confirm.
    """

    __slots__ = (
        "_confirmations",
        "_first",
        "_gaps",
        "_late",
        "_start",
        "begin",
        "next",
        "unconfirmed",
    )

    def __init__(self, first: int, *, has_arrived: bool = True) -> None:
        self._restart(first)
        self.next = first + has_arrived
        self.begin: int | None = None
        self._start = time.monotonic()

    def _restart(self, first: int) -> None:
        self._first = first
        self.next = first + 1
        self._gaps = 0
        self._late: dict[int, None] = {}
        self.unconfirmed: tuple[int, int] | None = None
        self._confirmations = 0

    @property
    def first(self) -> int:
        """The number of the first message."""
        return self._first

    @property
    def lost(self) -> int:
        """Messages that did not arrive."""
        before = 0 if self.begin is None else max(0, self._first - self.begin)
        return before + self._gaps

    def accept(self, number: int) -> None:
        """Record the number of a message that has arrived."""
        if number < self.next:
            self._accept_late(number)
            return
        gap = number - self.next
        if not self._is_plausible(gap):
            return
        if self.unconfirmed is not None:
            self._confirmations += 1
            if self._confirmations >= CONFIRMATIONS:
                self.unconfirmed = None
        if gap > MAX_LISTED_GAP and self.unconfirmed is None:
            self.unconfirmed, self._confirmations = (self.next, self._gaps), 0
        self._advance(number, gap)
        self.next = number + 1

    def _advance(self, number: int, gap: int) -> None:
        """Count the numbers before `number` as lost."""
        if gap > MAX_LISTED_GAP:
            self._late.clear()
        elif gap:
            self._late |= dict.fromkeys(range(self.next, number))
            while len(self._late) > MAX_LATE:
                del self._late[next(iter(self._late))]
        self._gaps += gap
        self.next = number

    def _accept_late(self, number: int) -> None:
        """A message that two threads published in another order, or after a forged number."""
        if number in self._late:
            del self._late[number]
            self._gaps -= 1
        elif self.unconfirmed is not None and number >= self.unconfirmed[0]:
            self.next, self._gaps = self.unconfirmed
            self.unconfirmed = None
            self.accept(number)
        elif self.next == self._first + 1 and number < self._first:
            self._restart(number)

    def _is_plausible(self, gap: int) -> bool:
        """Whether so many messages can have been published since the first one."""
        return gap < MAX_RATE or gap < MAX_RATE * (1 + time.monotonic() - self._start)

    def settle(self, count: int) -> None:
        """The publisher has published `count` messages, and no more of them are on the way."""
        gap = count - self.next
        if gap > 0 and self._is_plausible(gap):
            self._advance(count, gap)
