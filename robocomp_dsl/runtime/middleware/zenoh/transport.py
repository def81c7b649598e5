"""zenoh transport: queryables, queriers, publishers and subscribers in the session of the presence.

In: a `TransportContext`. Out: a `Transport`. The address of a port is the id of its session.
"""

from __future__ import annotations

import zenoh

from robocomp_dsl.runtime.connection.endpoint import Endpoint
from robocomp_dsl.runtime.connection.incoming_port import IncomingPort
from robocomp_dsl.runtime.middleware.transport import TransportContext
from robocomp_dsl.runtime.middleware.zenoh.client import ZenohServiceClient
from robocomp_dsl.runtime.middleware.zenoh.held_publisher import HOLD_S
from robocomp_dsl.runtime.middleware.zenoh.publisher import ZenohPublisher
from robocomp_dsl.runtime.middleware.zenoh.server import ServedZenohPort
from robocomp_dsl.runtime.presence.domain_session import DomainSession, open_session
from robocomp_dsl.runtime.presence.port_record import PortRecord
from robocomp_dsl.runtime.presence.zenoh_presence import ZenohPresence


def open_transport(context: TransportContext) -> ZenohTransport:
    """The transport that shares the session of the presence."""
    presence: ZenohPresence = context.house
    return ZenohTransport(context.domain, presence.opened)


class ZenohTransport:
    """All zenoh connections of one component."""

    def __init__(self, domain: str, opened: DomainSession) -> None:
        self._domain = domain
        self._session = opened.session
        self._network = opened.network
        self._id = str(opened.session.info.zid())
        self._reliable: DomainSession | None = None

    def serve(self, port: IncomingPort) -> ServedZenohPort:
        """See `Transport`."""
        served = ServedZenohPort(port, self._domain, self._id)
        served.serve(self._session)
        return served

    def connect(self, at: Endpoint, server: PortRecord, timeout: float) -> ZenohServiceClient:
        """See `Transport`."""
        return ZenohServiceClient(self._session, self._domain, at, server, timeout)

    def advertise(self, at: Endpoint) -> ZenohPublisher:
        """See `Transport`."""
        session = self._reliable_session() if at.qos.holds_publisher else self._session
        return ZenohPublisher(session, self._domain, at, self._id)

    def _reliable_session(self) -> zenoh.Session:
        """A second session for reliable publishers: it waits before it drops a message."""
        if self._reliable is None:
            self._reliable = open_session(self._domain, hold_s=HOLD_S, network=self._network)
        return self._reliable.session

    def subscribe(self, port: IncomingPort) -> ServedZenohPort:
        """See `Transport`."""
        served = ServedZenohPort(port, self._domain, self._id)
        served.subscribe(self._session)
        return served

    def close(self) -> None:
        """See `Transport`; the presence closes the shared session."""
        if self._reliable:
            self._reliable.close()
