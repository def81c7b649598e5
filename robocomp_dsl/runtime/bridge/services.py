"""One service of a bridge: calls other services and builds the reply.

A failure is counted and reported, and passed on: the caller receives it.
"""

from __future__ import annotations

from collections.abc import Callable
from time import perf_counter_ns
from typing import Any

from robocomp_dsl.runtime.bridge.context import MessageContext
from robocomp_dsl.runtime.bridge.counts import BridgeCounts, LossReport
from robocomp_dsl.runtime.bridge.failures import NOT_SENT, describe_failure
from robocomp_dsl.runtime.bridge.spec import ServiceSpec
from robocomp_dsl.runtime.errors import DeclaredError, ReportedFailure

CALL_FAILED = "a call failed"


class BridgedService:
    """The service; `create_context` returns a new context, because calls may overlap."""

    def __init__(
        self,
        spec: ServiceSpec,
        worker: object,
        create_context: Callable[[int], MessageContext],
        losses: LossReport,
    ) -> None:
        self.spec = spec
        self.counts: BridgeCounts = losses.counts
        self._worker = worker
        self._create_context = create_context
        self._losses = losses

    def answer(self, *arguments: Any) -> Any:
        """Answer a request. Raises declared errors of called services, else `ReportedFailure`."""
        begun = perf_counter_ns()
        context = self._create_context(self.counts.messages)
        self.counts.messages += 1
        try:
            reply = self.spec.answer(context, self._worker, *arguments)
        except DeclaredError:
            raise
        except Exception as error:
            failure = describe_failure(error, context.field, self.spec.places)
            reason = CALL_FAILED if failure.reason == NOT_SENT else failure.reason
            self._losses.lose_reply(reason, failure.text, failure.place)
            raise ReportedFailure(f"{failure.text} ({failure.place})") from error
        self.counts.add_latency(perf_counter_ns() - begun)
        return reply
