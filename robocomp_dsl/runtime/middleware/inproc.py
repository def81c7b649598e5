"""inproc: components of one process call each other directly.

A query runs in the caller's thread, under the token of the component that serves it; a command or a
publication is queued and handled by a thread of the receiver. Values are passed by reference, not
copied: what is received is to be read, not changed.
"""

from __future__ import annotations

import threading
import time
from collections import deque
from collections.abc import Callable, Mapping
from dataclasses import dataclass
from queue import SimpleQueue
from threading import get_ident
from typing import Any

from robocomp_dsl.runtime.errors import (
    AmbiguousServer,
    DeclaredError,
    InterfaceMismatch,
    NoServer,
    RemoteError,
    Timeout,
)
from robocomp_dsl.runtime.execution import Execution
from robocomp_dsl.runtime.interface import Interface, Operation, Pattern
from robocomp_dsl.runtime.middleware.base import Bound, Endpoint, Host
from robocomp_dsl.runtime.middleware.calling import (
    GRACE_S,
    log_failure,
    pick,
    reaches,
    servers,
    settled,
    watched,
)
from robocomp_dsl.runtime.receiver import Closed, Receiver
from robocomp_dsl.runtime.statistics import OperationCounts

DEPTH = 1000
"""Length of a queue without a depth in its quality of service; the oldest is dropped."""


class _Inbox:
    """The queue in front of the handlers of one port, and the thread that drains it."""

    def __init__(self, at: Endpoint, execution: Execution, count: Callable[[str], Any]) -> None:
        self._jobs: deque[tuple[str, Bound, tuple[Any, ...]]] = deque(maxlen=at.qos.depth or DEPTH)
        self._bell: SimpleQueue[bool] = SimpleQueue()
        self._count = count
        self._execution = execution
        self._receiver = Receiver(f"{at.component}.{at.port}", self._take, self._run, execution)

    def put(self, operation: str, handler: Bound, arguments: tuple[Any, ...]) -> None:
        if len(self._jobs) == self._jobs.maxlen:
            self._count(operation).drops += 1
        self._jobs.append((operation, handler, arguments))
        self._bell.put(True)

    def _take(self) -> tuple[str, Bound, tuple[Any, ...]]:
        while True:
            if not self._bell.get():
                raise Closed
            # A dropped job has rung, too.
            if self._jobs:
                return self._jobs.popleft()

    def _run(self, job: tuple[str, Bound, tuple[Any, ...]]) -> None:
        operation, handler, arguments = job
        counts = self._count(operation)
        counts.calls += 1
        try:
            with self._execution:
                handler(*arguments)
        except Exception as error:
            counts.failures += 1
            log_failure(operation, error)

    def close(self) -> None:
        self._bell.put(False)
        self._receiver.join(1.0)


@dataclass(eq=False, slots=True)
class _Served:
    """One served or subscribed port. `alive` becomes false when it is closed."""

    at: Endpoint
    handlers: Mapping[str, Bound]
    execution: Execution
    inbox: _Inbox
    counts: Callable[[str], OperationCounts]
    alive: bool = True

    @property
    def name(self) -> str:
        return f"{self.at.component}.{self.at.port}"


class _Domain:
    """Everything that is served in one domain of this process."""

    def __init__(self) -> None:
        self.changed = threading.Condition()
        self.servers: list[_Served] = []
        self.subscribers: list[_Served] = []

    def matching(self, among: list[_Served], interface: Interface) -> list[_Served]:
        return [one for one in among if one.at.interface.name == interface.name]


_domains: dict[str, _Domain] = {}
_guard = threading.Lock()


def open_for(host: Host) -> Inproc:
    """The in-process middleware of one component."""
    with _guard:
        return Inproc(host, _domains.setdefault(host.domain, _Domain()))


