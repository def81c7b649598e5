"""A served or subscribed port, as the connection plane gives it to a transport.

In: a port, its handlers, the callback group. Out: functions that a transport calls with decoded
arguments; they run the handler under the callback group, count, time, and report failures. The
threads and queues of a port are here, too.
"""

from __future__ import annotations

import logging
from collections import deque
from collections.abc import Callable, Mapping
from threading import get_ident
from time import perf_counter_ns
from typing import TYPE_CHECKING, Any, TypeAlias

from robocomp_dsl.runtime.component.callback_group import CallbackGroup
from robocomp_dsl.runtime.component.interface import Interface, Operation
from robocomp_dsl.runtime.component.receiver import LeaderFollowerQueue, QueueClosed
from robocomp_dsl.runtime.component.statistics import OperationCounts, Statistics
from robocomp_dsl.runtime.component.thread_priority import ThreadPriority
from robocomp_dsl.runtime.component.throttle import Throttle
from robocomp_dsl.runtime.component.user_errors import log_failure
from robocomp_dsl.runtime.connection.endpoint import Endpoint
from robocomp_dsl.runtime.connection.message_stamp import with_header_stamp
from robocomp_dsl.runtime.connection.ports import OperationCallable
from robocomp_dsl.runtime.errors import (
    EncodeError,
    MalformedMessage,
    RejectedByReceiver,
    ReportedFailure,
    Timeout,
)

if TYPE_CHECKING:
    from robocomp_dsl.runtime.connection.losses import LossCounter

Handle: TypeAlias = Callable[[tuple[Any, ...]], Any]
"""Calls the handler with a tuple of arguments; returns its result, raises what it raises."""
MAX_PENDING_NUMBERS = 32
"""Numbers are evaluated in batches: this takes a fifth of the time."""
log = logging.getLogger("robocomp")


class IncomingOperation:
    """One operation of a served or subscribed port.

    `handle` passes arguments to the handler under the callback group; `numbers` takes the number of
    each publication, for the losses.
    """

    __slots__ = (
        "_handler",
        "_port",
        "_throttle",
        "counts",
        "handle",
        "losses",
        "numbers",
        "operation",
    )

    def __init__(
        self,
        operation: Operation,
        handler: OperationCallable,
        port: IncomingPort,
        losses: LossCounter | None = None,
    ) -> None:
        self.operation = operation
        self._port = port
        self._throttle = Throttle()
        self.losses = losses
        self.numbers: deque[bytes] = losses.pending if losses else deque(maxlen=1)
        self.counts: OperationCounts = port.statistics.of(port.at.port, operation.name)
        self._handler = with_header_stamp(operation, handler)
        self.handle: Handle = self._handle()

    def _handle(self) -> Handle:
        """A function that calls the handler, and counts and times the call.

        Code that runs for every message uses local names and is inlined: its thread has just been
        woken, and its caches are cold.
        """
        counts, group, handler = self.counts, self._port.callback_group, self._handler
        durations = counts.durations
        acquire, release, holders = group.acquire, group.release, group.holders
        process = self.losses.process if self.losses else None
        numbers = self.numbers

        def handle(arguments: tuple[Any, ...]) -> Any:
            counts.calls += 1
            if counts.calls % durations.interval:
                acquire()
                holders[get_ident()] = perf_counter_ns()
                try:
                    return handler(*arguments)
                finally:
                    holders.pop(get_ident(), None)
                    release()
            start = perf_counter_ns()
            acquire()
            holders[get_ident()] = perf_counter_ns()
            try:
                return handler(*arguments)
            finally:
                holders.pop(get_ident(), None)
                release()
                durations.add(perf_counter_ns() - start)
                if process is not None and len(numbers) > MAX_PENDING_NUMBERS:
                    process()

        return handle

    def handle_for_caller(
        self,
        timeout: float,
        convert: Callable[[BaseException], BaseException],
        closed_error: type[Exception],
        encode: Callable[[Any], Any] | None = None,
    ) -> Handle:
        """A function that calls the handler in the thread of its caller.

        It raises `Timeout` if the callback group has no slot within `timeout` s, `closed_error` if
        the port was closed, and `convert(error)` for an error of the handler or of `encode`, which
        converts its result.
        """
        counts, port, handler = self.counts, self._port, _encoding(self._handler, encode)
        group = port.callback_group
        acquire, release, holders = group.acquire, group.release, group.holders
        durations = counts.durations

        def handle(arguments: tuple[Any, ...]) -> Any:
            if port.closed:
                raise closed_error
            calls = counts.calls + 1
            counts.calls = calls
            start = 0 if calls % durations.interval else perf_counter_ns()
            # The second `acquire` parses its arguments: slower than the first.
            if not (acquire(False) or acquire(True, timeout)):
                raise Timeout(f"{port.at.name} was busy for {timeout:g} s")
            me = get_ident()
            holders[me] = perf_counter_ns()
            try:
                return handler(*arguments)
            except BaseException as error:
                raise convert(error)  # noqa: B904 - `convert` sets the cause
            finally:
                del holders[me]
                release()
                if start:
                    durations.add(perf_counter_ns() - start)

        return handle

    def handle_unless(self, skip: Callable[[], bool], arguments: tuple[Any, ...]) -> None:
        """Pass arguments to the handler unless `skip()` is true in the callback group."""
        with self._port.callback_group:
            if not skip():
                self.counts.calls += 1
                self._handler(*arguments)

    def report(self, error: BaseException) -> None:
        """Count and log a message that failed: malformed, or its handler or result failed.

        A declared exception of a query, and what was reported already, is only counted.
        """
        counts = self.counts
        counts.failures += 1
        if isinstance(error, (*self.operation.throws, RejectedByReceiver, ReportedFailure)):
            return
        what = f"{counts.port}.{counts.operation}"
        if isinstance(error, EncodeError):
            log.error("cannot send the result of %s: %s", what, error)
        elif not isinstance(error, MalformedMessage):
            log_failure(what, error)
        else:
            counts.calls += 1  # `handle` was not called
            counts.malformed += 1
            if self._throttle.allows("malformed"):
                so_far = f"; {counts.malformed} so far" if counts.malformed > 1 else ""
                log.warning("rejected a message for %s: %s%s%s", what, error, counts.suffix, so_far)


