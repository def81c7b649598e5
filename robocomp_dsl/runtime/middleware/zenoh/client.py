"""The calling side: channels that call servers and publish topics.

In: a port and the port registry. Out: functions that encode, send and decode. Queries use a
declared querier with the channel that it returns: measured 1.3 times as fast as `session.get`, and
twice as fast as a callback.
"""

from __future__ import annotations

import time
from dataclasses import replace
from threading import get_ident
from time import perf_counter_ns
from typing import Any

import zenoh

from robocomp_dsl.runtime.codec.failures import decode_failure
from robocomp_dsl.runtime.component.interface import Operation, Pattern
from robocomp_dsl.runtime.component.naming import on_same_branch
from robocomp_dsl.runtime.component.statistics import TIMING_INTERVAL
from robocomp_dsl.runtime.connection.endpoint import Endpoint, Qos
from robocomp_dsl.runtime.connection.losses import PublisherCounter
from robocomp_dsl.runtime.connection.peer_selection import (
    DISCOVERY_TIMEOUT_S,
    discovery_complete,
    eligible_servers,
    matches,
    select_server,
)
from robocomp_dsl.runtime.connection.ports import ComponentContext, OperationCallable
from robocomp_dsl.runtime.connection.sequence import SEQUENCE_FORMAT
from robocomp_dsl.runtime.errors import InterfaceMismatch, NoServer
from robocomp_dsl.runtime.middleware.zenoh.held_publisher import HeldPublisher
from robocomp_dsl.runtime.presence import keys
from robocomp_dsl.runtime.presence.keys import PortToken
from robocomp_dsl.runtime.presence.port_registry import PortRegistry

PRIORITIES = {
    "realtime": zenoh.Priority.REAL_TIME,
    "high": zenoh.Priority.INTERACTIVE_HIGH,
    "normal": zenoh.Priority.DATA,
    "low": zenoh.Priority.DATA_LOW,
    "background": zenoh.Priority.BACKGROUND,
}


def publisher_options(qos: Qos) -> dict[str, Any]:
    """The options of a zenoh publisher for a quality of service; empty for the defaults."""
    options: dict[str, Any] = {}
    if qos.reliable is not None:
        control = zenoh.CongestionControl
        options["congestion_control"] = control.BLOCK if qos.reliable else control.DROP
    if qos.priority:
        options["priority"] = PRIORITIES[qos.priority]
    return options


