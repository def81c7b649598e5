"""zenoh middleware: components in any processes of one machine, each with its own session.

In: a `ComponentContext`. Out: its `Middleware`. Components are discovered through liveliness
tokens, one per port.
"""

from __future__ import annotations

import os
from collections.abc import Mapping

import zenoh

from robocomp_dsl.runtime.component.callback_group import CallbackGroup
from robocomp_dsl.runtime.component.interface import Interface
from robocomp_dsl.runtime.connection.endpoint import Endpoint
from robocomp_dsl.runtime.connection.losses import PublisherRegistry
from robocomp_dsl.runtime.connection.ports import ComponentContext, OperationCallable
from robocomp_dsl.runtime.middleware.zenoh import reliable_queue
from robocomp_dsl.runtime.middleware.zenoh.client import ZenohServiceChannel, ZenohTopicChannel
from robocomp_dsl.runtime.middleware.zenoh.held_publisher import HOLD_S
from robocomp_dsl.runtime.middleware.zenoh.server import ServedZenohPort
from robocomp_dsl.runtime.presence import keys
from robocomp_dsl.runtime.presence.domain_session import DomainSession, open_session
from robocomp_dsl.runtime.presence.port_registry import PortRegistry


def open_for(host: ComponentContext) -> ZenohMiddleware:
    """A session for one component."""
    name = host.component if host.unique_name else ""
    return ZenohMiddleware(host, open_session(host.domain, host.listen_port, name))


class ZenohMiddleware:
    """All connections of one component."""

    def __init__(self, host: ComponentContext, opened: DomainSession) -> None:
        self._host = host
        self._opened = opened
        self._session = opened.session
        self._registry = PortRegistry(self._session, host.domain)
        self._publishers: PublisherRegistry | None = None
        self._ports: list[ServedZenohPort] = []
        self._tokens: list[zenoh.LivelinessToken] = []
        self._reliable: DomainSession | None = None
        self._state: zenoh.LivelinessToken | None = None

    def serve(
        self, at: Endpoint, handlers: Mapping[str, OperationCallable], execution: CallbackGroup
    ) -> None:
        """See `base.Middleware`."""
        port = ServedZenohPort(self._host, at, handlers, execution)
        port.serve(self._session)
        self._ports.append(port)
        self._declare("server", at)

    def proxy(self, at: Endpoint) -> ZenohServiceChannel:
        """See `base.Middleware`."""
        return ZenohServiceChannel(self._session, self._registry, self._host, at)

    def advertise(self, at: Endpoint) -> ZenohTopicChannel:
        """See `base.Middleware`."""
        session = self._reliable_session() if at.qos.reliable else self._session
        self._declare("publisher", at)
        self._registry.warn_on_mismatch("subscriber", at)
        return ZenohTopicChannel(session, self._registry, self._host, at)

    def _reliable_session(self) -> zenoh.Session:
        """The session of reliable publications, opened by the first one that is advertised.

        A reliable subscriber that receives nothing blocks the whole connection. Through this one
        only publications travel, and they are held for a limited time.
        """
        if self._reliable is None:
            self._reliable = open_session(self._host.domain, hold_s=HOLD_S)
        return self._reliable.session

    def subscribe(
        self, at: Endpoint, handlers: Mapping[str, OperationCallable], execution: CallbackGroup
    ) -> None:
        """See `base.Middleware`."""
        port = ServedZenohPort(self._host, at, handlers, execution)
        if self._publishers is None:
            self._publishers = PublisherRegistry(self._session, self._host.domain)
            self._host.statistics.on_refresh(self._publishers.settle)
        port.subscribe(self._session, self._publishers, reliable_queue.HOLD_S)
        self._ports.append(port)
        self._declare("subscriber", at)
        self._registry.warn_on_mismatch("publisher", at)

    def _declare(self, role: str, at: Endpoint) -> None:
        """Declare the token of a port; after the port, so that it can be used when it is seen."""
        port_token = keys.PortToken(
            role, at.interface.name, at.component, at.port, at.interface.hash.hex()
        )
        token = self._session.liveliness().declare_token(port_token.key(self._host.domain))
        self._tokens.append(token)

    def find_servers(self, interface: Interface, timeout: float) -> list[str]:
        """See `base.Middleware`."""
        if not self._registry.wait("server", interface.name, lambda _token: True, timeout):
            return []
        # The tokens of other peers may not have arrived: ask all peers.
        key = f"{keys.domain_prefix(self._host.domain)}/p/server/**"
        replies = self._session.liveliness().get(key, timeout=timeout)
        samples = [reply.ok for reply in replies if reply.ok is not None]
        tokens = [keys.parse_port_token(str(sample.key_expr)) for sample in samples]
        return sorted({t.component for t in tokens if t and t.interface == interface.name})

    def publish_state(self, state: str) -> None:
        """See `base.Middleware`."""
        before = self._state
        self._state = None
        if state:
            key = keys.state_key(self._host.domain, self._host.component, os.getpid(), state)
            try:
                self._state = self._session.liveliness().declare_token(key)
            except zenoh.ZError:
                # A hook that outlived the shutdown may get here later.
                if not self._registry.closed:
                    raise
        # The new state comes first; otherwise a monitor would see the component exit in between.
        if before:
            before.undeclare()

    def interrupt(self) -> None:
        """See `base.Middleware`."""
        self._registry.interrupt()

    def close(self) -> None:
        """See `base.Middleware`."""
        self.interrupt()
        tokens, self._tokens = self._tokens, []
        for token in tokens:
            token.undeclare()
        ports, self._ports = self._ports, []
        for port in ports:
            port.close()
        if self._publishers:
            self._host.statistics.off_refresh(self._publishers.settle)
            self._publishers.close()
        if self._reliable:
            self._reliable.close()
        self._opened.close()
