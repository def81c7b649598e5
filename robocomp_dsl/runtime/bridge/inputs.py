"""One input of a bridge: stamps a message and passes it to the hubs that use the input."""

from __future__ import annotations

from collections.abc import Callable
from time import perf_counter_ns
from typing import Any, Protocol

from robocomp_dsl.runtime.bridge.counts import BridgeCounts, LossReport
from robocomp_dsl.runtime.bridge.errors import DoesNotFit
from robocomp_dsl.runtime.bridge.hubs import ReceivedMessage
from robocomp_dsl.runtime.bridge.outputs import BridgedOutput
from robocomp_dsl.runtime.bridge.spec import InputSpec

NOT_FITTING = "the message does not fit its type"


class MessageTaker(Protocol):
    """A hub, or what else takes the messages of inputs."""

    def add(self, index: int, message: ReceivedMessage) -> bool:
        """Take a message of an input; returns whether outputs can be sent."""


class BridgedInput:
    """The input and its newest message.

    `now` is the component's clock in s; `message_stamp` returns the time stamp in ns of the message
    that is being handled.
    """

    def __init__(
        self,
        spec: InputSpec,
        counts: BridgeCounts,
        losses: LossReport,
        now: Callable[[], float],
        message_stamp: Callable[[], int],
    ) -> None:
        self.spec = spec
        self.counts = counts
        self.losses = losses
        self.newest: ReceivedMessage | None = None
        self._now = now
        self._stamp = spec.stamp
        self._needs_stamp = spec.needs_stamp
        self._message_stamp = message_stamp
        self._hubs: list[tuple[MessageTaker, int, tuple[BridgedOutput, ...]]] = []

    def connect(self, hub: MessageTaker, index: int, outputs: tuple[BridgedOutput, ...]) -> None:
        """Pass messages to a hub, as its input `index`; `outputs` are sent when it is ready."""
        self._hubs.append((hub, index, outputs))

    def receive(self, value: Any) -> None:
        """Take a message, and send the outputs whose inputs are complete now.

        The value of an operation with several parameters is the tuple of them.
        """
        begun = perf_counter_ns()
        self.counts.messages += 1
        stamp = 0
        try:
            if self.spec.check is not None:
                self.spec.check(value)
            if self._needs_stamp:
                stamp = self._stamp(value) if self._stamp else self._message_stamp()
        except DoesNotFit as error:
            self.losses.lose_input(NOT_FITTING, self.spec.place, str(error))
            return
        message = ReceivedMessage(value, stamp, self._now(), begun)
        self.newest = message
        if len(self._hubs) == 1:
            hub, index, outputs = self._hubs[0]
            if hub.add(index, message):
                for output in outputs:
                    output.send(message)
            return
        # All hubs get the message before an output is sent: an output may use several of them.
        ready: dict[BridgedOutput, None] = {}
        for hub, index, outputs in self._hubs:
            if hub.add(index, message):
                ready |= dict.fromkeys(outputs)
        for output in ready:
            output.send(message)