def _encoding(handler: OperationCallable, encode: Callable[[Any], Any] | None) -> OperationCallable:
    """`handler`, with its result converted by `encode`."""
    if encode is None:
        return handler
    return lambda *arguments: encode(handler(*arguments))


class IncomingPort:
    """One served or subscribed port of a component on one middleware.

    A transport whose callers call the handlers directly sets `closed` when it closes the port.
    """

    def __init__(
        self,
        at: Endpoint,
        handlers: Mapping[str, OperationCallable],
        callback_group: CallbackGroup,
        statistics: Statistics,
        fail: Callable[[str], None],
        losses: Callable[[OperationCounts], LossCounter] | None = None,
    ) -> None:
        self.at = at
        self.callback_group = callback_group
        self.statistics = statistics
        self.fail = fail
        self.closed = False
        self.operations: dict[str, IncomingOperation] = {}
        for operation in at.interface.operations:
            if operation.name in handlers:
                counts = statistics.of(at.port, operation.name)
                counter = losses(counts) if losses else None
                self.operations[operation.name] = IncomingOperation(
                    operation, handlers[operation.name], self, counter
                )
        self._receivers: list[LeaderFollowerQueue] = []
        self.thread_priority = ThreadPriority(at.name, at.qos.thread_priority)

    @property
    def interface(self) -> Interface:
        """The interface of the port."""
        return self.at.interface

    def receive(
        self,
        take: Callable[[], Any],
        handle: Callable[[Any], None],
        closed_error: type[Exception] = QueueClosed,
    ) -> LeaderFollowerQueue:
        """Start a thread that passes what `take` returns to `handle`, until it raises.

        `take` blocks; `closed_error` is what it raises when the port was closed. Another thread
        continues while a handler waits for a remote reply.
        """
        name = f"{self.at.component}.{self.at.port}"
        receiver = LeaderFollowerQueue(
            name,
            take,
            handle,
            self.callback_group,
            self.fail,
            closed_error,
            self.thread_priority,
        )
        # Some transports have one for each connection: forget those that have ended.
        running = [each for each in self._receivers if each.is_running]
        self._receivers = [*running, receiver]
        return receiver

    def count_held(self) -> None:
        """Count a message that found its queue full."""
        for operation in self.operations.values():
            operation.counts.held += 1
            return

    def set_thread_priority(self, priority: int | None) -> bool:
        """Change the priority of the receiving threads; returns whether it is in force."""
        threads = [thread for receiver in self._receivers for thread in receiver.threads]
        return self.thread_priority.change(priority, threads)

    def join(self, timeout: float) -> None:
        """Wait until the threads have ended, at most `timeout` s for each."""
        for receiver in self._receivers:
            receiver.join(timeout)
