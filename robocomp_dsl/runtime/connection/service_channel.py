"""The calling side of a service, over any transport.

In: a port, its selector, and a function that connects a server. Out: functions that call the
operations. A call releases the callback group while it waits; a lost server is searched again.
"""

from __future__ import annotations

import threading
from collections.abc import Callable
from dataclasses import replace
from threading import get_ident
from time import perf_counter_ns
from typing import Any, TypeAlias

from robocomp_dsl.runtime.component.interface import Operation, Pattern
from robocomp_dsl.runtime.component.statistics import OperationCounts
from robocomp_dsl.runtime.connection.endpoint import Endpoint
from robocomp_dsl.runtime.connection.interface_version import (
    PeerInterface,
    ShapesOf,
    is_other_version,
    mismatch,
    shapes_of_peer,
)
from robocomp_dsl.runtime.connection.ports import ComponentContext, OperationCallable
from robocomp_dsl.runtime.connection.server_selector import ServerSelector
from robocomp_dsl.runtime.errors import NoServer
from robocomp_dsl.runtime.middleware.transport import BoundOperation, ServerLost, ServiceClient
from robocomp_dsl.runtime.presence.port_record import PortRecord
from robocomp_dsl.runtime.presence.port_registry import PortRegistry

Connect: TypeAlias = Callable[[Endpoint, PortRecord, float], ServiceClient]
DEFAULT_TIMEOUT_S = 10.0
LOST_TIMEOUT_S = 0.5
"""The presence reports the end of a server at most so long after its connections broke."""


