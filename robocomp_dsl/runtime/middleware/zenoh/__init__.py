"""zenoh: components of any processes of one machine, each with a session of its own.

In: a `Host`. Out: its `Middleware`. A component is found through liveliness tokens, one per port.
"""

from __future__ import annotations

import os
from collections.abc import Mapping

import zenoh

from robocomp_dsl.runtime.execution import Execution
from robocomp_dsl.runtime.middleware.base import Bound, Endpoint, Host
from robocomp_dsl.runtime.middleware.zenoh import keys
from robocomp_dsl.runtime.middleware.zenoh.client import ServiceLink, TopicLink
from robocomp_dsl.runtime.middleware.zenoh.directory import Directory
from robocomp_dsl.runtime.middleware.zenoh.discovery import Opened, open_session
from robocomp_dsl.runtime.middleware.zenoh.server import Port


def open_for(host: Host) -> Zenoh:
    """A session for one component."""
    return Zenoh(host, open_session(host.domain, host.listen_port))


class Zenoh:
    """All connections of one component."""

    def __init__(self, host: Host, opened: Opened) -> None:
        self._host = host
        self._opened = opened
        self._session = opened.session
        self._directory = Directory(self._session, host.domain)
        self._ports: list[Port] = []
        self._tokens: list[zenoh.LivelinessToken] = []
        self._state: zenoh.LivelinessToken | None = None

    def serve(self, at: Endpoint, handlers: Mapping[str, Bound], execution: Execution) -> None:
        """See `base.Middleware`."""
        port = Port(self._host, at, handlers, execution)
        port.serve(self._session)
        self._ports.append(port)
        self._declare("server", at)

    def proxy(self, at: Endpoint) -> ServiceLink:
        """See `base.Middleware`."""
        return ServiceLink(self._session, self._directory, self._host, at)

    def advertise(self, at: Endpoint) -> TopicLink:
        """See `base.Middleware`."""
        self._declare("publisher", at)
        self._directory.expect("subscriber", at)
        return TopicLink(self._session, self._directory, self._host, at)

    def subscribe(self, at: Endpoint, handlers: Mapping[str, Bound], execution: Execution) -> None:
        """See `base.Middleware`."""
        port = Port(self._host, at, handlers, execution)
        port.subscribe(self._session)
        self._ports.append(port)
        self._declare("subscriber", at)
        self._directory.expect("publisher", at)

    def _declare(self, role: str, at: Endpoint) -> None:
        """Tell that a port is there; after it was made, so that who sees it can use it."""
        said = keys.Present(role, at.interface.name, at.component, at.port, at.interface.hash.hex())
        token = self._session.liveliness().declare_token(said.key(self._host.domain))
        self._tokens.append(token)

    def announce(self, state: str) -> None:
        """See `base.Middleware`."""
        before = self._state
        self._state = None
        if state:
            key = keys.state_key(self._host.domain, self._host.component, os.getpid(), state)
            try:
                self._state = self._session.liveliness().declare_token(key)
            except zenoh.ZError:
                # A component that was left behind at its end may come so far later.
                if not self._directory.over:
                    raise
        # The new state comes first, or a watcher would see the component gone in between.
        if before:
            before.undeclare()

    def interrupt(self) -> None:
        """See `base.Middleware`."""
        self._directory.interrupt()

    def close(self) -> None:
        """See `base.Middleware`."""
        self.interrupt()
        tokens, self._tokens = self._tokens, []
        for token in tokens:
            token.undeclare()
        ports, self._ports = self._ports, []
        for port in ports:
            port.close()
        self._opened.close()
