"""What a bridge counts, and how it reports losses: each kind at once, then once per interval.

In: dropped messages with the reason. Out: counts by input and output, and lines of the log.
"""

from __future__ import annotations

import logging
from collections import Counter
from dataclasses import dataclass, field

from robocomp_dsl.runtime.component.statistics import OperationCounts
from robocomp_dsl.runtime.component.throttle import Throttle


@dataclass(slots=True)
class BridgeCounts:
    """The counts of one input or output of a bridge.

    `messages`: received by an input, sent by an output. `dropped` is by reason. Latencies in ns,
    from the arrival of the message that caused a sending to the end of the sending.
    """

    messages: int = 0
    dropped: Counter[str] = field(default_factory=Counter)
    latency_total_ns: int = 0
    latency_max_ns: int = 0
    latencies: int = 0
    dropped_inputs: int = 0

    def add_latency(self, nanoseconds: int) -> None:
        """Count the latency of one message."""
        self.latencies += 1
        self.latency_total_ns += nanoseconds
        self.latency_max_ns = max(self.latency_max_ns, nanoseconds)

    @property
    def latency_mean_ms(self) -> float:
        """The mean latency in ms; 0.0 without any."""
        return self.latency_total_ns / self.latencies / 1e6 if self.latencies else 0.0

    def summary(self, verb: str, lost: str = "dropped") -> str:
        """`12 sent, 3 dropped (reason: 3), latency mean 0.1 ms, max 0.4 ms`."""
        parts = [f"{self.messages} {verb}"]
        if self.dropped:
            reasons = "; ".join(f"{reason}: {n}" for reason, n in self.dropped.items())
            parts.append(f"{self.dropped.total()} {lost} ({reasons})")
        if self.latencies:
            parts.append(
                f"latency mean {self.latency_mean_ms:.3f} ms,"
                f" max {self.latency_max_ns / 1e6:.3f} ms"
            )
        return ", ".join(parts)


def transport_losses(operation: OperationCounts, counts: BridgeCounts) -> str:
    """What the middleware lost of the messages of a port: `, 3 malformed, 7 lost`; may be empty."""
    lost = operation.drops + operation.missed - counts.dropped_inputs
    parts = [f", {operation.malformed} malformed"] if operation.malformed else []
    return "".join([*parts, f", {lost} lost by the middleware"] if lost > 0 else parts)


class LossReport:
    """Counts and reports the losses of one input, output or service.

    The same loss at the same place is logged once per interval. `what` names the port in messages,
    as in ``input `left` ``; `operation` has the counts that `rcdeploy stats` shows.
    """

    def __init__(self, what: str, operation: OperationCounts, log: logging.Logger) -> None:
        self.counts = BridgeCounts()
        self._what = what
        self._operation = operation
        self._log = log
        self._throttle = Throttle()

    def lose_input(self, reason: str, place: str, text: str = "") -> None:
        """Count a received message that no output will use."""
        self._operation.drops += 1
        self.counts.dropped_inputs += 1
        self._report("dropped", reason, text or reason, place)

    def lose_output(self, reason: str, text: str, place: str) -> None:
        """Count a message that was not sent; `text` has the details for the log."""
        self._operation.failures += 1
        self._report("not sent", reason, text, place)

    def lose_reply(self, reason: str, text: str, place: str) -> None:
        """Count a request that failed; the port counts the failure itself."""
        self._report("failed", reason, text, place)

    def _report(self, verb: str, reason: str, text: str, place: str) -> None:
        count = self.counts.dropped[reason] + 1
        self.counts.dropped[reason] = count
        if self._throttle.allows(f"{reason} {place}"):
            so_far = f"; {count} so far" if count > 1 else ""
            self._log.warning("%s: %s: %s (%s)%s", self._what, verb, text, place, so_far)
