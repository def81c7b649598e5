"""When the reflex acts: withdraw, hold, return; freeze when blind or when the robot is silent.

In: frames, arm states and the time, as the caller has them. Out: at most one `Move` or `Stop` each
time. Nothing here reads a clock or knows a robot: the arm is generic, the fields are data.

    WATCHING -> WITHDRAWING -> HOLDING -> RETURNING -> WATCHING        any -> FROZEN -> RETURNING

For the refractory time after a withdrawal began no new one begins; a touch that grows stronger or
reaches another field adds to the motion instead. A touch that lasts longer triggers again.
"""

from __future__ import annotations

from dataclasses import dataclass, field
from enum import StrEnum

import numpy as np

from robocomp_dsl.tactile.arrays import Floats
from robocomp_dsl.tactile.reflex.law import Response


class ReflexState(StrEnum):
    """What the reflex is doing."""

    WATCHING = "watching"
    WITHDRAWING = "withdrawing"
    HOLDING = "holding"
    RETURNING = "returning"
    FROZEN = "frozen"


@dataclass(frozen=True, slots=True)
class ReflexSettings:
    """Times in seconds; speeds as shares of the joints' own limits; angles in radians.

    `patience` is how long a motion may take before the reflex goes on without it; `recovery` how
    long frames and arm must be there again before it leaves the frozen state.
    """

    refractory: float = 1.0
    hold: float = 0.5
    frame_timeout: float = 0.2
    arm_timeout: float = 0.5
    recovery: float = 0.5
    patience: float = 3.0
    withdraw_speed: float = 1.0
    return_speed: float = 0.2
    arrived: float = 0.03
    least_change: float = 0.01

    def __post_init__(self) -> None:
        if not all(0.0 < share <= 1.0 for share in (self.withdraw_speed, self.return_speed)):
            raise ValueError("speeds are shares between 0 and 1")
        times = (self.refractory, self.hold, self.recovery)
        if min(times) < 0.0 or min(self.frame_timeout, self.arm_timeout, self.patience) <= 0.0:
            raise ValueError("times must not be negative, timeouts must be positive")


@dataclass(frozen=True, slots=True, eq=False)
class Move:
    """Go to `position` (n,) [rad] at reference speeds `speed` (n,) [rad/s]."""

    position: Floats
    speed: Floats


@dataclass(frozen=True, slots=True)
class Stop:
    """End every motion now."""


@dataclass(frozen=True, eq=False)
class ArmFacts:
    """What the reflex must know of its arm, all (n,): limits, speed limits and start pose."""

    low: Floats
    high: Floats
    speed: Floats
    start: Floats


@dataclass(slots=True)
class ReflexEngine:
    """The reflex of one arm. Call `frame` and `arm` as data come, `tick` in between."""

    facts: ArmFacts
    settings: ReflexSettings = field(default_factory=ReflexSettings)
    state: ReflexState = ReflexState.WATCHING
    withdrawals: int = 0
    _gains: dict[str, Response] = field(default_factory=dict)
    _pose: Floats | None = None
    _origin: Floats = field(default_factory=lambda: np.empty(0))
    _target: Floats = field(default_factory=lambda: np.empty(0))
    _since: float = -np.inf
    _triggered: float = -np.inf
    _touched: float = -np.inf
    _last_frame: float = -np.inf
    _last_arm: float = -np.inf
    _well_since: float = np.inf

    def frame(self, responses: list[Response], now: float) -> Move | Stop | None:
        """Take in what the fields answer to a good frame that came at `now`."""
        self._last_frame = now
        if responses:
            self._touched = now
            if self._may_trigger(now):
                return self._trigger(responses, now)
            if self.state in (ReflexState.WITHDRAWING, ReflexState.HOLDING):
                return self._strengthen(responses, now)
        return self.tick(now)

    def arm(self, position: Floats, now: float) -> Move | Stop | None:
        """Take in the generic angles (n,) that the arm had at `now`."""
        self._pose, self._last_arm = position, now
        return self.tick(now)

    def tick(self, now: float) -> Move | Stop | None:
        """Let time pass."""
        if self.state is ReflexState.FROZEN:
            return self._thaw(now)
        if self._started and not self._well(now):
            self._enter(ReflexState.FROZEN, now)
            self._well_since = np.inf
            return Stop()
        waited = now - self._since
        if self.state is ReflexState.WITHDRAWING and (
            self._there or waited > self.settings.patience
        ):
            self._enter(ReflexState.HOLDING, now)
        elif self.state is ReflexState.HOLDING:
            if now - max(self._touched, self._since) >= self.settings.hold:
                return self._return(now)
        elif self.state is ReflexState.RETURNING and (
            self._there or waited > self.settings.patience
        ):
            self._enter(ReflexState.WATCHING, now)
        return None

    def refused(self, now: float) -> None:
        """The arm did not take a command: be frozen until all is well again."""
        self._enter(ReflexState.FROZEN, now)
        self._well_since = np.inf

    @property
    def active(self) -> tuple[Response, ...]:
        """The strongest response of each field in the present or last withdrawal."""
        return tuple(self._gains.values())

    @property
    def _started(self) -> bool:
        """Whether both frames and arm have ever been there."""
        return self._last_frame > -np.inf and self._last_arm > -np.inf

    @property
    def _there(self) -> bool:
        if self._pose is None:
            return False
        return bool(np.abs(self._pose - self._target).max() <= self.settings.arrived)

    def _well(self, now: float) -> bool:
        seen = now - self._last_frame <= self.settings.frame_timeout
        return seen and now - self._last_arm <= self.settings.arm_timeout

    def _may_trigger(self, now: float) -> bool:
        ready = self.state is not ReflexState.FROZEN
        fresh = self._pose is not None and now - self._last_arm <= self.settings.arm_timeout
        return ready and fresh and now - self._triggered >= self.settings.refractory

    def _trigger(self, responses: list[Response], now: float) -> Move | None:
        """A withdrawal begins from where the arm is."""
        assert self._pose is not None  # noqa: S101 - `_may_trigger` has seen it
        self._gains, self._origin, self._triggered = {}, self._pose, now
        self._target = self._pose.copy()
        self.withdrawals += 1
        self._enter(ReflexState.WITHDRAWING, now)
        return self._strengthen(responses, now)

    def _strengthen(self, responses: list[Response], now: float) -> Move | None:
        """Each field counts with its strongest response so far; their motions add up."""
        for one in responses:
            known = self._gains.get(one.field.name)
            if known is None or one.gain > known.gain:
                self._gains[one.field.name] = one
        motion = sum((one.motion for one in self._gains.values()), np.zeros(len(self._origin)))
        target = np.clip(self._origin + motion, self.facts.low, self.facts.high)
        if np.abs(target - self._target).max() < self.settings.least_change:
            return None
        self._target = target
        self._enter(ReflexState.WITHDRAWING, now)
        return Move(target, self.settings.withdraw_speed * self.facts.speed)

    def _return(self, now: float) -> Move:
        self._target = np.clip(self.facts.start, self.facts.low, self.facts.high)
        self._enter(ReflexState.RETURNING, now)
        return Move(self._target, self.settings.return_speed * self.facts.speed)

    def _thaw(self, now: float) -> Move | None:
        """Leave the frozen state when frames and arm have been there for a while."""
        if not self._well(now):
            self._well_since = np.inf
            return None
        self._well_since = min(self._well_since, now)
        return self._return(now) if now - self._well_since >= self.settings.recovery else None

    def _enter(self, state: ReflexState, now: float) -> None:
        self.state, self._since = state, now
