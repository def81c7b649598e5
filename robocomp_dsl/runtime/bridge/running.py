"""A running bridge: inputs, hubs and outputs of one component, connected by its specification.

In: messages of the component's subscribed ports, and calls of `send_due` on the component's clock.
Out: calls of the component's proxies. The component runs one callback at a time, so nothing here
needs a lock.
"""

from __future__ import annotations

import logging
import time
from collections.abc import Callable, Mapping
from typing import Protocol

from robocomp_dsl.runtime.bridge.actions import STATUS_RATE, BridgedAction
from robocomp_dsl.runtime.bridge.context import NANOSECONDS, MessageContext
from robocomp_dsl.runtime.bridge.counts import BridgeCounts, LossReport, transport_losses
from robocomp_dsl.runtime.bridge.hubs import Hub, SynchronisedHub, hub_of
from robocomp_dsl.runtime.bridge.inputs import BridgedInput
from robocomp_dsl.runtime.bridge.outputs import BridgedOutput
from robocomp_dsl.runtime.bridge.schedule import RateSchedule
from robocomp_dsl.runtime.bridge.services import BridgedService
from robocomp_dsl.runtime.bridge.spec import (
    ActionSpec,
    BridgeSpec,
    HubSpec,
    InputSpec,
    OutputSpec,
    ServiceSpec,
)
from robocomp_dsl.runtime.clock import Clock, WallClock
from robocomp_dsl.runtime.component.lifecycle import Lifecycle
from robocomp_dsl.runtime.component.statistics import Statistics
from robocomp_dsl.runtime.connection.message_stamp import message_stamp


def _message_stamp_ns() -> int:
    return message_stamp().time_ns


class CountedPort(Protocol):
    """An input, output or service."""

    @property
    def counts(self) -> BridgeCounts:
        """What it counts."""

    @property
    def spec(self) -> InputSpec | OutputSpec | ServiceSpec:
        """Its port and operation."""


class BridgeHost(Protocol):
    """What a bridge needs of its worker."""

    clock: Clock
    log: logging.Logger
    _lifecycle: Lifecycle


class RunningBridge:
    """The bridge of one worker.

    `publish` has the publishing function of each output by name; `statistics` None: those of the
    component. `message_stamp` returns the time stamp in ns of the message that a handler handles.
    """

    def __init__(
        self,
        spec: BridgeSpec,
        worker: BridgeHost,
        publish: dict[str, Callable[..., None]],
        statistics: Statistics | None = None,
        message_stamp: Callable[[], int] = _message_stamp_ns,
    ) -> None:
        self.spec = spec
        self._worker = worker
        self._log = worker.log
        self._now = worker.clock.now
        is_wall = isinstance(worker.clock, WallClock)
        self._now_ns = time.time_ns if is_wall else self._simulated_ns
        self._statistics = statistics or worker._lifecycle.statistics
        self.inputs = {s.name: self._input(s, message_stamp) for s in spec.inputs}
        self.hubs = {s.name: self._hub(s) for s in spec.hubs}
        self.outputs = {s.name: self._output(s, publish[s.name]) for s in spec.outputs}
        self.services = {s.name: self._service(s) for s in spec.services}
        self.actions = {s.name: self._action(s, publish) for s in spec.actions}
        rates = {s.name: s.rate for s in spec.outputs}
        self.schedule = RateSchedule(rates | dict.fromkeys(self.actions, STATUS_RATE))
        self._connect()

    def _stamp_ns(self, name: str) -> int:
        """The time stamp of the newest message of an input, in ns; 0 without any."""
        newest = self.inputs[name].newest
        return newest.stamp_ns if newest else 0

    def _simulated_ns(self) -> int:
        return round(self._now() * NANOSECONDS)

    def _losses(self, what: str, spec: InputSpec | OutputSpec | ServiceSpec) -> LossReport:
        operation = self._statistics.of(spec.port, spec.operation)
        operation.place = spec.place
        return LossReport(f"{what} `{spec.name}`", operation, self._log)

    def _input(self, spec: InputSpec, message_stamp: Callable[[], int]) -> BridgedInput:
        losses = self._losses("input", spec)
        return BridgedInput(spec, losses.counts, losses, self._now, message_stamp)

    def _hub(self, spec: HubSpec) -> Hub:
        def drop(index: int, reason: str) -> None:
            losses = self.inputs[spec.inputs[index]].losses
            losses.lose_input(reason, spec.place, f"hub `{spec.name}`: {reason}")

        return hub_of(spec, drop)

    def _output(self, spec: OutputSpec, publish: Callable[..., None]) -> BridgedOutput:
        return BridgedOutput(
            spec,
            [self.hubs[name] for name in spec.hubs],
            publish,
            self._worker,
            MessageContext(self._stamp_ns),
            self._losses("output", spec),
            self._statistics.of(spec.port, spec.operation),
            self._now,
            self._now_ns,
        )

    def _service(self, spec: ServiceSpec) -> BridgedService:
        def create_context(counter: int) -> MessageContext:
            context = MessageContext(self._stamp_ns)
            context.begin(self._now_ns(), counter)
            return context

        return BridgedService(spec, self._worker, create_context, self._losses("service", spec))

    def _action(
        self, spec: ActionSpec, publish: Mapping[str, Callable[..., None]]
    ) -> BridgedAction:
        operation = self._statistics.of(spec.result.port, spec.result.operation)
        losses = LossReport(f"action `{spec.name}`", operation, self._log)
        context = MessageContext(self._stamp_ns)
        return BridgedAction(
            spec, self._worker, publish, context, losses, self._log, self._now, self._now_ns
        )

    def _connect(self) -> None:
        """Connect inputs to hubs; a hub is followed by the outputs that have no rate."""
        for action in self.actions.values():
            for name, taker in action.connections().items():
                self.inputs[name].connect(taker, 0, ())
        for hub in self.hubs.values():
            name = hub.spec.name
            used = () if hub.spec.is_passive else self._users(name)
            for index, input_name in enumerate(hub.spec.inputs):
                self.inputs[input_name].connect(hub, index, used)

    def _users(self, hub: str) -> tuple[BridgedOutput, ...]:
        """The outputs that use a hub."""
        return tuple(output for output in self.outputs.values() if hub in output.spec.hubs)

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
            found.set_tolerance(seconds)

    def send_due(self) -> None:
        """Send the outputs and the states of actions that are due."""
        for name in self.schedule.due(self._now()):
            if name in self.outputs:
                self.outputs[name].send()
            else:
                self.actions[name].tick()

    def summary(self) -> list[str]:
        """The counts of all inputs, outputs, services and actions, a line each."""
        kinds: tuple[tuple[str, str, str, Mapping[str, CountedPort]], ...] = (
            ("input", "received", "dropped", self.inputs),
            ("output", "sent", "not sent", self.outputs),
            ("service", "requests", "failed", self.services),
        )
        lines = [
            f"{kind} `{name}`: {port.counts.summary(verb, lost)}{self._transport_losses(port)}"
            for kind, verb, lost, ports in kinds
            for name, port in ports.items()
        ]
        for name, action in self.actions.items():
            lines.append(f"action `{name}`: {action.counts.summary('goals')}")
        return lines

    def _transport_losses(self, port: CountedPort) -> str:
        operation = self._statistics.of(port.spec.port, port.spec.operation)
        return transport_losses(operation, port.counts)

    def log_summary(self) -> None:
        """Log the counts."""
        for line in self.summary():
            self._log.info("%s", line)
