"""Presence over zenoh: a liveliness token for each port, and one for the lifecycle state.

In: a domain. Out: a `Presence`. It owns the zenoh session of the component, which the zenoh
transport uses, too.
"""

from __future__ import annotations

import contextlib
import os
from time import monotonic, sleep

import zenoh

from robocomp_dsl.runtime.connection.endpoint import Endpoint
from robocomp_dsl.runtime.presence import keys
from robocomp_dsl.runtime.presence.domain_session import DomainSession, open_session
from robocomp_dsl.runtime.presence.house_queries import HouseQueries
from robocomp_dsl.runtime.presence.port_record import PortRecord
from robocomp_dsl.runtime.presence.port_registry import PortRegistry
from robocomp_dsl.runtime.presence.publications import PublicationCounter, PublisherRegistry

SETTLE_S = 0.1
"""Links to the other peers of a machine are made within this time."""


def open_presence(domain: str, component: str, port: int = 0, *, unique: bool) -> ZenohPresence:
    """The presence of a component; its session also listens on TCP `port` of loopback if not 0.

    Raises `MiddlewareError`, with `unique` also if the name is taken.
    """
    opened = open_session(domain, port, component if unique else "")
    return ZenohPresence(opened, domain, component)


class ZenohPresence:
    """A `Presence`; `opened` is its session."""

    house = "zenoh"

    def __init__(self, opened: DomainSession, domain: str, component: str) -> None:
        self.opened = opened
        self.domain = domain
        self.registry = PortRegistry()
        self._component = component
        self._session = opened.session
        self._tokens: dict[PortRecord, zenoh.LivelinessToken] = {}
        self._state: zenoh.LivelinessToken | None = None
        self._publishers: PublisherRegistry | None = None
        self._queries = HouseQueries(self._session, domain, component)
        self.answer_probes = self._queries.answer_probes
        self.probe = self._queries.probe
        self.offer_latest = self._queries.offer_latest
        self.fetch_latest = self._queries.fetch_latest
        self.offer_shapes = self._queries.offer_shapes
        self.shapes_of = self._queries.shapes_of
        if opened.routers:
            self.registry.has_router = True
            opened.routers.on_outage(self.registry.set_outage)
        opened.watch_tokens(f"{keys.domain_prefix(domain)}/p/**", self._on_token)

    def _on_token(self, key: str, exists: bool) -> None:
        if not exists:
            self.registry.remove(key)
        elif record := keys.parse_record(key):
            self.registry.add(key, record)

    def declare(self, record: PortRecord) -> None:
        """See `Presence`."""
        key = keys.record_key(self.domain, record)
        self._tokens[record] = self._session.liveliness().declare_token(key)

    def withdraw(self, record: PortRecord) -> None:
        """See `Presence`."""
        if token := self._tokens.pop(record, None):
            with contextlib.suppress(zenoh.ZError):  # the session is closed
                token.undeclare()

    def find_servers(self, interface: str, timeout: float) -> list[str]:
        """See `Presence`."""
        if not self.registry.wait("server", interface, lambda _record: True, timeout):
            return []
        # Links to other peers may still be made: ask all peers until their answers stay the same.
        end = monotonic() + timeout
        found, before = self._server_components(interface, timeout), None
        while found != before and monotonic() < end:
            sleep(SETTLE_S)
            found, before = self._server_components(interface, timeout), found
        return found

    def _server_components(self, interface: str, timeout: float) -> list[str]:
        """The components whose tokens the connected peers have, sorted."""
        key = f"{keys.domain_prefix(self.domain)}/p/server/**"
        replies = self._session.liveliness().get(key, timeout=timeout)
        samples = [reply.ok for reply in replies if reply.ok is not None]
        records = [keys.parse_record(str(sample.key_expr)) for sample in samples]
        return sorted({r.component for r in records if r and r.interface == interface})

    def publish_state(self, state: str) -> None:
        """See `Presence`."""
        before = self._state
        self._state = None
        if state:
            key = keys.state_key(self.domain, self._component, os.getpid(), state)
            try:
                self._state = self._session.liveliness().declare_token(key)
            except zenoh.ZError:
                # A hook that outlived the shutdown may get here later.
                if not self.registry.closed:
                    raise
        # The new state comes first; otherwise a monitor would see the component exit in between.
        if before:
            before.undeclare()

    def number_publications(self, at: Endpoint) -> PublicationCounter:
        """See `Presence`."""
        return PublicationCounter(self._session, self.domain, at)

    def publishers(self) -> PublisherRegistry:
        """See `Presence`."""
        if self._publishers is None:
            self._publishers = PublisherRegistry(self.opened, self.domain)
        return self._publishers

    def interrupt(self) -> None:
        """See `Presence`."""
        self.registry.interrupt()

    def close(self) -> None:
        """See `Presence`."""
        # Others that stop at the same time would be reported one by one.
        while self.opened.subscribers:
            with contextlib.suppress(zenoh.ZError):
                self.opened.subscribers.pop().undeclare()
        for record in list(self._tokens):
            self.withdraw(record)
        self.opened.close()
