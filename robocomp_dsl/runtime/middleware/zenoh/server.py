"""The serving side: queries and commands answered by handlers, publications handed to them.

In: a port, its handlers, the component's token. Out: queryables and subscribers, each with a
channel that one thread drains. A callback would take the interpreter's lock from a foreign thread
for every message: measured 1.3 times slower, with a fifth of the throughput.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping
from time import perf_counter_ns
from typing import Any

import zenoh

from robocomp_dsl.runtime.errors import EncodeError, InterfaceMismatch, MalformedMessage
from robocomp_dsl.runtime.execution import Execution
from robocomp_dsl.runtime.interface import Operation, Pattern
from robocomp_dsl.runtime.middleware.base import Bound, Endpoint, Host
from robocomp_dsl.runtime.middleware.calling import log, log_failure
from robocomp_dsl.runtime.middleware.zenoh import keys
from robocomp_dsl.runtime.middleware.zenoh.answers import failure_bytes
from robocomp_dsl.runtime.receiver import Closed, Receiver
from robocomp_dsl.runtime.statistics import OperationCounts

DEPTH = 256
"""Length of a queue without a depth in its quality of service."""


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
        self._hash = at.interface.hash
        self._execution = execution
        self._entries: dict[str, tuple[Operation, Bound, OperationCounts]] = {
            keys.part(one.name): (
                one,
                handlers[one.name],
                host.statistics.of(at.port, one.name),
            )
            for one in at.interface.operations
            if one.name in handlers
        }
        self._declared: list[Any] = []
        self._receivers: list[Receiver] = []
        self._numbers: dict[str, int] = {}
        self._told: set[str] = set()

    def serve(self, session: zenoh.Session) -> None:
        """Answer queries, and take commands where the interface has some."""
        patterns = {one.pattern for one in self.at.interface.operations}
        channel: Any = zenoh.handlers.FifoChannel(self.at.qos.depth or DEPTH)
        if patterns - {Pattern.COMMAND}:
            key = keys.port_key(self._host.domain, "q", self.at)
            self._drain(session.declare_queryable(f"{key}/*", channel), self._answer)
        if Pattern.COMMAND in patterns:
            key = keys.port_key(self._host.domain, "c", self.at)
            self._drain(session.declare_subscriber(f"{key}/*", channel), self._obey)

    def subscribe(self, session: zenoh.Session) -> None:
        """Hear the publishers that the port is wired to, or all of them."""
        interface = keys.part(self.at.interface.name)
        root = f"{keys.root(self._host.domain)}/t/{interface}"
        for peer in self.at.peers or ("*",):
            component, _, port = peer.partition(".")
            chunk = component if component == "*" else keys.part(component)
            key = f"{root}/{chunk}/{keys.part(port) if port else '*'}/*"
            self._drain(session.declare_subscriber(key, self._topic_channel()), self._hear)

    def _topic_channel(self) -> Any:
        qos = self.at.qos
        depth = qos.depth or DEPTH
        # A reader that must not lose anything holds up the publisher; any other loses the oldest.
        return (
            zenoh.handlers.FifoChannel(depth) if qos.reliable else zenoh.handlers.RingChannel(depth)
        )

    def _drain(self, declared: Any, handle: Callable[[Any], None]) -> None:
        self._declared.append(declared)
        receive = declared.handler.recv

        def take() -> Any:
            try:
                return receive()
            except zenoh.ZError:
                raise Closed from None

        name = f"{self.at.component}.{self.at.port}"
        self._receivers.append(Receiver(name, take, handle, self._execution))

    def _answer(self, query: zenoh.Query) -> None:
        key = query.key_expr
        entry = self._entries.get(str(key).rpartition("/")[2])
        if entry is None:
            query.reply_err(b"RCIthe operation is not part of the interface that is served")
            query.drop()
            return
        operation, handler, counts = entry
        counts.calls += 1
        start = perf_counter_ns()
        try:
            arguments = self._arguments(operation, query, counts)
            self._execution.enter()
            try:
                result = handler(*arguments)
            finally:
                self._execution.leave()
            data = operation.encode_reply(result)
        except Exception as error:
            self._refuse(query, operation, error, counts)
        else:
            counts.bytes_out += len(data)
            query.reply(key, data)
        query.drop()
        counts.durations.add(perf_counter_ns() - start)

    def _arguments(
        self, operation: Operation, message: Any, counts: OperationCounts
    ) -> tuple[Any, ...]:
        """The arguments in a query or sample. Raises what `failure_bytes` can tell."""
        attachment = message.attachment
        said = attachment.to_bytes() if attachment is not None else b""
        if said[: keys.HASH_SIZE] != self._hash:
            raise InterfaceMismatch(
                f"{self.at.component} serves another version of {self.at.interface.name};"
                " generate both sides from the same IDSL file"
            )
        payload = message.payload
        data = payload.to_bytes() if payload is not None else b""
        counts.bytes_in += len(data)
        try:
            return operation.decode_request(data)
        except MalformedMessage:
            counts.malformed += 1
            raise

    def _refuse(
        self, query: zenoh.Query, operation: Operation, error: Exception, counts: OperationCounts
    ) -> None:
        counts.failures += 1
        if isinstance(error, EncodeError):
            log.error("the result of %s.%s cannot be sent: %s", self.at.port, operation.name, error)
        elif isinstance(error, (InterfaceMismatch, MalformedMessage)):
            self._tell_once(operation.name, error)
        elif not isinstance(error, operation.throws):
            log_failure(f"{self.at.port}.{operation.name}", error)
        query.reply_err(failure_bytes(operation, error))

    def _obey(self, sample: zenoh.Sample) -> None:
        self._handle(sample)

    def _hear(self, sample: zenoh.Sample) -> None:
        entry = self._entries.get(str(sample.key_expr).rpartition("/")[2])
        if entry and sample.attachment is not None:
            self._count_losses(sample, entry[2])
        self._handle(sample)

    def _count_losses(self, sample: zenoh.Sample, counts: OperationCounts) -> None:
        said = sample.attachment.to_bytes() if sample.attachment is not None else b""
        if len(said) != keys.NUMBERED.size:
            return
        number = keys.NUMBERED.unpack(said)[1]
        key = str(sample.key_expr)
        expected = self._numbers.get(key, number)
        # A smaller number is a publisher that started again.
        counts.drops += max(number - expected, 0)
        self._numbers[key] = number + 1

    def _handle(self, sample: zenoh.Sample) -> None:
        """One way: whatever is wrong is counted and logged here."""
        entry = self._entries.get(str(sample.key_expr).rpartition("/")[2])
        if entry is None:
            return
        operation, handler, counts = entry
        counts.calls += 1
        start = perf_counter_ns()
        try:
            arguments = self._arguments(operation, sample, counts)
            with self._execution:
                handler(*arguments)
        except (InterfaceMismatch, MalformedMessage) as error:
            counts.failures += 1
            self._tell_once(operation.name, error)
        except Exception as error:
            counts.failures += 1
            log_failure(f"{self.at.port}.{operation.name}", error)
        counts.durations.add(perf_counter_ns() - start)

    def _tell_once(self, operation: str, error: Exception) -> None:
        """A peer that sends nonsense a thousand times a second is told of once."""
        said = f"{type(error).__name__} {operation}"
        if said not in self._told:
            self._told.add(said)
            log.warning("a message for %s.%s was refused: %s", self.at.port, operation, error)

    def close(self) -> None:
        """Take no more; what is being handled may end."""
        for one in self._declared:
            one.undeclare()
        for one in self._receivers:
            one.join(0.5)
