"""One output of a bridge: builds a message from sets of messages and publishes it.

Whatever goes wrong with one message is counted and reported, and the bridge continues.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from time import perf_counter_ns
from typing import Any

from robocomp_dsl.runtime.bridge.context import MessageContext
from robocomp_dsl.runtime.bridge.counts import BridgeCounts, LossReport
from robocomp_dsl.runtime.bridge.errors import DoesNotFit
from robocomp_dsl.runtime.bridge.hubs import Hub, ReceivedMessage, age_of
from robocomp_dsl.runtime.bridge.spec import OutputSpec
from robocomp_dsl.runtime.component.statistics import OperationCounts
from robocomp_dsl.runtime.component.user_errors import describe_error
from robocomp_dsl.runtime.errors import EncodeError, MiddlewareError

TOO_OLD = "older than max_age"
NOT_FITTING = "a value does not fit"
NOT_SENT = "the middleware could not send it"
FAILED = "building it failed"


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
        counts: BridgeCounts,
        operation: OperationCounts,
        losses: LossReport,
        now: Callable[[], float],
        now_ns: Callable[[], int],
    ) -> None:
        self.spec = spec
        self.counts = counts
        self.is_scheduled = spec.rate > 0
        self._hubs = tuple(hubs)
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
        sets = []
        for hub in self._hubs:
            messages = hub.messages
            if messages is None:
                return False
            if hub.max_age and age_of(messages, self._now()) > hub.max_age:
                self._report_age(hub)
                return False
            sets.append(messages)
        context = self._context
        context.now_ns = self._now_ns()
        context.counter = self.counts.messages
        try:
            self._publish(*self._build(context, self._worker, *sets))
        except Exception as error:
            self._report(error)
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
            lambda: (
                f"the newest message of `{oldest}` is {ages[oldest]:.3g} s old, max_age of"
                f" `{hub.spec.name}` is {hub.max_age:g} s"
            ),
            hub.spec.place,
        )

    def _report(self, error: Exception) -> None:
        if isinstance(error, DoesNotFit | EncodeError):
            path = error.path
            self._losses.lose_output(
                NOT_FITTING, lambda: str(error), self._place(path.removeprefix("message."))
            )
        elif isinstance(error, MiddlewareError):
            self._losses.lose_output(NOT_SENT, lambda: str(error), self._place(""))
        else:
            self._losses.lose_output(FAILED, lambda: describe_error(error), self._place(""))

    def _place(self, path: str) -> str:
        """The place of the assignment of the field `path`, or of a field that contains it."""
        places = self.spec.places
        while path and path not in places:
            path = path[: max(path.rfind("."), path.rfind("["), 0)]
        return places.get(path, "")


