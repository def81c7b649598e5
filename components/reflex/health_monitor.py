"""Monitors skin and arm: without both the reflex is frozen, which is an emergency.

In: heartbeats of skin and arm, their replies, the time. Out: the event `lost`; after recovery the
event `found`, or `resumed` if the arm had been moved away.
"""

from __future__ import annotations

from collections.abc import Callable
from math import inf

from heartbeats import Heartbeats
from messages import arm_properties
from reflex_service import ReflexService

from robocomp_dsl.runtime.clock import CLOCK_LOST
from robocomp_dsl.runtime.errors import DeclaredError, MiddlewareError
from robocomp_dsl.tactile.errors import TactileError
from robocomp_dsl.tactile.reflex.withdrawal import ArmProperties
from robocomp_dsl.tactile.skin.geometry_message import geometry_from_message

SKIN_TIMEOUT_S = 2.0
"""Time-out of a request for the geometry of the skin, which can be large."""
RETRY_S = 0.1
"""Period of retries after a request that failed or was rejected."""
QUERY_PERIOD_S = 1.0
"""Period of queries while no frames arrive: skin or arm may have been replaced."""


class HealthMonitor(ReflexService):
    """`arm` is None while its properties are unknown; `away`: the reflex has moved it away.

    `stop_refusal` says why the arm rejected the latest `stop`, `unknown_reason` why the properties
    of arm and skin are unknown.
    """

    arm: ArmProperties | None = None
    away = suspected = False
    stop_refusal = unknown_reason = ""
    reason = "no data received from skin and arm yet"

    def initialize(self) -> None:
        """Set the time-outs; skin and arm may start later."""
        self.heartbeats, self.reset_count = Heartbeats(), self.clock.reset_count
        self.queried = self.stop_sent = -inf
        self.skin_proxy.set_timeout(SKIN_TIMEOUT_S)
        self.genericarm_proxy.set_timeout(self.params.arm_timeout)

    def compute(self) -> None:
        """Check skin and arm, and freeze if one of them is lost."""
        now = self._now()
        if not self.machine.is_in("Frozen"):
            reason, suspected = self._missing(now), self.suspected
            # After a delay of this component, queued messages are handled before the next cycle.
            self.suspected = bool(reason)
            if not reason and self.sense.validator.is_outdated:
                reason, suspected = self.failure_of(self._fetch_geometry), True
            if reason and suspected:
                self.freeze(reason)
        if self.machine.is_in("Frozen"):
            self.declare_emergency(self.reason)

    def emergency(self) -> None:
        """Retry until skin and arm have been healthy for the recovery time."""
        now = self._now()
        if self.clock.is_stale:
            reason = CLOCK_LOST
            if not self.machine.is_in("Frozen"):
                self.freeze(reason)
                self.declare_emergency(reason)
        else:
            reason = self._stop_failure(now) or self._unknown_reason(now) or self._missing(now)
        if not reason:
            if self.heartbeats.healthy_for(now) >= self.params.recovery:
                self.end_emergency()
            return
        self.heartbeats.healthy_since = inf
        if self._is_blind(now):
            self.sense.validator.reset_sequence()  # a restarted sender counts from 0 again
        if reason != self.reason:
            self.reason = reason
            self.declare_emergency(reason)

    def restore(self) -> None:
        """Leave `Frozen`; an arm that had been moved away returns."""
        if self.machine.is_in("Frozen"):
            self.log.info("skin and arm are available")
            self.machine.send("resumed" if self.away else "found")

    def freeze(self, reason: str) -> None:
        """Enter `Frozen` and log the reason."""
        self.reason = reason
        self.log.warning("frozen: %s", reason)
        self.machine.send("lost")

    def release_arm(self) -> None:
        """Stop the arm, and discard the properties of arm and skin."""
        if self.arm is not None:
            self._stop(self.clock.now())
        self.arm, self.queried, self.heartbeats.healthy_since = None, -inf, inf

    def failure_of(self, call: Callable[[], object]) -> str:
        """The message of the error that `call` raises; empty if it succeeds."""
        try:
            call()
        except (MiddlewareError, DeclaredError, TactileError, ValueError) as error:
            return str(getattr(error, "what", error)) or type(error).__name__
        return ""

    def on_time_reset(self) -> None:
        """Discard all recorded times: the clock was reset."""
        self.heartbeats = Heartbeats()
        self.queried = self.stop_sent = -inf

    def _now(self) -> float:
        before, self.reset_count = self.reset_count, self.clock.reset_count
        if before not in (-1, self.reset_count):  # -1: time had not started
            self.on_time_reset()
            self.freeze("the simulated clock was reset")
        return self.clock.now()

    def _missing(self, now: float) -> str:
        return self.heartbeats.missing(now, self.params.frame_timeout, self.params.arm_timeout)

    def _is_blind(self, now: float) -> bool:
        return self.heartbeats.is_blind(now, self.params.frame_timeout)

    def _stop(self, now: float) -> None:
        self.stop_sent, self.stop_refusal = now, self.failure_of(self.genericarm_proxy.stop)

    def _stop_failure(self, now: float) -> str:
        """Why the arm may still be moving; `stop` is repeated until it is accepted."""
        if self.stop_refusal and now - self.stop_sent >= RETRY_S:
            self._stop(now)
        return self.stop_refusal

    def _unknown_reason(self, now: float) -> str:
        """Why arm or skin are unknown; they are queried periodically."""
        unknown = self.arm is None or self.unknown_reason
        if (unknown and now - self.queried >= RETRY_S) or (
            self._is_blind(now) and now - self.queried >= QUERY_PERIOD_S
        ):
            self.queried, self.unknown_reason = now, self.failure_of(self._fetch_properties)
        return self.unknown_reason

    def _fetch_properties(self) -> None:
        """Fetch the properties of arm and skin. Raises what `failure_of` handles."""
        self._fetch_geometry()
        self.arm = arm_properties(self.genericarm_proxy.getLimits(), self.size)

    def _fetch_geometry(self) -> None:
        self.sense.adopt(geometry_from_message(self.skin_proxy.getGeometry()))
