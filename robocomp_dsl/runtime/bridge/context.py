"""What the expressions `now`, `counter` and `stamp(…)` mean while one message is built."""

from __future__ import annotations

from collections.abc import Callable

NANOSECONDS = 1_000_000_000


class MessageContext:
    """The instant and the number of one message, and the field that is being assigned.

    `now_ns` is the same for all uses in the message, in ns since the epoch, or of simulated time.
    `counter` is the number of messages that this output has sent, from 0. `field` is the path of
    the field or the name of the hub that is being computed, for messages about errors.
    `stamp_ns(name)` is the time stamp of the newest message of an input, in ns.
    """

    __slots__ = ("counter", "field", "now_ns", "stamp_ns")

    def __init__(self, stamp_ns: Callable[[str], int]) -> None:
        self.stamp_ns = stamp_ns
        self.now_ns = 0
        self.counter = 0
        self.field = ""

    def begin(self, now_ns: int, counter: int) -> None:
        """Begin a message."""
        self.now_ns = now_ns
        self.counter = counter
        self.field = ""
