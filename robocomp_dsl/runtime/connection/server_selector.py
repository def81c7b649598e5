"""Selects the server of a required port, and follows it through restarts.

In: a port and the port registry. Out: the record of the server to call, or the error that says why
there is none.
"""

from __future__ import annotations

import time
from collections.abc import Callable, Iterable

from robocomp_dsl.runtime.component.callback_group import CallbackGroup
from robocomp_dsl.runtime.component.naming import port_of_connection
from robocomp_dsl.runtime.connection import peer_selection
from robocomp_dsl.runtime.connection.endpoint import Endpoint
from robocomp_dsl.runtime.connection.peer_selection import (
    discovery_complete,
    eligible_servers,
    matches,
    select_server,
)
from robocomp_dsl.runtime.errors import NoServer
from robocomp_dsl.runtime.presence.port_record import PortRecord
from robocomp_dsl.runtime.presence.port_registry import PortRegistry


class ServerSelector:
    """The servers that one port may call; `is_usable` tells which records can be connected."""

    def __init__(
        self,
        at: Endpoint,
        registry: PortRegistry,
        callback_group: CallbackGroup,
        is_usable: Callable[[Endpoint, PortRecord], bool],
    ) -> None:
        self.at = at
        self._registry = registry
        self._callback_group = callback_group
        self._is_usable = is_usable
        self._opened = time.monotonic()
        self._connected_once = False
        self._server: PortRecord | None = None
        self._registry_version = -1

    def find(self, seconds: float | None = None) -> PortRecord:
        """The current server, waiting at most `seconds` for it, by default the discovery timeout.

        It may have another version of the interface. Raises `NoServer` or `AmbiguousServer`.
        """
        version = self._registry.version
        if self._server is not None and version == self._registry_version:
            return self._server
        if self._registry.closed:
            raise NoServer(f"{self.at.component} is stopping: it calls {self.at.port} no longer")
        found = self._candidates()
        if not discovery_complete(self.at, (record.component for record in found)):
            # A server that was connected before has exited; do not wait for its start.
            grace = (
                0.0
                if self._connected_once
                else self._opened + peer_selection.DISCOVERY_TIMEOUT_S - time.monotonic()
            )
            found = self._wait(grace if seconds is None else seconds, grace)
        found = eligible_servers(self.at, found, lambda record: record.component)
        server = found[0]
        if len(found) > 1:
            name = select_server(self.at, [record.name for record in found])
            server = next(record for record in found if record.name == name)
        self._connected_once = True
        self._server = server
        self._registry_version = version
        return server

    def update(self, at: Endpoint) -> None:
        """Select among the peers of `at` from now on."""
        self.at = at
        self._server = None

    def _candidates(self) -> list[PortRecord]:
        found = self._registry.find("server", self.at.interface.name)
        return self._best_of_each(record for record in found if self._matches(record))

    def _best_of_each(self, records: Iterable[PortRecord]) -> list[PortRecord]:
        """One record for each server: of the preferred middleware, and the latest of several.

        Several exist for a moment when a component restarts.
        """
        best: dict[str, PortRecord] = {}
        for record in (*self.at.external, *records):
            other = best.get(record.name)
            if other is None or self._rank(record) <= self._rank(other):
                best[record.name] = record
        return list(best.values())

    def _rank(self, record: PortRecord) -> int:
        order = self.at.middlewares
        return order.index(record.middleware) if record.middleware in order else len(order)

    def _wait(self, seconds: float, grace: float) -> list[PortRecord]:
        """Servers, waiting at most `seconds`, of that `grace` for the nearest one."""
        name = self.at.interface.name
        until = time.monotonic() + seconds
        paused = self._callback_group.pause()
        try:
            self._registry.wait("server", name, self._is_nearest, min(seconds, grace))
            left = until - time.monotonic()
            self._registry.wait("server", name, self._matches, left)
        finally:
            if paused:
                self._callback_group.resume(paused)
        if self._registry.closed:
            raise NoServer(f"{self.at.component} is stopping")
        found = self._candidates()
        if not found:
            self._check_arbitrated()
            select_server(self.at, ())
        return found

    def _check_arbitrated(self) -> None:
        """Raise `NoServer` if the server exists, but this port has no connection with it."""
        for record in self._registry.find("server", self.at.interface.name):
            port = port_of_connection(record.port)
            if port != record.port and matches(self.at, record.component, port):
                raise NoServer(
                    f"{record.component}.{port} is arbitrated: it accepts its connections only, and"
                    f" {self.at.name} has none"
                )

    def _matches(self, record: PortRecord) -> bool:
        return matches(self.at, record.component, record.port) and self._is_usable(self.at, record)

    def _is_nearest(self, record: PortRecord) -> bool:
        return self._matches(record) and discovery_complete(self.at, (record.component,))

    def wait(self, timeout: float) -> bool:
        """Wait up to `timeout` s for a server; returns whether there is one."""
        if self.at.external:
            return True
        paused = self._callback_group.pause()
        try:
            name = self.at.interface.name
            found = self._registry.wait("server", name, self._matches, timeout)
        finally:
            if paused:
                self._callback_group.resume(paused)
        self._connected_once = self._connected_once or discovery_complete(
            self.at, (record.component for record in found)
        )
        return bool(found)
