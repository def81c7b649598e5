"""The serving side: queries and commands answered by handlers, publications handed to them.

In: a port, its handlers, the component's token. Out: queryables and subscribers, each with a
channel that one thread drains. A callback would take the interpreter's lock from a foreign thread
for every message: measured 1.3 times slower, with a fifth of the throughput.

What is done for every message is bound to local names and written out, not called: the thread has
just been woken, its caches are cold, and each line here costs five times what it costs in a loop.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping
from threading import get_ident
from time import perf_counter_ns
from typing import Any, TypeAlias

import zenoh

from robocomp_dsl.runtime.errors import EncodeError, MalformedMessage
from robocomp_dsl.runtime.execution import Execution
from robocomp_dsl.runtime.interface import Operation, Pattern
from robocomp_dsl.runtime.middleware.base import Bound, Endpoint, Host
from robocomp_dsl.runtime.middleware.calling import log, log_failure, watched
from robocomp_dsl.runtime.middleware.zenoh import keys
from robocomp_dsl.runtime.middleware.zenoh.answers import failure_bytes
from robocomp_dsl.runtime.naming import ANY, related
from robocomp_dsl.runtime.receiver import Receiver
from robocomp_dsl.runtime.statistics import TIMED_EACH, OperationCounts

DEPTH = 256
"""Length of a queue without a depth in its quality of service."""

Answer: TypeAlias = Callable[[zenoh.Query, str], None]
Hear: TypeAlias = Callable[[zenoh.Sample], None]


class Port:
    """The handlers of one served or subscribed port, and the threads in front of them."""

    def __init__(
        self,
        host: Host,
        at: Endpoint,
        handlers: Mapping[str, Bound],
        execution: Execution,
    ) -> None:
        self._host = host
        self.at = at
        self._execution = execution
        self._handlers = {
            keys.part(one.name): (one, handlers[one.name])
            for one in at.interface.operations
            if one.name in handlers
        }
        self._declared: list[Any] = []
        self._receivers: list[Receiver] = []
        self._told: set[str] = set()

    def serve(self, session: zenoh.Session) -> None:
        """Answer queries, and take commands where the interface has some."""
        patterns = {one.pattern for one in self.at.interface.operations}
        channel: Any = zenoh.handlers.FifoChannel(self.at.qos.depth or DEPTH)
        if patterns - {Pattern.COMMAND}:
            key = keys.port_key(self._host.domain, "q", self.at)
            self._drain(session.declare_queryable(f"{key}/*", channel), self._dispatch_queries())
        if Pattern.COMMAND in patterns:
            key = keys.port_key(self._host.domain, "c", self.at)
            self._drain(session.declare_subscriber(f"{key}/*", channel), self._dispatch_samples())

    def subscribe(self, session: zenoh.Session) -> None:
        """Hear the publishers that the port is wired to, or all of them."""
        root = keys.interface_key(self._host.domain, "t", self.at)
        for peer in self.at.peers or (ANY,):
            component, _, port = peer.partition(".")
            chunk = component if component == ANY else keys.part(component)
            key = f"{root}/{chunk}/{keys.part(port) if port else '*'}/*"
            declared = session.declare_subscriber(key, self._topic_channel())
            hear = self._dispatch_samples()
            far = component == ANY and "/" in self.at.component
            self._drain(declared, self._without_others(hear) if far else hear)

    def _without_others(self, hear: Hear) -> Hear:
        """`hear`, without what comes from other branches: no key can say who they are."""
        known: dict[str, bool] = {}

        def choose(sample: zenoh.Sample) -> None:
            key = str(sample.key_expr)
            near = known.get(key)
            if near is None:
                near = known[key] = related(self.at.component, keys.publisher_of(key))
            if near:
                hear(sample)

        return choose

    def _topic_channel(self) -> Any:
        depth = self.at.qos.depth or DEPTH
        # A reader that must not lose anything holds up the publisher; any other loses the oldest.
        if self.at.qos.reliable:
            return zenoh.handlers.FifoChannel(depth)
        return zenoh.handlers.RingChannel(depth)

    def _drain(self, declared: Any, handle: Callable[[Any], None]) -> None:
        self._declared.append(declared)
        name = f"{self.at.component}.{self.at.port}"
        receive = declared.handler.recv
        self._receivers.append(Receiver(name, receive, handle, self._execution, zenoh.ZError))

    def _dispatch_queries(self) -> Callable[[zenoh.Query], None]:
        known: dict[str, Answer] = {}

        def dispatch(query: zenoh.Query) -> None:
            key = str(query.key_expr)
            answer = known.get(key)
            if answer is None:
                answer = known[key] = self._answer(key)
            answer(query, key)
            query.drop()

        return dispatch

    def _dispatch_samples(self) -> Hear:
        by_operation = {name: self._hear(*found) for name, found in self._handlers.items()}
        if len(by_operation) == 1 == len(self.at.interface.operations):
            return next(iter(by_operation.values()))

        def dispatch(sample: zenoh.Sample) -> None:
            hear = by_operation.get(str(sample.key_expr).rpartition("/")[2])
            if hear:
                hear(sample)

        return dispatch

    def _answer(self, key: str) -> Answer:
        """What answers the queries with this key."""
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
            start = 0 if counts.calls % TIMED_EACH else perf_counter_ns()
            try:
                payload = query.payload
                data = b"" if payload is None else payload.to_bytes()
                counts.bytes_in += len(data)
                arguments = decode(data)
                acquire()
                holders.add(get_ident())
                try:
                    result = handler(*arguments)
                finally:
                    holders.discard(get_ident())
                    release()
                reply = encode(result)
                counts.bytes_out += len(reply)
                query.reply(key, reply)
            except Exception as error:
                self._refuse(query, operation, error, counts)
            if start:
                counts.durations.add(perf_counter_ns() - start)

        return answer

    def _hear(self, operation: Operation, handler: Bound) -> Hear:
        """What hears the samples of one operation."""
        counts = self._host.statistics.of(self.at.port, operation.name)
        if self.at.qos.deadline:
            handler = watched(handler, self.at.qos.deadline, counts)
        decode = operation.decode_request
        acquire, release = self._execution.acquire, self._execution.release
        holders = self._execution.holders
        losses = Losses(counts)

        def hear(sample: zenoh.Sample) -> None:
            counts.calls += 1
            start = 0 if counts.calls % TIMED_EACH else perf_counter_ns()
            try:
                attachment = sample.attachment
                if attachment is not None:
                    losses.count(str(sample.key_expr), attachment.to_bytes())
                data = sample.payload.to_bytes()
                counts.bytes_in += len(data)
                arguments = decode(data)
                acquire()
                holders.add(get_ident())
                try:
                    handler(*arguments)
                finally:
                    holders.discard(get_ident())
                    release()
            except Exception as error:
                self._complain(operation, error, counts)
            if start:
                counts.durations.add(perf_counter_ns() - start)

        return hear

    def _refuse(
        self, query: zenoh.Query, operation: Operation, error: Exception, counts: OperationCounts
    ) -> None:
        if isinstance(error, operation.throws):
            counts.failures += 1
        else:
            self._complain(operation, error, counts)
        query.reply_err(failure_bytes(operation, error))

    def _complain(self, operation: Operation, error: Exception, counts: OperationCounts) -> None:
        """Count and log what went wrong with a message."""
        counts.failures += 1
        what = f"{self.at.port}.{operation.name}"
        if isinstance(error, EncodeError):
            log.error("the result of %s cannot be sent: %s", what, error)
        elif not isinstance(error, MalformedMessage):
            log_failure(what, error)
        else:
            counts.malformed += 1
            # A peer that sends nonsense a thousand times a second is told of once.
            if what not in self._told:
                self._told.add(what)
                log.warning("a message for %s was refused: %s", what, error)

    def close(self) -> None:
        """Take no more; what is being handled may end."""
        for one in self._declared:
            one.undeclare()
        for one in self._receivers:
            one.join(0.5)


class Losses:
    """Counts what was sent and did not come: exact for one publisher, at least so many for more."""

    def __init__(self, counts: OperationCounts) -> None:
        self._counts = counts
        self._before: dict[str, tuple[int, int]] = {}

    def count(self, publisher: str, said: bytes) -> None:
        """`said` is how many `publisher` has sent before the message that was just received."""
        if len(said) != keys.NUMBER.size:
            return
        sent: int = keys.NUMBER.unpack(said)[0]
        received = self._counts.calls
        sent_before, received_before = self._before.get(publisher, (sent, received))
        # A smaller number is a publisher that has begun again.
        lost = (sent - sent_before) - (received - received_before)
        if sent >= sent_before and lost > 0:
            self._counts.drops += lost
        self._before[publisher] = (sent, received)