class Inproc:
    """All connections of one component within the process."""

    def __init__(self, host: Host, domain: _Domain) -> None:
        self._host = host
        self._domain = domain
        self._mine: list[_Served] = []
        self.interrupted = threading.Event()

    def serve(self, at: Endpoint, handlers: Mapping[str, Bound], execution: Execution) -> None:
        """See `base.Middleware`."""
        self._add(self._domain.servers, at, handlers, execution)

    def subscribe(self, at: Endpoint, handlers: Mapping[str, Bound], execution: Execution) -> None:
        """See `base.Middleware`."""
        if at.qos.deadline:
            handlers = {
                name: watched(one, at.qos.deadline, self._host.statistics.of(at.port, name))
                for name, one in handlers.items()
            }
        self._add(self._domain.subscribers, at, handlers, execution)

    def _add(
        self,
        among: list[_Served],
        at: Endpoint,
        handlers: Mapping[str, Bound],
        execution: Execution,
    ) -> None:
        def counts(operation: str) -> OperationCounts:
            return self._host.statistics.of(at.port, operation)

        made = _Served(at, handlers, execution, _Inbox(at, execution, counts), counts)
        self._mine.append(made)
        with self._domain.changed:
            among.append(made)
            self._domain.changed.notify_all()

    def proxy(self, at: Endpoint) -> ServiceLink:
        """See `base.Middleware`."""
        return ServiceLink(self, self._host, self._domain, at)

    def advertise(self, at: Endpoint) -> TopicLink:
        """See `base.Middleware`."""
        return TopicLink(self._host, self._domain, at)

    def announce(self, state: str) -> None:
        """Nobody outside of the process can watch."""

    def interrupt(self) -> None:
        """See `base.Middleware`."""
        self.interrupted.set()
        with self._domain.changed:
            self._domain.changed.notify_all()

    def close(self) -> None:
        """See `base.Middleware`."""
        self.interrupt()
        with self._domain.changed:
            for one in self._mine:
                one.alive = False
                for among in (self._domain.servers, self._domain.subscribers):
                    if one in among:
                        among.remove(one)
        for one in self._mine:
            one.inbox.close()


