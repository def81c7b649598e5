"""The calling side: proxies and publishers.

In: a port and the directory of who is there. Out: functions that encode, send and decode. Queries
go through a declared querier with the channel that it returns: measured 1.3 times as fast as
`session.get`, and twice as fast as a callback.
"""

from __future__ import annotations

import time
from threading import get_ident
from time import perf_counter_ns
from typing import Any

import zenoh

from robocomp_dsl.runtime.errors import InterfaceMismatch, NoServer
from robocomp_dsl.runtime.interface import Operation, Pattern
from robocomp_dsl.runtime.middleware.base import Bound, Endpoint, Host, Qos
from robocomp_dsl.runtime.middleware.calling import GRACE_S, pick, reaches, servers, settled
from robocomp_dsl.runtime.middleware.zenoh import keys
from robocomp_dsl.runtime.middleware.zenoh.answers import failure
from robocomp_dsl.runtime.middleware.zenoh.directory import Directory
from robocomp_dsl.runtime.middleware.zenoh.keys import Present
from robocomp_dsl.runtime.naming import related
from robocomp_dsl.runtime.statistics import TIMED_EACH

PRIORITIES = {
    "realtime": zenoh.Priority.REAL_TIME,
    "high": zenoh.Priority.INTERACTIVE_HIGH,
    "normal": zenoh.Priority.DATA,
    "low": zenoh.Priority.DATA_LOW,
    "background": zenoh.Priority.BACKGROUND,
}


def sending(qos: Qos) -> dict[str, Any]:
    """The settings of zenoh for a quality of service; nothing where nothing was said."""
    made: dict[str, Any] = {}
    if qos.reliable is not None:
        control = zenoh.CongestionControl
        made["congestion_control"] = control.BLOCK if qos.reliable else control.DROP
    if qos.priority:
        made["priority"] = PRIORITIES[qos.priority]
    return made


class ServiceLink:
    """Calls the one component that serves the interface; follows it when it is started again."""

    def __init__(
        self,
        session: zenoh.Session,
        directory: Directory,
        host: Host,
        at: Endpoint,
    ) -> None:
        self._timeout = 10.0
        self._session = session
        self._directory = directory
        self._host = host
        self._at = at
        self._hash = at.interface.hash
        self._opened = time.monotonic()
        self._met = False
        self._server: Present | None = None
        self._seen = -1
        self._queriers: dict[str, tuple[tuple[Present, float], zenoh.Querier]] = {}

    @property
    def timeout(self) -> float:
        """Seconds that a call may take."""
        return self._timeout

    @timeout.setter
    def timeout(self, seconds: float) -> None:
        self._timeout = seconds
        # Bound calls look at the directory again when its version is another.
        self._directory.renew()

    def bind(self, operation: Operation) -> Bound:
        """See `base.Link`."""
        if operation.pattern is Pattern.COMMAND:
            return self._command(operation)
        return self._query(operation)

    def _query(self, operation: Operation) -> Bound:
        counts = self._host.statistics.of(self._at.port, operation.name)
        pause, resume = self._host.execution.pause, self._host.execution.resume
        holders = self._host.execution.holders
        encode, decode = operation.encode_request, operation.decode_reply
        directory = self._directory
        version = -1
        ask: Any = None
        end: Any = None

        def query(*arguments: Any) -> Any:
            nonlocal version, ask, end
            data = encode(arguments)
            counts.calls += 1
            counts.bytes_out += len(data)
            start = 0 if counts.calls % TIMED_EACH else perf_counter_ns()
            paused = get_ident() in holders and pause()
            try:
                try:
                    if version != directory.version:
                        seen = directory.version
                        ask = self._querier(operation).get
                        end = self._end()
                        version = seen  # only now: where there was no server, the next looks again
                    reply = ask(payload=data, cancellation_token=end).recv()
                except zenoh.ZError:
                    reply = self._again(operation, data)
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

    def _again(self, operation: Operation, data: bytes) -> Any:
        """There was no reply at all: ask the next server, if the question may be asked twice."""
        if operation.idempotent and not self._directory.over:
            self._find(self._timeout)
            try:
                ask = self._querier(operation).get
                return ask(payload=data, cancellation_token=self._end()).recv()
            except zenoh.ZError:
                pass
        raise self._gone(operation)

    def _end(self) -> zenoh.CancellationToken:
        """What ends a call when its server goes, or this component."""
        assert self._server is not None  # noqa: S101 - `_querier` has found it
        return self._directory.end_of(self._server)

    def _failure(self, operation: Operation, reply: zenoh.Reply) -> Exception:
        """What an answer without a result says."""
        server = f"{self._server.component}.{self._server.port}" if self._server else self._at.port
        data = reply.err.payload.to_bytes() if reply.err else b""
        return failure(operation, server, data, self._timeout)

    def _gone(self, operation: Operation) -> Exception:
        """No reply at all: the server ended with the question, or this component is ending."""
        who = f"{self._at.component}, which called {self._at.port}.{operation.name}, is stopping"
        if self._directory.over:
            return NoServer(who)
        return NoServer(f"{self._at.port}.{operation.name}: the component that served it has ended")

    def _querier(self, operation: Operation) -> zenoh.Querier:
        """A querier for the server as it is now. Raises what `pick` raises."""
        server = self._find()
        made = self._queriers.get(operation.name)
        if made is None or made[0] != (server, self._timeout):
            querier = self._session.declare_querier(
                self._key("q", server, operation),
                timeout=self._timeout,
                consolidation=zenoh.ConsolidationMode.NONE,
                **sending(self._at.qos),
            )
            made = self._queriers[operation.name] = ((server, self._timeout), querier)
        return made[1]

    def _key(self, kind: keys.Kind, server: Present, operation: Operation) -> str:
        at = Endpoint(self._at.interface, server.component, server.port)
        return f"{keys.port_key(self._host.domain, kind, at)}/{keys.part(operation.name)}"

    def _command(self, operation: Operation) -> Bound:
        counts = self._host.statistics.of(self._at.port, operation.name)
        encode = operation.encode_request
        settings = {"congestion_control": zenoh.CongestionControl.BLOCK} | sending(self._at.qos)
        server: Present | None = None
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
                raise self._gone(operation) from None
            except Exception:
                counts.failures += 1
                raise
            counts.bytes_out += len(data)

        return command

    def _find(self, seconds: float | None = None) -> Present:
        """The server, as the directory has it now. Raises what `pick` raises."""
        version = self._directory.version
        if self._server is not None and version == self._seen:
            return self._server
        found = [
            p for p in self._directory.find("server", self._at.interface.name) if self._fits(p)
        ]
        if not settled(self._at, (p.component for p in found)):
            # One that was there has not yet to start: it is gone.
            grace = 0.0 if self._met else self._opened + GRACE_S - time.monotonic()
            found = self._wait(grace if seconds is None else seconds, grace)
        found = servers(self._at, found, lambda p: p.component)
        server = found[0]
        if len(found) > 1:
            name = pick(self._at, [f"{p.component}.{p.port}" for p in found])
            server = next(p for p in found if f"{p.component}.{p.port}" == name)
        self._met = True
        if server != self._server:
            self._check(server)
            self._server = server
        self._seen = version
        return server

    def _wait(self, seconds: float, grace: float) -> list[Present]:
        """Servers, waiting for one at most so long, and so long for one that is near."""
        name = self._at.interface.name
        until = time.monotonic() + seconds
        paused = self._host.execution.pause()
        try:
            self._directory.wait("server", name, self._beside, min(seconds, grace))
            left = until - time.monotonic()
            found = self._directory.wait("server", name, self._fits, left)
        finally:
            if paused:
                self._host.execution.resume()
        if not found:
            pick(self._at, ())
        return found

    def _fits(self, one: Present) -> bool:
        return reaches(self._at, one.component, one.port)

    def _beside(self, one: Present) -> bool:
        return self._fits(one) and settled(self._at, (one.component,))

    def _check(self, server: Present) -> None:
        if server.hash != self._hash.hex():
            raise InterfaceMismatch(
                f"{self._at.component} and {server.component} were generated from different"
                f" versions of {self._at.interface.name}; generate both from the same IDSL file"
            )

    def wait(self, timeout: float) -> bool:
        """See `base.Link`."""
        paused = self._host.execution.pause()
        try:
            name = self._at.interface.name
            found = self._directory.wait("server", name, self._fits, timeout)
        finally:
            if paused:
                self._host.execution.resume()
        self._met = self._met or settled(self._at, (one.component for one in found))
        return bool(found)

    def heard(self) -> bool:
        """See `base.Link`."""
        return self.wait(0.0)