class ZenohServiceChannel:
    """Calls the component that serves the interface, also after a restart of that component."""

    def __init__(
        self,
        session: zenoh.Session,
        directory: PortRegistry,
        host: ComponentContext,
        at: Endpoint,
    ) -> None:
        self._timeout = 10.0
        self._session = session
        self._registry = directory
        self._host = host
        self._at = at
        self._hash = at.interface.hash
        self._opened = time.monotonic()
        self._connected_once = False
        self._server: PortToken | None = None
        self._registry_version = -1
        self._queriers: dict[str, tuple[tuple[PortToken, float], zenoh.Querier]] = {}

    @property
    def timeout(self) -> float:
        """Seconds that a call may take."""
        return self._timeout

    @timeout.setter
    def timeout(self, seconds: float) -> None:
        self._timeout = seconds
        # Bound calls read the registry again when its version changes.
        self._registry.invalidate()

    def bind(self, operation: Operation) -> OperationCallable:
        """See `base.Channel`."""
        if operation.pattern is Pattern.COMMAND:
            return self._command(operation)
        return self._query(operation)

    def _query(self, operation: Operation) -> OperationCallable:
        counts = self._host.statistics.of(self._at.port, operation.name)
        pause, resume = self._host.callback_group.pause, self._host.callback_group.resume
        holders = self._host.callback_group.holders
        encode, decode = operation.encode_request, operation.decode_reply
        directory = self._registry
        version = -1
        ask: Any = None
        end: Any = None

        def query(*arguments: Any) -> Any:
            nonlocal version, ask, end
            data = encode(arguments)
            counts.calls += 1
            counts.bytes_out += len(data)
            start = 0 if counts.calls % TIMING_INTERVAL else perf_counter_ns()
            paused = get_ident() in holders and pause()
            try:
                try:
                    if version != directory.version:
                        seen = directory.version
                        ask = self._querier(operation).get
                        end = self._cancellation_token()
                        version = seen  # set last: without a server, the next call searches again
                    reply = ask(payload=data, cancellation_token=end).recv()
                except zenoh.ZError:
                    reply = self._retry(operation, data)
            except BaseException:
                counts.failures += 1
                raise
            finally:
                if paused:
                    resume()
            if start:
                counts.durations.add(perf_counter_ns() - start)
            sample = reply.ok
            if sample is None:
                counts.failures += 1
                raise self._failure(operation, reply)
            received = sample.payload.to_bytes()
            counts.bytes_in += len(received)
            return decode(received)

        return query

    def _retry(self, operation: Operation, data: bytes) -> Any:
        """No reply arrived: call the next server if the operation is idempotent."""
        if operation.idempotent and not self._registry.closed:
            self._find(self._timeout)
            try:
                ask = self._querier(operation).get
                return ask(payload=data, cancellation_token=self._cancellation_token()).recv()
            except zenoh.ZError:
                pass
        raise self._server_lost(operation)

    def _cancellation_token(self) -> zenoh.CancellationToken:
        """The token that cancels calls when the server or this component exits."""
        assert self._server is not None  # noqa: S101 - `_querier` has found it
        return self._registry.cancellation_token(self._server)

    def _failure(self, operation: Operation, reply: zenoh.Reply) -> Exception:
        """The exception for a reply without a result."""
        server = f"{self._server.component}.{self._server.port}" if self._server else self._at.port
        data = reply.err.payload.to_bytes() if reply.err else b""
        return decode_failure(operation, server, data, self._timeout)

    def _server_lost(self, operation: Operation) -> Exception:
        """The exception without any reply: the server exited, or this component is stopping."""
        who = f"{self._at.component}, which called {self._at.port}.{operation.name}, is stopping"
        if self._registry.closed:
            return NoServer(who)
        return NoServer(f"{self._at.port}.{operation.name}: the component that served it exited")

    def _querier(self, operation: Operation) -> zenoh.Querier:
        """A querier for the current server. Raises what `select_server` raises."""
        server = self._find()
        cached = self._queriers.get(operation.name)
        if cached is None or cached[0] != (server, self._timeout):
            querier = self._session.declare_querier(
                self._key("q", server, operation),
                timeout=self._timeout,
                consolidation=zenoh.ConsolidationMode.NONE,
                **publisher_options(self._at.qos),
            )
            cached = self._queriers[operation.name] = ((server, self._timeout), querier)
        return cached[1]

    def _key(self, kind: keys.Kind, server: PortToken, operation: Operation) -> str:
        at = Endpoint(self._at.interface, server.component, server.port)
        return f"{keys.port_key(self._host.domain, kind, at)}/{keys.escape_chunk(operation.name)}"

    def _command(self, operation: Operation) -> OperationCallable:
        counts = self._host.statistics.of(self._at.port, operation.name)
        encode = operation.encode_request
        settings = {"congestion_control": zenoh.CongestionControl.BLOCK} | publisher_options(
            self._at.qos
        )
        server: PortToken | None = None
        publisher: Any = None

        def command(*arguments: Any) -> None:
            nonlocal publisher, server
            data = encode(arguments)
            counts.calls += 1
            try:
                found = self._find()
                if found != server:
                    key = self._key("c", found, operation)
                    publisher = self._session.declare_publisher(key, **settings)
                    server = found
                publisher.put(data)
            except zenoh.ZError:
                counts.failures += 1
                raise self._server_lost(operation) from None
            except Exception:
                counts.failures += 1
                raise
            counts.bytes_out += len(data)

        return command

    def _find(self, seconds: float | None = None) -> PortToken:
        """The current server of the registry. Raises what `select_server` raises."""
        version = self._registry.version
        if self._server is not None and version == self._registry_version:
            return self._server
        found = [
            p for p in self._registry.find("server", self._at.interface.name) if self._matches(p)
        ]
        if not discovery_complete(self._at, (p.component for p in found)):
            # A server that was connected before has exited; do not wait for its start.
            grace = (
                0.0
                if self._connected_once
                else self._opened + DISCOVERY_TIMEOUT_S - time.monotonic()
            )
            found = self._wait(grace if seconds is None else seconds, grace)
        found = eligible_servers(self._at, found, lambda p: p.component)
        server = found[0]
        if len(found) > 1:
            name = select_server(self._at, [f"{p.component}.{p.port}" for p in found])
            server = next(p for p in found if f"{p.component}.{p.port}" == name)
        self._connected_once = True
        if server != self._server:
            self._check_version(server)
            self._server = server
        self._registry_version = version
        return server

    def _wait(self, seconds: float, grace: float) -> list[PortToken]:
        """Servers, waiting at most `seconds`, of that `grace` for the nearest one."""
        name = self._at.interface.name
        until = time.monotonic() + seconds
        paused = self._host.callback_group.pause()
        try:
            self._registry.wait("server", name, self._is_nearest, min(seconds, grace))
            left = until - time.monotonic()
            found = self._registry.wait("server", name, self._matches, left)
        finally:
            if paused:
                self._host.callback_group.resume()
        if not found:
            select_server(self._at, ())
        return found

    def _matches(self, token: PortToken) -> bool:
        return matches(self._at, token.component, token.port)

    def _is_nearest(self, token: PortToken) -> bool:
        return self._matches(token) and discovery_complete(self._at, (token.component,))

    def _check_version(self, server: PortToken) -> None:
        if server.hash != self._hash.hex():
            raise InterfaceMismatch(
                f"{self._at.component} and {server.component} were generated from different"
                f" versions of {self._at.interface.name}; generate both from the same IDSL file"
            )

    def wait(self, timeout: float) -> bool:
        """See `base.Channel`."""
        paused = self._host.callback_group.pause()
        try:
            name = self._at.interface.name
            found = self._registry.wait("server", name, self._matches, timeout)
        finally:
            if paused:
                self._host.callback_group.resume()
        self._connected_once = self._connected_once or discovery_complete(
            self._at, (token.component for token in found)
        )
        return bool(found)

    def has_subscribers(self) -> bool:
        """See `base.Channel`."""
        return self.wait(0.0)


