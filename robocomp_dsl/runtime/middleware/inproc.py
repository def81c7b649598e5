"""inproc: components of one process call each other directly.

A query runs in the thread of the caller, in the callback group of the server; a command or a
publication is queued and handled by a thread of the receiver. Values are passed by reference, not
copied: receivers must not modify them.
"""

from __future__ import annotations

import threading
import time
from collections import deque
from collections.abc import Callable, Mapping
from dataclasses import dataclass
from queue import SimpleQueue
from threading import get_ident
from time import perf_counter_ns
from typing import Any

from robocomp_dsl.runtime.component.callback_group import CallbackGroup
from robocomp_dsl.runtime.component.interface import Interface, Operation, Pattern
from robocomp_dsl.runtime.component.receiver import LeaderFollowerQueue, QueueClosed
from robocomp_dsl.runtime.component.statistics import OperationCounts
from robocomp_dsl.runtime.component.user_errors import log_failure, message_of
from robocomp_dsl.runtime.connection.endpoint import Endpoint
from robocomp_dsl.runtime.connection.peer_selection import (
    DISCOVERY_TIMEOUT_S,
    discovery_complete,
    eligible_servers,
    matches,
    select_server,
    with_deadline_check,
)
from robocomp_dsl.runtime.connection.ports import ComponentContext, OperationCallable
from robocomp_dsl.runtime.errors import (
    AmbiguousServer,
    DeclaredError,
    InterfaceMismatch,
    NoServer,
    RemoteError,
    Timeout,
)

DEPTH = 1000
"""Default queue length; when the queue is full the oldest message is dropped."""


class _Mailbox:
    """The receive queue of one port, and the thread that drains it."""

    def __init__(
        self,
        at: Endpoint,
        execution: CallbackGroup,
        count: Callable[[str], Any],
        fail: Callable[[str], None],
    ) -> None:
        self._jobs: deque[tuple[str, OperationCallable, tuple[Any, ...]]] = deque(
            maxlen=at.qos.depth or DEPTH
        )
        self._wakeup: SimpleQueue[bool] = SimpleQueue()
        self._count = count
        self._execution = execution
        self._receiver = LeaderFollowerQueue(
            f"{at.component}.{at.port}", self._take, self._run, execution, fail
        )

    def put(self, operation: str, handler: OperationCallable, arguments: tuple[Any, ...]) -> None:
        if len(self._jobs) == self._jobs.maxlen:
            self._count(operation).drops += 1
        self._jobs.append((operation, handler, arguments))
        self._wakeup.put(True)

    def _take(self) -> tuple[str, OperationCallable, tuple[Any, ...]]:
        while True:
            if not self._wakeup.get():
                raise QueueClosed
            # A dropped job leaves a wake-up behind.
            if self._jobs:
                return self._jobs.popleft()

    def _run(self, job: tuple[str, OperationCallable, tuple[Any, ...]]) -> None:
        operation, handler, arguments = job
        counts = self._count(operation)
        counts.calls += 1
        try:
            with self._execution:
                handler(*arguments)
        except BaseException as error:
            counts.failures += 1
            log_failure(operation, error)

    def close(self) -> None:
        self._wakeup.put(False)
        self._receiver.join(1.0)


@dataclass(eq=False, slots=True)
class _Port:
    """One served or subscribed port. `alive` is false after it was closed."""

    endpoint: Endpoint
    handlers: Mapping[str, OperationCallable]
    callback_group: CallbackGroup
    mailbox: _Mailbox
    counts: Callable[[str], OperationCounts]
    alive: bool = True

    @property
    def name(self) -> str:
        return f"{self.endpoint.component}.{self.endpoint.port}"


class _Domain:
    """All served ports of one domain in this process."""

    def __init__(self) -> None:
        self.changed = threading.Condition()
        self.servers: list[_Port] = []
        self.subscribers: list[_Port] = []

    def ports_of(self, among: list[_Port], interface: Interface) -> list[_Port]:
        return [port for port in among if port.endpoint.interface.name == interface.name]


_domains: dict[str, _Domain] = {}
_domains_lock = threading.Lock()


def open_for(host: ComponentContext) -> InprocMiddleware:
    """The in-process middleware of one component."""
    with _domains_lock:
        return InprocMiddleware(host, _domains.setdefault(host.domain, _Domain()))