class ServiceChannel:
    """Calls the component that serves the interface, also after a restart of that component."""

    def __init__(
        self,
        context: ComponentContext,
        registry: PortRegistry,
        selector: ServerSelector,
        connect: Connect,
        shapes_of: ShapesOf,
    ) -> None:
        self._at = selector.at
        self._context = context
        self._registry = registry
        self._selector = selector
        self._connect = connect
        self._shapes_of = shapes_of
        self._version: PeerInterface | None = None
        self._timeout = DEFAULT_TIMEOUT_S
        self._lock = threading.Lock()
        self._server: PortRecord | None = None
        self._client: ServiceClient | None = None
        self._bound: dict[str, BoundOperation] = {}
        self._retired: list[ServiceClient] = []

    @property
    def timeout(self) -> float:
        """Seconds that a call may take."""
        return self._timeout

    @timeout.setter
    def timeout(self, seconds: float) -> None:
        with self._lock:
            self._timeout = seconds
            self._bound.clear()
            if self._client:
                self._client.set_timeout(seconds)
        # Bound calls bind again when the version of the registry changes.
        self._registry.invalidate()

    @property
    def at(self) -> Endpoint:
        """The port as it is now."""
        return self._at

    def update(self, at: Endpoint) -> None:
        """Call the peers of `at` from now on; calls that wait for a reply get it."""
        with self._lock:
            self._at = at
            self._selector.update(at)
            if self._client:
                self._retired.append(self._client)
            self._client = self._server = None
            self._bound.clear()
        self._registry.notify()

    def bind(self, operation: Operation) -> OperationCallable:
        """See `ports.Channel`."""
        counts = self._context.statistics.of(self._at.port, operation.name)
        if operation.pattern is Pattern.COMMAND:
            return self._command(operation, counts)
        return self._query(operation, counts)

    def _query(self, operation: Operation, counts: OperationCounts) -> OperationCallable:
        group, registry = self._context.callback_group, self._registry
        acquire, release = group.acquire, group.release
        holders, handoffs = group.holders, group.handoffs
        durations = counts.durations
        version = -1
        encode: Any = None
        send: Any = None

        def query(*arguments: Any) -> Any:
            nonlocal version, encode, send
            calls = counts.calls + 1
            counts.calls = calls
            start = 0 if calls % durations.interval else perf_counter_ns()
            began = 0
            me = get_ident()
            try:
                if version != registry.version:
                    seen = registry.version
                    encode, send = self._bind(operation, counts)
                    version = seen  # set last: without a server, the next call searches again
                data = encode(arguments) if encode else arguments
                # As `group.pause` and `resume`, which would take as long as the rest.
                if me in holders:
                    began = holders.pop(me)
                    release()
                    if me in handoffs:
                        handoffs[me]()
                try:
                    result = send(data)
                except ServerLost:
                    result = self._retry(operation, counts, arguments)
            except BaseException:
                counts.failures += 1
                raise
            finally:
                if began:
                    acquire()
                    holders[me] = began
            if start:
                durations.add(perf_counter_ns() - start)
            return result

        return query

    def _command(self, operation: Operation, counts: OperationCounts) -> OperationCallable:
        group, registry = self._context.callback_group, self._registry
        version = -1
        encode: Any = None
        send: Any = None

        def command(*arguments: Any) -> None:
            nonlocal version, encode, send
            counts.calls += 1
            try:
                if version != registry.version:
                    seen = registry.version
                    encode, send = self._bind(operation, counts)
                    version = seen
                send(encode(arguments) if encode else arguments)
            except ServerLost:
                counts.failures += 1
                paused = group.pause()
                try:
                    self._wait_until_lost()
                finally:
                    if paused:
                        group.resume(paused)
                raise self._server_lost(operation) from None
            except BaseException:
                counts.failures += 1
                raise

        return command

    def _bind(
        self, operation: Operation, counts: OperationCounts, seconds: float | None = None
    ) -> BoundOperation:
        """The operation of the current server.

        Raises what `ServerSelector.find` raises, and `InterfaceMismatch` if the server lacks the
        operation, or has another version of it.
        """
        server = self._selector.find(seconds)
        with self._lock:
            if server != self._server or self._client is None:
                self._replace_client(server)
            client = self._client
            assert client is not None  # noqa: S101 - it has just been connected
            bound = self._bound.get(operation.name)
            if bound is None:
                if self._version:
                    self._version.check(operation, self._at, server)
                bound = self._bound[operation.name] = client.bind(operation, counts)
            return bound

    def _replace_client(self, server: PortRecord) -> None:
        former, self._client, self._server = self._client, None, None
        self._bound.clear()
        if former:
            former.close()
        at, self._version = self._at, None
        if is_other_version(at, server):
            shapes = shapes_of_peer(at, server, self._shapes_of)
            if shapes is None:
                raise mismatch(at, server, "", "")
            self._version = PeerInterface(at.interface, server, shapes)
            at = replace(at, interface=self._version)
        client = self._connect(at, server, self._timeout)
        self._client, self._server = client, server
        self._registry.on_lost(server, client.cancel)

    def _retry(
        self, operation: Operation, counts: OperationCounts, arguments: tuple[Any, ...]
    ) -> Any:
        """No reply arrived: call the next server if the operation is idempotent."""
        self._wait_until_lost()
        self._forget_external()
        if operation.idempotent and not self._registry.closed:
            bound = self._bind(operation, counts, self._timeout)
            try:
                return bound.send(bound.encode(arguments) if bound.encode else arguments)
            except ServerLost:
                self._forget_external()
        raise self._server_lost(operation)

    def _wait_until_lost(self) -> None:
        """The connection may break before the presence reports it: do not select it again."""
        server = self._server
        if server is not None and server not in self._at.external:
            self._registry.wait_lost(server, LOST_TIMEOUT_S)

    def _forget_external(self) -> None:
        """Connect an external server again for the next call: no presence reports its restart."""
        with self._lock:
            if self._server in self._at.external:
                self._server = None
                self._bound.clear()
        self._registry.invalidate()

    def _server_lost(self, operation: Operation) -> Exception:
        """The exception without any reply: the server exited, or this component is stopping."""
        if self._registry.closed:
            who = self._at.component
            return NoServer(f"{who}, which called {self._at.port}.{operation.name}, is stopping")
        place = f"{self._at.port}.{operation.name}"
        if self._registry.outage:
            return NoServer(f"{place}: {self._registry.outage}")
        if self._server is not None and self._registry.has(self._server):
            denied = ", or its router denied the call" if self._registry.has_router else ""
            server = self._server.name
            return NoServer(f"{place}: no reply from {server}: the connection broke{denied}")
        return NoServer(f"{place}: the component that served it exited")

    def wait(self, timeout: float) -> bool:
        """See `ports.Channel`."""
        return self._selector.wait(timeout)

    def has_subscribers(self) -> bool:
        """See `ports.Channel`."""
        return self.wait(0.0)

    def close(self) -> None:
        """Release the connection."""
        with self._lock:
            if self._client:
                self._client.close()
            for client in self._retired:
                client.close()
            self._client = self._server = None
