"""Whether skin and arm are there, and usable: without them the reflex is frozen, an emergency.

In: when they were heard of, their answers, the time. Out: the events `lost`, and when all has been
there again for a while, `found`, or `resumed` where the arm had been sent away.
"""

from __future__ import annotations

from collections.abc import Callable
from math import inf

from presence import Presence
from served import Served
from wire import arm_facts

from robocomp_dsl.runtime.clock import TIMELESS
from robocomp_dsl.runtime.errors import DeclaredError, MiddlewareError
from robocomp_dsl.tactile.errors import TactileError
from robocomp_dsl.tactile.reflex.withdrawal import ArmFacts
from robocomp_dsl.tactile.skin.told import told_geometry

SKIN_ANSWERS_S = 2.0
"""How long the skin may take for its geometry, which can be long."""
AGAIN_S = 0.1
"""What was refused, or not answered, is tried so often."""
ASK_AGAIN_S = 1.0
"""While the reflex is blind it asks so often what is there: it may be another skin, another arm."""


class Lookout(Served):
    """`arm` is None while nothing is known of it; `away`: the reflex has sent it away.

    `refusal` is why it did not take the latest `stop`, `ignorance` why arm and skin are not known.
    """

    arm: ArmFacts | None = None
    away = doubted = False
    refusal = ignorance = ""
    reason = "skin and arm have not been heard of yet"

    def initialize(self) -> None:
        """Skin and arm need not be there yet."""
        self.presence, self.epoch = Presence(), self.clock.epoch
        self.asked = self.told = -inf
        self.skin_proxy.set_timeout(SKIN_ANSWERS_S)
        self.genericarm_proxy.set_timeout(self.params.arm_timeout)

    def compute(self) -> None:
        """See whether all is there; what is to be done then is up to the states."""
        now = self._now()
        if not self.machine.is_in("Frozen"):
            reason, doubted = self._missing(now), self.doubted
            # Who was held up itself has messages waiting; by the next look they are handled.
            self.doubted = bool(reason)
            if not reason and self.sense.gate.behind:
                reason, doubted = self.tried(self._learn_geometry), True
            if reason and doubted:
                self.freeze(reason)
        if self.machine.is_in("Frozen"):
            self.declare_emergency(self.reason)

    def emergency(self) -> None:
        """Look for what is missing, until all has been there for a while."""
        now = self._now()
        if self.clock.silent:
            reason = TIMELESS
            if not self.machine.is_in("Frozen"):
                self.freeze(reason)
                self.declare_emergency(reason)
        else:
            reason = self._not_stopped(now) or self._not_known(now) or self._missing(now)
        if not reason:
            if self.presence.well_for(now) >= self.params.recovery:
                self.end_emergency()
            return
        self.presence.well_since = inf
        if self._is_blind(now):
            self.sense.gate.forget()  # those who send may have begun to count anew
        if reason != self.reason:
            self.reason = reason
            self.declare_emergency(reason)

    def restore(self) -> None:
        """All is there again: an arm that was on its way comes back."""
        if self.machine.is_in("Frozen"):
            self.log.info("skin and arm are there")
            self.machine.go("resumed" if self.away else "found")

    def freeze(self, reason: str) -> None:
        """Go to `Frozen`, and say why."""
        self.reason = reason
        self.log.warning("frozen: %s", reason)
        self.machine.go("lost")

    def let_go(self) -> None:
        """Stop the arm, and believe nothing any more that was known of it and of the skin."""
        if self.arm is not None:
            self._stop(self.clock.now())
        self.arm, self.asked, self.presence.well_since = None, -inf, inf

    def tried(self, call: Callable[[], object]) -> str:
        """Why the call failed, in words; empty: it did not."""
        try:
            call()
        except (MiddlewareError, DeclaredError, TactileError, ValueError) as error:
            return str(getattr(error, "what", error)) or type(error).__name__
        return ""

    def begin_anew(self) -> None:
        """Time has begun anew: no moment that was kept means anything."""
        self.presence = Presence()
        self.asked = self.told = -inf

    def _now(self) -> float:
        before, self.epoch = self.epoch, self.clock.epoch
        if before not in (-1, self.epoch):  # -1: it had not begun at all
            self.begin_anew()
            self.freeze("time has begun anew")
        return self.clock.now()

    def _missing(self, now: float) -> str:
        return self.presence.missing(now, self.params.frame_timeout, self.params.arm_timeout)

    def _is_blind(self, now: float) -> bool:
        return self.presence.is_blind(now, self.params.frame_timeout)

    def _stop(self, now: float) -> None:
        self.told, self.refusal = now, self.tried(self.genericarm_proxy.stop)

    def _not_stopped(self, now: float) -> str:
        """Why the arm may still be moving; it is told to stop now and then, until it does."""
        if self.refusal and now - self.told >= AGAIN_S:
            self._stop(now)
        return self.refusal

    def _not_known(self, now: float) -> str:
        """Why arm or skin are not known; they are asked now and then."""
        unknown = self.arm is None or self.ignorance
        if (unknown and now - self.asked >= AGAIN_S) or (
            self._is_blind(now) and now - self.asked >= ASK_AGAIN_S
        ):
            self.asked, self.ignorance = now, self.tried(self._learn)
        return self.ignorance

    def _learn(self) -> None:
        """Ask arm and skin about themselves. Raises what `tried` takes."""
        self._learn_geometry()
        self.arm = arm_facts(self.genericarm_proxy.getLimits(), self.size)

    def _learn_geometry(self) -> None:
        self.sense.adopt(told_geometry(self.skin_proxy.getGeometry()))
