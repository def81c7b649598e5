"""Makes and keeps the connections between external programs, while a deployment runs.

In: the connections of a plan. Out: commands to the ports, log records, and the state of each
connection. One thread leads; a few others ask the ports, which may be slow or not there.
"""

from __future__ import annotations

import asyncio
import threading
import time
from collections import defaultdict
from collections.abc import Callable, Sequence
from concurrent.futures import ThreadPoolExecutor
from concurrent.futures import wait as wait_for_futures
from importlib import import_module

from robocomp_dsl.deploy.external_connection import CONNECTED, WAITING, ConnectionStatus
from robocomp_dsl.model.deployment import ExternalConnection
from robocomp_dsl.runtime.errors import MiddlewareError
from robocomp_dsl.runtime.middleware.external_connector import ConnectorError, ExternalConnector
from robocomp_dsl.runtime.middleware.registry import description_of

PERIOD_S = 0.5
"""Time between two looks at all connections."""
REPORT_WAITING_S = 10.0
"""A connection that waits for so long is logged."""
CLOSE_TIMEOUT_S = 2.0
_MAX_THREADS = 8
Log = Callable[[str, str], None]
OpenConnector = Callable[[str], ExternalConnector]


def open_connector(middleware: str) -> ExternalConnector:
    """The connector of a middleware. Raises `ConnectorError`."""
    description = description_of(middleware)
    if description is None or not description.connector:
        raise ConnectorError(f"`{middleware}` cannot connect programs")
    module, _, function = description.connector.partition(":")
    try:
        connector: ExternalConnector = getattr(import_module(module), function)()
    except MiddlewareError as error:
        raise ConnectorError(str(error)) from None
    return connector


class _ManagedConnection:
    """One connection, its state, and what was logged of it."""

    def __init__(self, connection: ExternalConnection) -> None:
        self.connection = connection
        self.state = WAITING
        self.reason = ""
        self.is_own = False
        self.waiting_since = time.monotonic()
        self.is_reported = False

    def status(self) -> ConnectionStatus:
        link = self.connection
        return ConnectionStatus(
            link.middleware, link.source, link.target, link.carrier, self.state, self.reason
        )


class ExternalConnections:
    """Keeps connections from `start` to `close`."""

    def __init__(
        self,
        connections: Sequence[ExternalConnection],
        log: Log,
        open_connector: OpenConnector = open_connector,
    ) -> None:
        """`log` is called in the event loop that runs at `start`."""
        self._managed = [_ManagedConnection(connection) for connection in connections]
        self._log = log
        self._open = open_connector
        self._connectors: dict[str, ExternalConnector] = {}
        self._stopped = threading.Event()
        self._loop: asyncio.AbstractEventLoop | None = None
        self._thread = threading.Thread(target=self._run, name="connections", daemon=True)

    def statuses(self) -> list[ConnectionStatus]:
        """The state of all connections."""
        return [managed.status() for managed in self._managed]

    def start(self) -> None:
        """Make the connections as soon as their ports exist, and again when they are lost."""
        if self._managed:
            self._loop = asyncio.get_running_loop()
            self._thread.start()

    def close(self) -> None:
        """Remove the connections that were made here; blocks for at most a few seconds."""
        self._stopped.set()
        if self._thread.is_alive():
            self._thread.join(2 * CLOSE_TIMEOUT_S)

    def _run(self) -> None:
        by_source: dict[tuple[str, str], list[_ManagedConnection]] = defaultdict(list)
        for managed in self._managed:
            by_source[managed.connection.middleware, managed.connection.source].append(managed)
        pool = ThreadPoolExecutor(min(_MAX_THREADS, len(by_source)), "connections")
        try:
            while not self._stopped.is_set():
                list(pool.map(self._keep, by_source.values()))
                self._stopped.wait(PERIOD_S)
            ends = [
                pool.submit(self._remove, managed) for managed in self._managed if managed.is_own
            ]
            wait_for_futures(ends, CLOSE_TIMEOUT_S)
        finally:
            pool.shutdown(wait=False, cancel_futures=True)

    def _connector(self, middleware: str) -> ExternalConnector:
        if middleware not in self._connectors:
            self._connectors[middleware] = self._open(middleware)
        return self._connectors[middleware]

    def _keep(self, group: list[_ManagedConnection]) -> None:
        """Look at the connections of one port, and make those that are missing."""
        first = group[0].connection
        targets = frozenset(managed.connection.target for managed in group)
        try:
            connector = self._connector(first.middleware)
            present = connector.connected(first.source, targets)
        except ConnectorError as error:
            for managed in group:
                self._set_waiting(managed, str(error))
            return
        for managed in group:
            if managed.connection.target in present:
                self._set_connected(managed)
            elif not self._stopped.is_set():
                self._connect(managed, connector)

    def _connect(self, managed: _ManagedConnection, connector: ExternalConnector) -> None:
        link = managed.connection
        if managed.state == CONNECTED:
            self._set_waiting(managed, "the connection was lost")
        try:
            connector.connect(link.source, link.target, link.carrier)
        except ConnectorError as error:
            self._set_waiting(managed, str(error))
        else:
            managed.is_own = True
            self._set_connected(managed)

    def _set_connected(self, managed: _ManagedConnection) -> None:
        if managed.state != CONNECTED:
            managed.state, managed.reason, managed.is_reported = CONNECTED, "", False
            self._emit(f"connected {managed.status().ends()}", "INFO")

    def _set_waiting(self, managed: _ManagedConnection, reason: str) -> None:
        if managed.state == CONNECTED:
            managed.waiting_since = time.monotonic()
            self._emit(f"lost {managed.status().ends()}: {reason}", "WARNING")
        managed.state, managed.reason = WAITING, reason
        overdue = time.monotonic() - managed.waiting_since > REPORT_WAITING_S
        if overdue and not managed.is_reported:
            managed.is_reported = True
            self._emit(f"cannot connect {managed.status().ends()} yet: {reason}", "WARNING")

    def _remove(self, managed: _ManagedConnection) -> None:
        link = managed.connection
        try:
            self._connector(link.middleware).disconnect(link.source, link.target)
        except ConnectorError:
            managed.is_own = False  # its program has ended, and the connection with it

    def _emit(self, text: str, level: str) -> None:
        loop = self._loop
        if loop is not None and not loop.is_closed() and not self._stopped.is_set():
            loop.call_soon_threadsafe(self._log, text, level)
