"""The serving side: handlers answer queries and commands, and receive publications.

In: a port, its handlers, the callback group. Out: queryables and subscribers, each with a channel
that one thread drains. A callback would take the interpreter lock from a foreign thread for every
message: measured 1.3 times slower, with a fifth of the throughput.

Code that runs for every message uses local names and is inlined: the thread has just been woken,
its caches are cold, and each line costs five times what it costs in a loop.
"""

from __future__ import annotations

from collections import deque
from collections.abc import Callable, Mapping
from threading import get_ident
from time import perf_counter_ns
from typing import Any, TypeAlias

import zenoh

from robocomp_dsl.runtime.codec.failures import encode_failure
from robocomp_dsl.runtime.component.callback_group import CallbackGroup
from robocomp_dsl.runtime.component.interface import Operation, Pattern
from robocomp_dsl.runtime.component.naming import ANY, on_same_branch
from robocomp_dsl.runtime.component.receiver import LeaderFollowerQueue
from robocomp_dsl.runtime.component.statistics import TIMING_INTERVAL, OperationCounts
from robocomp_dsl.runtime.component.user_errors import log_failure
from robocomp_dsl.runtime.connection.endpoint import Endpoint
from robocomp_dsl.runtime.connection.losses import (
    MAX_PENDING,
    LossCounter,
    PublisherRegistry,
)
from robocomp_dsl.runtime.connection.peer_selection import log, with_deadline_check
from robocomp_dsl.runtime.connection.ports import ComponentContext, OperationCallable
from robocomp_dsl.runtime.errors import EncodeError, MalformedMessage
from robocomp_dsl.runtime.middleware.zenoh.reliable_queue import ReliableQueue
from robocomp_dsl.runtime.presence import keys

DEPTH = 256
"""Default queue length."""

QueryHandler: TypeAlias = Callable[[zenoh.Query, str], None]
SampleHandler: TypeAlias = Callable[[zenoh.Sample], None]


