"""The watch of deployments on zenoh: liveliness tokens that say component, pid and state.

In: a domain. Out: every change of state, as it happens; the death of a process within milliseconds.
"""

from __future__ import annotations

import threading
from typing import Any

import zenoh

from robocomp_dsl.deploy.engines.watch import Seen
from robocomp_dsl.deploy.status import Time
from robocomp_dsl.runtime.clock import NANO
from robocomp_dsl.runtime.clock_interface import CLOCK
from robocomp_dsl.runtime.errors import MalformedMessage
from robocomp_dsl.runtime.middleware.base import Endpoint
from robocomp_dsl.runtime.middleware.zenoh import keys
from robocomp_dsl.runtime.middleware.zenoh.discovery import open_session

_TICK = CLOCK.operation("tick")


class ZenohWatch:
    """A session that only looks on. Raises `MiddlewareError` when it cannot be opened."""

    def __init__(self, domain: str) -> None:
        self._domain = domain
        self._states: dict[tuple[str, int], str] = {}
        self._lock = threading.Lock()
        self._opened = open_session(domain)
        self._time: Time | None = None
        key = keys.interface_key(domain, "t", Endpoint(CLOCK, "", ""))
        latest: Any = zenoh.handlers.RingChannel(1)
        self._ticks: Any = self._opened.session.declare_subscriber(f"{key}/**", latest)

    def start(self, seen: Seen) -> None:
        """See `Watch`."""
        self._seen = seen
        self._subscriber = self._opened.session.liveliness().declare_subscriber(
            f"{keys.root(self._domain)}/s/**", self._hear, history=True
        )

    def _hear(self, sample: zenoh.Sample) -> None:
        found = keys.parse_state(str(sample.key_expr))
        if found is None:
            return
        name, pid, state = found
        with self._lock:
            if sample.kind != zenoh.SampleKind.DELETE:
                self._states[name, pid] = state
            elif self._states.get((name, pid)) == state:
                del self._states[name, pid]
                state = ""
            else:  # the end of a state that a newer one has followed
                return
            self._seen(name, pid, state)

    def time(self) -> Time | None:
        """See `Watch`. Nothing is done for the ticks between two looks."""
        try:
            sample = self._ticks.handler.try_recv()
            tick = _TICK.decode_request(sample.payload.to_bytes())[0] if sample else None
        except (zenoh.ZError, MalformedMessage):
            tick = None
        if tick is not None:
            factor = tick.realTimeFactor
            self._time = Time(tick.time / NANO, factor, tick.epoch, tick.paused)
        return self._time

    def close(self) -> None:
        """See `Watch`."""
        self._opened.close()
