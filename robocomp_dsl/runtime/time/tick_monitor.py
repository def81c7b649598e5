"""The latest tick of a domain's clock source, for programs that only look at it.

In: a session of the domain. Out: the tick, decoded when it is asked for: a simulator publishes up
to a thousand a second.
"""

from __future__ import annotations

from typing import Any

import zenoh

from robocomp_dsl.runtime.connection.endpoint import Endpoint
from robocomp_dsl.runtime.errors import MalformedMessage
from robocomp_dsl.runtime.presence import keys
from robocomp_dsl.runtime.time.clock_interface import CLOCK, Tick

_TICK = CLOCK.operation("tick")


class TickMonitor:
    """Receives the ticks of all clock sources of a domain."""

    def __init__(self, session: zenoh.Session, domain: str) -> None:
        key = keys.interface_key(domain, "t", Endpoint(CLOCK, "", ""))
        latest: Any = zenoh.handlers.RingChannel(1)
        self._ticks: Any = session.declare_subscriber(f"{key}/**", latest)

    def latest(self) -> Tick | None:
        """The tick that has arrived since the last call; None if there is none."""
        try:
            sample = self._ticks.handler.try_recv()
            if sample is None:
                return None
            tick: Tick = _TICK.decode_request(sample.payload.to_bytes())[0]
        except (zenoh.ZError, MalformedMessage):
            return None
        return tick
