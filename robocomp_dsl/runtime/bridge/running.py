"""A running bridge: inputs, hubs and outputs of one component, connected by its specification.

In: messages of the component's subscribed ports, and calls of `send_due` on the component's clock.
Out: calls of the component's proxies. The component runs one callback at a time, so nothing here
needs a lock.
"""

from __future__ import annotations

import logging
import time
from collections.abc import Callable
from typing import Any, Protocol

from robocomp_dsl.runtime.bridge.context import NANOSECONDS, MessageContext
from robocomp_dsl.runtime.bridge.counts import BridgeCounts, LossReport
from robocomp_dsl.runtime.bridge.hubs import Hub, SynchronisedHub, hub_of
from robocomp_dsl.runtime.bridge.inputs import BridgedInput
from robocomp_dsl.runtime.bridge.outputs import BridgedOutput
from robocomp_dsl.runtime.bridge.schedule import RateSchedule
from robocomp_dsl.runtime.bridge.spec import BridgeSpec, HubSpec, OutputSpec
from robocomp_dsl.runtime.clock import Clock, WallClock
from robocomp_dsl.runtime.component.statistics import Statistics


class BridgeHost(Protocol):
    """What a bridge needs of its worker."""

    clock: Clock
    log: logging.Logger


class RunningBridge:
    """The bridge of one worker.

    `publish` has the publishing function of each output by name; `message_stamp` returns the time
    stamp in s of the message that a handler handles.
    """

    def __init__(
        self,
        spec: BridgeSpec,
        worker: BridgeHost,
        publish: dict[str, Callable[..., None]],
        message_stamp: Callable[[], float] = time.time,
        statistics: Statistics | None = None,
    ) -> None:
        self.spec = spec
        self._log = worker.log
        self._now = worker.clock.now
        is_wall = isinstance(worker.clock, WallClock)
        self._now_ns = time.time_ns if is_wall else self._simulated_ns
        self._statistics = statistics or Statistics()
        self.inputs = {
            s.name: BridgedInput(s, BridgeCounts(), self._now, message_stamp) for s in spec.inputs
        }
        self._losses = {
            s.name: LossReport(
                f"input `{s.name}`",
                self.inputs[s.name].counts,
                self._statistics.of(s.port, s.operation),
                self._log,
            )
            for s in spec.inputs
        }
        self.hubs = {s.name: self._hub(s) for s in spec.hubs}
        self.outputs = {s.name: self._output(s, worker, publish[s.name]) for s in spec.outputs}
        self.schedule = RateSchedule({s.name: s.rate for s in spec.outputs})
        self._connect()

    def _simulated_ns(self) -> int:
        return round(self._now() * NANOSECONDS)

    def _hub(self, spec: HubSpec) -> Hub:
        def drop(index: int, reason: str) -> None:
            name = spec.inputs[index]
            self._losses[name].lose_input(f"hub `{spec.name}`: {reason}", spec.place)

        return hub_of(spec, drop)

    def _output(
        self, spec: OutputSpec, worker: BridgeHost, publish: Callable[..., None]
    ) -> BridgedOutput:
        counts = BridgeCounts()
        operation = self._statistics.of(spec.port, spec.operation)
        return BridgedOutput(
            spec,
            [self.hubs[name] for name in spec.hubs],
            publish,
            worker,
            MessageContext(self.inputs),
            counts,
            operation,
            LossReport(f"output `{spec.name}`", counts, operation, self._log),
            self._now,
            self._now_ns,
        )

    def _connect(self) -> None:
        """Connect inputs to hubs; a hub is followed by the outputs that have no rate."""
        for hub in self.hubs.values():
            used = tuple(
                output for output in self.outputs.values() if hub.spec.name in output.spec.hubs
            )
            for index, name in enumerate(hub.spec.inputs):
                self.inputs[name].connect(hub, index, used)

    def set_rate(self, output: str, rate: float) -> float:
        """Change the rate of an output in Hz, 0: when its inputs are complete.

        Returns the period in ms in which `send_due` must be called from now on.
        """
        self.schedule.set_rate(output, rate)
        self.outputs[output].is_scheduled = rate > 0
        return self.schedule.period_ms

    def set_max_age(self, hub: str, seconds: float) -> None:
        """Change the maximum age of the messages of a hub in s; 0: no limit."""
        self.hubs[hub].max_age = seconds

    def set_tolerance(self, hub: str, seconds: float) -> None:
        """Change the tolerance of a synchronised hub in s."""
        found = self.hubs[hub]
        if isinstance(found, SynchronisedHub):
            found.tolerance = seconds

    def send_due(self) -> None:
        """Send the outputs that are due."""
        for name in self.schedule.due(self._now()):
            self.outputs[name].send()

    def summary(self) -> list[str]:
        """The counts of all inputs and outputs, a line each."""
        inputs = (f"input `{n}`: {i.counts.summary('received')}" for n, i in self.inputs.items())
        outputs = (f"output `{n}`: {o.counts.summary('sent')}" for n, o in self.outputs.items())
        return [*inputs, *outputs]

    def log_summary(self) -> None:
        """Log the counts."""
        for line in self.summary():
            self._log.info("%s", line)

    def counts(self) -> dict[str, Any]:
        """The counts of inputs and outputs by name."""
        ports = {**self.inputs, **self.outputs}
        return {name: port.counts for name, port in ports.items()}