class InprocMiddleware:
    """All connections of one component within the process."""

    def __init__(self, host: ComponentContext, domain: _Domain) -> None:
        self._host = host
        self._domain = domain
        self._ports: list[_Port] = []
        self.interrupted = threading.Event()

    def serve(
        self, at: Endpoint, handlers: Mapping[str, OperationCallable], execution: CallbackGroup
    ) -> None:
        """See `base.Middleware`."""
        self._add(self._domain.servers, at, handlers, execution)

    def subscribe(
        self, at: Endpoint, handlers: Mapping[str, OperationCallable], execution: CallbackGroup
    ) -> None:
        """See `base.Middleware`."""
        if at.qos.deadline:
            handlers = {
                name: with_deadline_check(
                    handler, at.qos.deadline, self._host.statistics.of(at.port, name)
                )
                for name, handler in handlers.items()
            }
        self._add(self._domain.subscribers, at, handlers, execution)

    def _add(
        self,
        among: list[_Port],
        at: Endpoint,
        handlers: Mapping[str, OperationCallable],
        execution: CallbackGroup,
    ) -> None:
        def counts(operation: str) -> OperationCounts:
            return self._host.statistics.of(at.port, operation)

        mailbox = _Mailbox(at, execution, counts, self._host.fail)
        port = _Port(at, handlers, execution, mailbox, counts)
        self._ports.append(port)
        with self._domain.changed:
            among.append(port)
            self._domain.changed.notify_all()

    def proxy(self, at: Endpoint) -> InprocServiceChannel:
        """See `base.Middleware`."""
        return InprocServiceChannel(self, self._host, self._domain, at)

    def advertise(self, at: Endpoint) -> InprocTopicChannel:
        """See `base.Middleware`."""
        return InprocTopicChannel(self._host, self._domain, at)

    def find_servers(self, interface: Interface, timeout: float) -> list[str]:
        """See `base.Middleware`."""

        def names() -> list[str]:
            found = self._domain.ports_of(self._domain.servers, interface)
            return sorted({port.endpoint.component for port in found})

        with self._domain.changed:
            self._domain.changed.wait_for(names, timeout)
            return names()

    def publish_state(self, state: str) -> None:
        """No effect: other processes cannot monitor this one."""

    def interrupt(self) -> None:
        """See `base.Middleware`."""
        self.interrupted.set()
        with self._domain.changed:
            self._domain.changed.notify_all()

    def close(self) -> None:
        """See `base.Middleware`."""
        self.interrupt()
        with self._domain.changed:
            for port in self._ports:
                port.alive = False
                for among in (self._domain.servers, self._domain.subscribers):
                    if port in among:
                        among.remove(port)
        for port in self._ports:
            port.mailbox.close()


