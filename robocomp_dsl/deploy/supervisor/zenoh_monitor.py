"""Monitors components on zenoh through liveliness tokens with name, pid and state.

In: a domain. Out: every state change when it happens; the exit of a process within milliseconds.
"""

from __future__ import annotations

import threading
from typing import Any

import zenoh

from robocomp_dsl.deploy.status import SimulatedTime
from robocomp_dsl.deploy.supervisor.lifecycle_monitor import StateCallback
from robocomp_dsl.runtime.clock import NANO
from robocomp_dsl.runtime.connection.endpoint import Endpoint
from robocomp_dsl.runtime.errors import MalformedMessage
from robocomp_dsl.runtime.presence import keys
from robocomp_dsl.runtime.presence.domain_session import open_session
from robocomp_dsl.runtime.time.clock_interface import CLOCK

_TICK = CLOCK.operation("tick")


class ZenohMonitor:
    """A `LifecycleMonitor` over zenoh. Raises `MiddlewareError` if no session can be opened."""

    def __init__(self, domain: str) -> None:
        self._domain = domain
        self._states: dict[tuple[str, int], str] = {}
        self._lock = threading.Lock()
        self._session = open_session(domain)
        self._time: SimulatedTime | None = None
        key = keys.interface_key(domain, "t", Endpoint(CLOCK, "", ""))
        latest: Any = zenoh.handlers.RingChannel(1)
        self._ticks: Any = self._session.session.declare_subscriber(f"{key}/**", latest)

    def start(self, on_state_changed: StateCallback) -> None:
        """See `LifecycleMonitor`."""
        self._on_state_changed = on_state_changed
        self._subscriber = self._session.session.liveliness().declare_subscriber(
            f"{keys.domain_prefix(self._domain)}/s/**", self._on_token, history=True
        )

    def _on_token(self, sample: zenoh.Sample) -> None:
        token = keys.parse_state(str(sample.key_expr))
        if token is None:
            return
        name, pid, state = token
        with self._lock:
            if sample.kind != zenoh.SampleKind.DELETE:
                self._states[name, pid] = state
            elif self._states.get((name, pid)) == state:
                del self._states[name, pid]
                state = ""
            else:  # a newer state has already replaced this one
                return
            self._on_state_changed(name, pid, state)

    def simulated_time(self) -> SimulatedTime | None:
        """See `LifecycleMonitor`. Decodes only the latest tick."""
        try:
            sample = self._ticks.handler.try_recv()
            tick = _TICK.decode_request(sample.payload.to_bytes())[0] if sample else None
        except (zenoh.ZError, MalformedMessage):
            tick = None
        if tick is not None:
            factor = tick.realTimeFactor
            self._time = SimulatedTime(tick.time / NANO, factor, tick.epoch, tick.paused)
        return self._time

    def close(self) -> None:
        """See `LifecycleMonitor`."""
        self._session.close()
