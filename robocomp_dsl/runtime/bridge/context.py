"""What the expressions `now`, `counter` and `stamp(…)` mean while one message is built."""

from __future__ import annotations

from collections.abc import Mapping
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from robocomp_dsl.runtime.bridge.inputs import BridgedInput

NANOSECONDS = 1_000_000_000


class MessageContext:
    """The instant and the number of one message.

    `now_ns` is the same for all uses in the message, in ns since the epoch, or of simulated time.
    `counter` is the number of messages that this output has sent, from 0.
    """

    __slots__ = ("_inputs", "counter", "now_ns")

    def __init__(self, inputs: Mapping[str, BridgedInput]) -> None:
        self._inputs = inputs
        self.now_ns = 0
        self.counter = 0

    @property
    def now(self) -> float:
        """The instant in s."""
        return self.now_ns / NANOSECONDS

    def stamp(self, name: str) -> float:
        """The time stamp of the newest message of an input, in s."""
        newest = self._inputs[name].newest
        return newest.stamp if newest else 0.0

    def stamp_ns(self, name: str) -> int:
        """The time stamp of the newest message of an input, in ns."""
        return round(self.stamp(name) * NANOSECONDS)