class ServedZenohPort:
    """One served or subscribed port: its handlers, and the threads that call them."""

    def __init__(
        self,
        host: ComponentContext,
        at: Endpoint,
        handlers: Mapping[str, OperationCallable],
        execution: CallbackGroup,
    ) -> None:
        self._host = host
        self.at = at
        self._execution = execution
        self._handlers = {
            keys.escape_chunk(operation.name): (operation, handlers[operation.name])
            for operation in at.interface.operations
            if operation.name in handlers
        }
        self._declared: list[Any] = []
        self._queues: list[LeaderFollowerQueue] = []
        self._reliable_queues: list[ReliableQueue] = []
        self._reported: set[str] = set()
        self._publishers: PublisherRegistry | None = None

    def serve(self, session: zenoh.Session) -> None:
        """Answer queries, and receive commands if the interface has any."""
        patterns = {operation.pattern for operation in self.at.interface.operations}
        channel: Any = zenoh.handlers.FifoChannel(self.at.qos.depth or DEPTH)
        if patterns - {Pattern.COMMAND}:
            key = keys.port_key(self._host.domain, "q", self.at)
            self._drain(session.declare_queryable(f"{key}/*", channel), self._dispatch_queries())
        if Pattern.COMMAND in patterns:
            key = keys.port_key(self._host.domain, "c", self.at)
            self._drain(session.declare_subscriber(f"{key}/*", channel), self._dispatch_samples())

    def subscribe(
        self, session: zenoh.Session, publishers: PublisherRegistry, hold_s: float
    ) -> None:
        """Subscribe to the publishers that the port is connected to, or to all.

        `hold_s`: how long a full reliable queue may hold them.
        """
        self._publishers = publishers
        root = keys.interface_key(self._host.domain, "t", self.at)
        for peer in self.at.peers or (ANY,):
            component, _, port = peer.partition(".")
            chunk = component if component == ANY else keys.escape_chunk(component)
            key = f"{root}/{chunk}/{keys.escape_chunk(port) if port else '*'}/*"
            handle_sample = self._dispatch_samples()
            if component == ANY and "/" in self.at.component:
                handle_sample = self._same_branch_only(handle_sample)
            depth = self.at.qos.depth or DEPTH
            if self.at.qos.reliable:
                self._drain_reliable(session, key, ReliableQueue(depth, hold_s), handle_sample)
            else:
                # A full queue drops the oldest message.
                channel: Any = zenoh.handlers.RingChannel(depth)
                self._drain(session.declare_subscriber(key, channel), handle_sample)

    def _same_branch_only(self, handle_sample: SampleHandler) -> SampleHandler:
        """`handle_sample` without components of other branches; no key expression excludes them."""
        known: dict[str, bool] = {}

        def choose(sample: zenoh.Sample) -> None:
            key = str(sample.key_expr)
            near = known.get(key)
            if near is None:
                near = known[key] = on_same_branch(self.at.component, keys.publisher_of(key))
            if near:
                handle_sample(sample)

        return choose

    def _drain_reliable(
        self, session: zenoh.Session, key: str, samples: ReliableQueue, handle: SampleHandler
    ) -> None:
        put = zenoh.handlers.Callback(samples.put, indirect=False)
        self._reliable_queues.append(samples)
        self._declared.append(session.declare_subscriber(key, put))
        self._queues.append(
            LeaderFollowerQueue(
                f"{self.at.component}.{self.at.port}",
                samples.take,
                handle,
                self._execution,
                self._host.fail,
            )
        )

    def _drain(self, declared: Any, handle: Callable[[Any], None]) -> None:
        self._declared.append(declared)
        name = f"{self.at.component}.{self.at.port}"
        receive = declared.handler.recv
        self._queues.append(
            LeaderFollowerQueue(
                name, receive, handle, self._execution, self._host.fail, zenoh.ZError
            )
        )

    def _dispatch_queries(self) -> Callable[[zenoh.Query], None]:
        known: dict[str, QueryHandler] = {}

        def dispatch(query: zenoh.Query) -> None:
            key = str(query.key_expr)
            answer = known.get(key)
            if answer is None:
                answer = known[key] = self._query_handler(key)
            answer(query, key)
            query.drop()

        return dispatch

    def _dispatch_samples(self) -> SampleHandler:
        by_operation = {
            name: self._sample_handler(*found) for name, found in self._handlers.items()
        }
        if len(by_operation) == 1 == len(self.at.interface.operations):
            return next(iter(by_operation.values()))

        def dispatch(sample: zenoh.Sample) -> None:
            handle_sample = by_operation.get(str(sample.key_expr).rpartition("/")[2])
            if handle_sample:
                handle_sample(sample)

        return dispatch

    def _query_handler(self, key: str) -> QueryHandler:
        """The handler of queries with this key."""
        found = self._handlers.get(key.rpartition("/")[2])
        if found is None:
            return lambda query, _key: query.reply_err(b"RCIthere is no such operation")
        operation, handler = found
        counts = self._host.statistics.of(self.at.port, operation.name)
        decode, encode = operation.decode_request, operation.encode_reply
        acquire, release = self._execution.acquire, self._execution.release
        holders = self._execution.holders

        def answer(query: zenoh.Query, key: str) -> None:
            counts.calls += 1
            start = 0 if counts.calls % TIMING_INTERVAL else perf_counter_ns()
            try:
                payload = query.payload
                data = b"" if payload is None else payload.to_bytes()
                counts.bytes_in += len(data)
                arguments = decode(data)
                acquire()
                holders[get_ident()] = perf_counter_ns()
                try:
                    result = handler(*arguments)
                finally:
                    holders.pop(get_ident(), None)
                    release()
                reply = encode(result)
                counts.bytes_out += len(reply)
                query.reply(key, reply)
            except BaseException as error:
                self._reply_error(query, operation, error, counts)
            if start:
                counts.durations.add(perf_counter_ns() - start)

        return answer

    def _sample_handler(self, operation: Operation, handler: OperationCallable) -> SampleHandler:
        """The handler of samples of one operation."""
        counts = self._host.statistics.of(self.at.port, operation.name)
        if self.at.qos.deadline:
            handler = with_deadline_check(handler, self.at.qos.deadline, counts)
        decode = operation.decode_request
        acquire, release = self._execution.acquire, self._execution.release
        holders = self._execution.holders
        losses = self._loss_counter(counts)
        pending = losses.pending if losses else deque(maxlen=1)

        def handle_sample(sample: zenoh.Sample) -> None:
            counts.calls += 1
            start = 0 if counts.calls % TIMING_INTERVAL else perf_counter_ns()
            try:
                attachment = sample.attachment
                if attachment is not None:
                    # A copy: the attachment itself would keep zenoh's receive buffer in use.
                    pending.append(attachment.to_bytes())
                data = sample.payload.to_bytes()
                counts.bytes_in += len(data)
                arguments = decode(data)
                acquire()
                holders[get_ident()] = perf_counter_ns()
                try:
                    handler(*arguments)
                finally:
                    holders.pop(get_ident(), None)
                    release()
            except BaseException as error:
                self._report_failure(operation, error, counts)
            if start:
                counts.durations.add(perf_counter_ns() - start)
                if len(pending) > MAX_PENDING and losses is not None:
                    losses.process()

        return handle_sample

    def _loss_counter(self, counts: OperationCounts) -> LossCounter | None:
        """The counter of lost publications; commands have none."""
        if self._publishers is None:
            return None
        return self._publishers.loss_counter(self.at, counts, self._execution)

    def _reply_error(
        self,
        query: zenoh.Query,
        operation: Operation,
        error: BaseException,
        counts: OperationCounts,
    ) -> None:
        if isinstance(error, operation.throws):
            counts.failures += 1
        else:
            self._report_failure(operation, error, counts)
        query.reply_err(encode_failure(operation, error))

    def _report_failure(
        self, operation: Operation, error: BaseException, counts: OperationCounts
    ) -> None:
        """Count and log the failure of a message."""
        counts.failures += 1
        what = f"{self.at.port}.{operation.name}"
        if isinstance(error, EncodeError):
            log.error("cannot send the result of %s: %s", what, error)
        elif not isinstance(error, MalformedMessage):
            log_failure(what, error)
        else:
            counts.malformed += 1
            # A peer that sends malformed messages at a high rate is reported once.
            if what not in self._reported:
                self._reported.add(what)
                log.warning("rejected a message for %s: %s", what, error)

    def close(self) -> None:
        """Receive no more messages; running handlers may finish."""
        for samples in self._reliable_queues:
            samples.close()
        for entry in self._declared:
            entry.undeclare()
        for queue in self._queues:
            queue.join(0.5)
