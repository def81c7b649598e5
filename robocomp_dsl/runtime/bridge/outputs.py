"""One output of a bridge: builds a message from sets of messages and publishes it.

Whatever goes wrong with one message is counted and reported, and the bridge continues.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from time import perf_counter_ns
from typing import Any

from robocomp_dsl.runtime.bridge.context import MessageContext
from robocomp_dsl.runtime.bridge.counts import BridgeCounts, LossReport
from robocomp_dsl.runtime.bridge.failures import describe_failure
from robocomp_dsl.runtime.bridge.hubs import Hub, MessageSet, ReceivedMessage, age_of
from robocomp_dsl.runtime.bridge.spec import OutputSpec
from robocomp_dsl.runtime.component.statistics import OperationCounts

TOO_OLD = "older than max_age"


class BridgedOutput:
    """The output; `publish` takes the arguments of its operation, `worker` is the user's object.

    `now` is the component's clock in s, `now_ns` the instant that messages contain.
    """

    def __init__(
        self,
        spec: OutputSpec,
        hubs: Sequence[Hub],
        publish: Callable[..., None],
        worker: object,
        context: MessageContext,
        losses: LossReport,
        operation: OperationCounts,
        now: Callable[[], float],
        now_ns: Callable[[], int],
    ) -> None:
        self.spec = spec
        self.counts: BridgeCounts = losses.counts
        self.is_scheduled = spec.rate > 0
        self._hubs = tuple(hubs)
        self._used: list[MessageSet | None] = [None] * len(self._hubs)
        self._publish = publish
        self._build = spec.build
        self._worker = worker
        self._context = context
        self._operation = operation
        self._losses = losses
        self._now = now
        self._now_ns = now_ns

    def send(self, cause: ReceivedMessage | None = None) -> bool:
        """Build and publish a message if all hubs are ready; returns whether it was published.

        `cause` is the message whose arrival caused it, which no output with a rate follows; None:
        it was due.
        """
        if cause is not None and self.is_scheduled:
            return False
        sets: list[tuple[Any, ...]] = []
        found: list[MessageSet | None] = []
        for hub, used in zip(self._hubs, self._used, strict=True):
            messages = hub.messages
            if messages is None or (hub.uses_once and messages is used):
                return False
            if hub.max_age and age_of(messages, self._now()) > hub.max_age:
                self._report_age(hub)
                return False
            found.append(messages)
            sets.append(tuple([message.value for message in messages]))
        self._used = found
        context = self._context
        context.begin(self._now_ns(), self.counts.messages)
        try:
            self._publish(*self._build(context, self._worker, *sets))
        except Exception as error:
            failure = describe_failure(error, context.field, self.spec.places)
            self._losses.lose_output(failure.reason, failure.text, failure.place)
            return False
        self.counts.messages += 1
        if cause is not None:
            latency = perf_counter_ns() - cause.begun_ns
            self.counts.add_latency(latency)
            self._operation.durations.add(latency)
        return True

    def _report_age(self, hub: Hub) -> None:
        messages = hub.messages or ()
        now = self._now()
        ages = {
            name: now - message.arrival
            for name, message in zip(hub.spec.inputs, messages, strict=True)
        }
        oldest = max(ages, key=ages.__getitem__)
        self._losses.lose_output(
            TOO_OLD,
            f"the newest message of `{oldest}` is {ages[oldest]:.3g} s old, max_age of"
            f" `{hub.spec.name}` is {hub.max_age:g} s",
            hub.spec.place,
        )
