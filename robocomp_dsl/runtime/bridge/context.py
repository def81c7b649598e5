"""What the expressions `now`, `counter` and `stamp(…)` mean while one message is built."""

from __future__ import annotations

from collections.abc import Mapping
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from robocomp_dsl.runtime.bridge.inputs import BridgedInput

NANOSECONDS = 1_000_000_000


class MessageContext:
    """The instant and the number of one message, and the field that is being assigned.

    `now_ns` is the same for all uses in the message, in ns since the epoch, or of simulated time.
    `counter` is the number of messages that this output has sent, from 0. `field` is the path of
    the field or the name of the hub that is being computed, for messages about errors.
    """

    __slots__ = ("_inputs", "counter", "field", "now_ns")

    def __init__(self, inputs: Mapping[str, BridgedInput]) -> None:
        self._inputs = inputs
        self.now_ns = 0
        self.counter = 0
        self.field = ""

    def begin(self, now_ns: int, counter: int) -> None:
        """Begin a message."""
        self.now_ns = now_ns
        self.counter = counter
        self.field = ""

    def stamp_ns(self, name: str) -> int:
        """The time stamp of the newest message of an input, in ns."""
        newest = self._inputs[name].newest
        return newest.stamp_ns if newest else 0