class ZenohTopicChannel:
    """Publishes to all subscribers."""

    def __init__(
        self, session: zenoh.Session, directory: PortRegistry, host: ComponentContext, at: Endpoint
    ) -> None:
        self.timeout = 0.0
        self._session = session
        self._registry = directory
        self._host = host
        self._at = at
        self._publishers: list[zenoh.Publisher] = []
        self._listeners: list[Any] = []
        self._stale, self._has_subscribers = True, False
        self._counter = PublisherCounter(session, host.domain, at)

    def bind(self, operation: Operation) -> OperationCallable:
        """See `base.Channel`."""
        counts = self._host.statistics.of(self._at.port, operation.name)
        encode, pack = operation.encode_request, SEQUENCE_FORMAT.pack
        publisher_id, sequence = self._counter.id, self._counter.counter(operation.name)
        key = (
            f"{keys.port_key(self._host.domain, 't', self._at)}/{keys.escape_chunk(operation.name)}"
        )
        publisher: Any
        if self._at.qos.reliable:
            # The middleware gave a session that holds what it would drop.
            options = publisher_options(replace(self._at.qos, reliable=False))
            declared = self._session.declare_publisher(key, **options)
            publisher = HeldPublisher(declared, counts)
        else:
            options = publisher_options(self._at.qos)
            publisher = declared = self._session.declare_publisher(key, **options)
        self._publishers.append(declared)

        def publish(*arguments: Any) -> None:
            data = encode(arguments)
            publisher.put(data, attachment=pack(publisher_id, next(sequence)))
            counts.calls += 1
            counts.bytes_out += len(data)

        return publish

    def wait(self, timeout: float) -> bool:
        """See `base.Channel`."""
        paused = self._host.callback_group.pause()
        try:
            name = self._at.interface.name
            return bool(self._registry.wait("subscriber", name, self._is_subscriber, timeout))
        finally:
            if paused:
                self._host.callback_group.resume()

    def has_subscribers(self) -> bool:
        """See `base.Channel`; subscribers of other zenoh programs count, too."""
        for publisher in self._publishers[len(self._listeners) :]:
            callback = zenoh.handlers.Callback(self._on_matching_changed, indirect=False)
            self._listeners.append(publisher.declare_matching_listener(callback))
        if self._stale:
            self._stale = False  # first, so that a change that comes meanwhile is not missed
            statuses: list[Any] = [publisher.matching_status for publisher in self._publishers]
            self._has_subscribers = any(status.matching for status in statuses)
        return self._has_subscribers

    def _on_matching_changed(self, _status: object) -> None:
        self._stale = True

    def _is_subscriber(self, token: PortToken) -> bool:
        return token.component != self._at.component and on_same_branch(
            self._at.component, token.component
        )