class InprocServiceChannel:
    """Calls the component that serves the interface."""

    def __init__(
        self, owner: InprocMiddleware, host: ComponentContext, domain: _Domain, at: Endpoint
    ) -> None:
        self.timeout = 10.0
        self._owner = owner
        self._host = host
        self._domain = domain
        self._at = at
        self._server: _Port | None = None
        self._opened = time.monotonic()

    def bind(self, operation: Operation) -> OperationCallable:
        """See `base.Channel`."""
        counts = self._host.statistics.of(self._at.port, operation.name)
        if operation.pattern is Pattern.COMMAND:
            return self._command(operation, counts)
        return self._query(operation, counts)

    def _command(self, operation: Operation, counts: OperationCounts) -> OperationCallable:
        name = operation.name

        def command(*arguments: Any) -> None:
            server = self._find()
            counts.calls += 1
            server.mailbox.put(name, server.handlers[name], arguments)

        return command

    def _query(  # noqa: C901 - written out, see `Execution`
        self, operation: Operation, counts: OperationCounts
    ) -> OperationCallable:
        name, throws = operation.name, operation.throws
        mine = self._host.callback_group
        my_acquire, my_release, my_holders = mine.acquire, mine.release, mine.holders
        relieve = mine.handoffs.get
        # The server and its functions, found at the first call.
        server: _Port | None = None
        handler: OperationCallable = self.bind
        theirs, acquire, release, holders = counts, mine.acquire, mine.release, my_holders

        def find() -> _Port:
            nonlocal server, handler, theirs, acquire, release, holders
            server = self._find()
            handler, theirs = server.handlers[name], server.counts(name)
            its = server.callback_group
            acquire, release, holders = its.acquire, its.release, its.holders
            return server

        def query(*arguments: Any) -> Any:
            served = server
            if served is None or not served.alive:
                served = find()
            counts.calls += 1
            theirs.calls += 1
            me = get_ident()
            began = my_holders.pop(me, None)
            if began is not None:
                my_release()
                relief = relieve(me)
                if relief:
                    relief()
            if not acquire(True, self.timeout):
                if began is not None:
                    my_acquire()
                    my_holders[me] = began
                raise Timeout(f"{served.name} was busy for {self.timeout:g} s")
            holders[me] = perf_counter_ns()
            try:
                return handler(*arguments)
            except BaseException as error:
                counts.failures += 1
                theirs.failures += 1
                if declared := _as_declared(
                    error, served.endpoint.interface.operation(name), throws
                ):
                    raise declared  # noqa: B904 - nearly always the same exception
                log_failure(name, error)
                raise RemoteError(_failure_message(served, name, error)) from error
            finally:
                holders.pop(me, None)
                release()
                if began is not None:
                    my_acquire()
                    my_holders[me] = began

        return query

    def _find(self) -> _Port:
        if self._server is None or not self._server.alive:
            self._server = self._wait(self._discovery_time_left())
        return self._server

    def _discovery_time_left(self) -> float:
        """Seconds to wait for a server; 0 if one was connected before, as it has exited."""
        return 0.0 if self._server else self._opened + DISCOVERY_TIMEOUT_S - time.monotonic()

    def _wait(self, seconds: float) -> _Port:
        """The server, waiting at most `seconds`. Raises what `select_server` raises."""
        over = self._owner.interrupted
        until = time.monotonic() + seconds
        grace = min(seconds, self._discovery_time_left())
        paused = self._host.callback_group.pause()
        try:
            with self._domain.changed:
                wait_for = self._domain.changed.wait_for
                wait_for(lambda: self._discovery_complete() or over.is_set(), max(grace, 0))
                left = until - time.monotonic()
                wait_for(lambda: self._candidates() or over.is_set(), max(left, 0))
                found = eligible_servers(
                    self._at, self._candidates(), lambda port: port.endpoint.component
                )
        finally:
            if paused:
                self._host.callback_group.resume()
        if over.is_set():
            raise NoServer(f"{self._at.component} is stopping")
        name = select_server(self._at, [port.name for port in found])
        server = next(port for port in found if port.name == name)
        if server.endpoint.interface.hash != self._at.interface.hash:
            raise InterfaceMismatch(
                f"{self._at.component} and {server.endpoint.component} were generated from"
                f" different versions of {self._at.interface.name}"
            )
        return server

    def _candidates(self) -> list[_Port]:
        found = self._domain.ports_of(self._domain.servers, self._at.interface)
        return [
            port for port in found if matches(self._at, port.endpoint.component, port.endpoint.port)
        ]

    def _discovery_complete(self) -> bool:
        return discovery_complete(
            self._at, (candidate.endpoint.component for candidate in self._candidates())
        )

    def wait(self, timeout: float) -> bool:
        """See `base.Channel`."""
        try:
            self._server = self._wait(timeout)
        except (NoServer, AmbiguousServer):
            return False
        return True

    def has_subscribers(self) -> bool:
        """See `base.Channel`."""
        return self.wait(0.0)


class InprocTopicChannel:
    """Publishes to all subscribers, into the queue of each."""

    def __init__(self, host: ComponentContext, domain: _Domain, at: Endpoint) -> None:
        self.timeout = 0.0
        self._host = host
        self._domain = domain
        self._at = at

    def bind(self, operation: Operation) -> OperationCallable:
        """See `base.Channel`."""
        name = operation.name
        counts = self._host.statistics.of(self._at.port, name)

        def publish(*arguments: Any) -> None:
            counts.calls += 1
            for subscriber in self._subscribers():
                handler = subscriber.handlers.get(name)
                if handler:
                    subscriber.mailbox.put(name, handler, arguments)

        return publish

    def _subscribers(self) -> list[_Port]:
        at = self._at
        return [
            port
            for port in self._domain.ports_of(list(self._domain.subscribers), at.interface)
            if matches(port.endpoint, at.component, at.port)
            and port.endpoint.interface.hash == at.interface.hash
        ]

    def wait(self, timeout: float) -> bool:
        """See `base.Channel`."""
        with self._domain.changed:
            return bool(self._domain.changed.wait_for(self._subscribers, timeout))

    def has_subscribers(self) -> bool:
        """See `base.Channel`."""
        return bool(self._subscribers())


def _as_declared(
    error: BaseException, operation: Operation, throws: tuple[type[DeclaredError], ...]
) -> DeclaredError | None:
    """The exception as the caller declares it: two generated packages have classes of their own.

    None if the `operation` of the server does not declare it.
    """
    if not isinstance(error, DeclaredError):
        return None
    if isinstance(error, throws):
        return error
    if type(error) not in operation.throws:
        return None
    return throws[operation.throws.index(type(error))](*error._astuple())


def _failure_message(server: _Port, operation: str, error: BaseException) -> str:
    return f"{server.name}.{operation} failed: {type(error).__name__}: {message_of(error)}"