class ServiceLink:
    """Calls the one component that serves the interface."""

    def __init__(self, owner: Inproc, host: Host, domain: _Domain, at: Endpoint) -> None:
        self.timeout = 10.0
        self._owner = owner
        self._host = host
        self._domain = domain
        self._at = at
        self._server: _Served | None = None
        self._opened = time.monotonic()

    def bind(self, operation: Operation) -> Bound:
        """See `base.Link`."""
        counts = self._host.statistics.of(self._at.port, operation.name)
        if operation.pattern is Pattern.COMMAND:
            return self._command(operation, counts)
        return self._query(operation, counts)

    def _command(self, operation: Operation, counts: OperationCounts) -> Bound:
        name = operation.name

        def command(*arguments: Any) -> None:
            server = self._find()
            counts.calls += 1
            server.inbox.put(name, server.handlers[name], arguments)

        return command

    def _query(  # noqa: C901 - written out, see `Execution`
        self, operation: Operation, counts: OperationCounts
    ) -> Bound:
        name, throws = operation.name, operation.throws
        mine = self._host.execution
        my_acquire, my_release, my_holders = mine.acquire, mine.release, mine.holders
        relieve = mine.relieve.get
        # Those of the server, found at the first call.
        server: _Served | None = None
        handler: Bound = self.bind
        theirs, acquire, release, holders = counts, mine.acquire, mine.release, my_holders

        def find() -> _Served:
            nonlocal server, handler, theirs, acquire, release, holders
            server = self._find()
            handler, theirs = server.handlers[name], server.counts(name)
            its = server.execution
            acquire, release, holders = its.acquire, its.release, its.holders
            return server

        def query(*arguments: Any) -> Any:
            served = server
            if served is None or not served.alive:
                served = find()
            counts.calls += 1
            theirs.calls += 1
            me = get_ident()
            paused = me in my_holders
            if paused:
                my_holders.remove(me)
                my_release()
                relief = relieve(me)
                if relief:
                    relief()
            if not acquire(True, self.timeout):
                if paused:
                    mine.resume()
                raise Timeout(f"{served.name} was busy for {self.timeout:g} s")
            holders.add(me)
            try:
                return handler(*arguments)
            except Exception as error:
                counts.failures += 1
                theirs.failures += 1
                if isinstance(error, DeclaredError) and isinstance(error, throws):
                    raise
                log_failure(name, error)
                raise RemoteError(_failed(served, name, error)) from error
            finally:
                holders.discard(me)
                release()
                if paused:
                    my_acquire()
                    my_holders.add(me)

        return query

    def _find(self) -> _Served:
        if self._server is None or not self._server.alive:
            self._server = self._wait(self._grace())
        return self._server

    def _grace(self) -> float:
        """So long is one waited for that has yet to start; one that was there is gone."""
        return 0.0 if self._server else self._opened + GRACE_S - time.monotonic()

    def _wait(self, seconds: float) -> _Served:
        """The one server, waiting for it at most so long. Raises what `pick` raises."""
        over = self._owner.interrupted
        until = time.monotonic() + seconds
        grace = min(seconds, self._grace())
        paused = self._host.execution.pause()
        try:
            with self._domain.changed:
                wait_for = self._domain.changed.wait_for
                wait_for(lambda: self._settled() or over.is_set(), max(grace, 0))
                left = until - time.monotonic()
                wait_for(lambda: self._candidates() or over.is_set(), max(left, 0))
                found = servers(self._at, self._candidates(), lambda one: one.at.component)
        finally:
            if paused:
                self._host.execution.resume()
        if over.is_set():
            raise NoServer(f"{self._at.component} is stopping")
        name = pick(self._at, [one.name for one in found])
        server = next(one for one in found if one.name == name)
        if server.at.interface.hash != self._at.interface.hash:
            raise InterfaceMismatch(
                f"{self._at.component} and {server.at.component} were generated from different"
                f" versions of {self._at.interface.name}"
            )
        return server

    def _candidates(self) -> list[_Served]:
        found = self._domain.matching(self._domain.servers, self._at.interface)
        return [one for one in found if reaches(self._at, one.at.component, one.at.port)]

    def _settled(self) -> bool:
        return settled(self._at, (one.at.component for one in self._candidates()))

    def wait(self, timeout: float) -> bool:
        """See `base.Link`."""
        try:
            self._server = self._wait(timeout)
        except (NoServer, AmbiguousServer):
            return False
        return True

    def heard(self) -> bool:
        """See `base.Link`."""
        return self.wait(0.0)


class TopicLink:
    """Publishes to all who subscribe, in the queue of each."""

    def __init__(self, host: Host, domain: _Domain, at: Endpoint) -> None:
        self.timeout = 0.0
        self._host = host
        self._domain = domain
        self._at = at

    def bind(self, operation: Operation) -> Bound:
        """See `base.Link`."""
        name = operation.name
        counts = self._host.statistics.of(self._at.port, name)

        def publish(*arguments: Any) -> None:
            counts.calls += 1
            for one in self._hearers():
                handler = one.handlers.get(name)
                if handler:
                    one.inbox.put(name, handler, arguments)

        return publish

    def _hearers(self) -> list[_Served]:
        at = self._at
        return [
            one
            for one in self._domain.matching(list(self._domain.subscribers), at.interface)
            if reaches(one.at, at.component, at.port) and one.at.interface.hash == at.interface.hash
        ]

    def wait(self, timeout: float) -> bool:
        """See `base.Link`."""
        with self._domain.changed:
            return bool(self._domain.changed.wait_for(self._hearers, timeout))

    def heard(self) -> bool:
        """See `base.Link`."""
        return bool(self._hearers())


def _failed(server: _Served, operation: str, error: Exception) -> str:
    return f"{server.name}.{operation} failed: {type(error).__name__}: {error}"