class TopicLink:
    """Publishes to whoever subscribes."""

    def __init__(
        self, session: zenoh.Session, directory: Directory, host: Host, at: Endpoint
    ) -> None:
        self.timeout = 0.0
        self._session = session
        self._directory = directory
        self._host = host
        self._at = at
        self._publishers: list[zenoh.Publisher] = []
        self._listeners: list[Any] = []
        self._stale, self._heard = True, False

    def bind(self, operation: Operation) -> Bound:
        """See `base.Link`."""
        counts = self._host.statistics.of(self._at.port, operation.name)
        encode, number = operation.encode_request, keys.NUMBER.pack
        key = f"{keys.port_key(self._host.domain, 't', self._at)}/{keys.part(operation.name)}"
        publisher = self._session.declare_publisher(key, **sending(self._at.qos))
        self._publishers.append(publisher)

        def publish(*arguments: Any) -> None:
            data = encode(arguments)
            if counts.calls % keys.NUMBERED_EACH:
                publisher.put(data)
            else:
                publisher.put(data, attachment=number(counts.calls & 0xFFFFFFFF))
            counts.calls += 1
            counts.bytes_out += len(data)

        return publish

    def wait(self, timeout: float) -> bool:
        """See `base.Link`."""
        paused = self._host.execution.pause()
        try:
            name = self._at.interface.name
            return bool(self._directory.wait("subscriber", name, self._hears, timeout))
        finally:
            if paused:
                self._host.execution.resume()

    def heard(self) -> bool:
        """See `base.Link`; foreign subscribers count, too."""
        for publisher in self._publishers[len(self._listeners) :]:
            told = zenoh.handlers.Callback(self._matched, indirect=False)
            self._listeners.append(publisher.declare_matching_listener(told))
        if self._stale:
            self._stale = False  # first, so that a change that comes meanwhile is not missed
            self._heard = any(one.matching_status.matching for one in self._publishers)  # type: ignore[attr-defined]
        return self._heard

    def _matched(self, _status: object) -> None:
        self._stale = True

    def _hears(self, one: Present) -> bool:
        return one.component != self._at.component and related(self._at.component, one.component)
