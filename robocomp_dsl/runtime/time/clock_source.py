"""The clock source: simulated time of the component that all others follow.

In: the times for which the lifecycle of the source waits, a speed, a wall clock. Out: ticks. Time
advances only in `wait_until`: it waits for the wall clock, then sets the time. A simulator that
advances its world to `clock.now()` in every `compute` therefore needs no pacing of its own; its
period is the resolution of simulated time. A pre-tick hook advances the world before each tick.
"""

from __future__ import annotations

import threading
import time
from collections.abc import Callable
from functools import partial
from typing import Protocol

from robocomp_dsl.runtime.clock import NANO, WakeEvent
from robocomp_dsl.runtime.deprecated import DeprecatedClockNames
from robocomp_dsl.runtime.time.clock_interface import Tick

MAX_CATCH_UP_S = 0.1
"""A delayed source catches up at most this much; the rest is lost, and time runs slower."""
RTF_WINDOW_S = 0.5
"""Wall time over which the real-time factor is measured."""
HEARTBEAT_S = 0.5
"""Period in which a source publishes its tick while time does not advance."""


class StepCoordinator(Protocol):
    """Coordinates the members of a lock-step deployment between two steps of the source."""

    def connect(self, over: Callable[[], bool]) -> None:
        """Find all members. Returns early if `over()`."""

    def next_due(self) -> int | None:
        """Time in ns when the first member is due; None: never."""

    def run_due(self, tick: Tick) -> None:
        """Run all members that are due at `tick`."""


class ClockSource(DeprecatedClockNames):
    """A `Clock` that its component's lifecycle advances. Any thread may control it."""

    is_stale = False

    def __init__(
        self,
        publish: Callable[[Tick], None],
        steps: StepCoordinator | None = None,
        speed: float = 1.0,
        wall: Callable[[], float] = time.monotonic,
    ) -> None:
        self._publish = publish
        self._coordinator = steps
        self._speed = speed
        self._wall = wall
        self._changed = threading.Condition()
        self._ns = 0
        self._resets = 0
        self._started = False
        self._resets_seen = 0
        self._paused = False
        self._step_end = 0
        self._pre_tick_hook: Callable[[float, int], None] | None = None
        self._anchor = (0.0, 0)
        self._window = (0.0, 0)
        self._factor = 0.0

    @property
    def reset_count(self) -> int:
        """See `Clock`."""
        return self._resets if self._started else -1

    @property
    def speed(self) -> float:
        """Requested real-time factor; 0: as fast as possible."""
        return self._speed

    @property
    def paused(self) -> bool:
        """Whether time is paused."""
        return self._paused

    @property
    def current_tick(self) -> Tick:
        """The present time as a tick."""
        return Tick(self._ns, self._resets, 0.0 if self._paused else self._factor, self._paused)

    @property
    def nanoseconds(self) -> int:
        """The present time in ns."""
        return self._ns

    def now(self) -> float:
        """Simulated seconds since the last reset."""
        return self._ns / NANO

    def set_speed(self, factor: float) -> None:
        """Set the real-time factor; 0: as fast as possible. Raises `ValueError`."""
        if not 0 <= factor < float("inf"):
            raise ValueError(f"invalid speed {factor:g}: use 0 (as fast as possible) or more")
        with self._changed:
            self._speed = factor
            self._re_anchor()

    def pause(self) -> None:
        """Pause time."""
        with self._changed:
            self._paused = True
            self._re_anchor()

    def resume(self) -> None:
        """Resume time."""
        with self._changed:
            self._paused = False
            self._step_end = 0
            self._re_anchor()

    def step(self, seconds: float) -> None:
        """While paused, advance by `seconds`, as fast as possible."""
        with self._changed:
            if self._paused:
                self._step_end = max(self._step_end, self._ns) + round(seconds * NANO)
                self._changed.notify_all()

    def wait_step_done(self, timeout: float) -> bool:
        """Wait until the time of `step` has passed.

        False if time did not advance for `timeout` s of wall time; the rest of the step is
        cancelled.
        """
        with self._changed:
            while (left := self._step_end - self._ns) > 0:
                if not self._changed.wait_for(partial(self._has_progressed, left), timeout):
                    self._step_end = 0
                    return False
        return True

    def _has_progressed(self, left: int) -> bool:
        """Whether less than `left` ns of a step remain."""
        return self._step_end - self._ns < left

    def reset(self, seconds: float = 0.0) -> None:
        """Reset time to `seconds`, for all components."""
        with self._changed:
            self._resets += 1
            self._ns = round(seconds * NANO)
            self._step_end = 0
            self._re_anchor()

    def set_pre_tick_hook(self, hook: Callable[[float, int], None]) -> None:
        """Call the hook with `(seconds, reset_count)` before each tick, from the waiting thread."""
        self._pre_tick_hook = hook

    def wait_until(self, moment: float | None, wake: WakeEvent) -> None:
        """See `Clock`: advance time to `moment`, no faster than the speed allows."""
        wake.on_set = self._notify
        if not self._started:
            self._start(wake)
        elif moment is not None:
            self._advance(round(moment * NANO), wake)
        else:
            with self._changed:
                self._changed.wait_for(lambda: wake.is_set() or self._was_reset)
        self._resets_seen = self._resets

    @property
    def _was_reset(self) -> bool:
        return self._resets != self._resets_seen

    def _start(self, wake: WakeEvent) -> None:
        if self._coordinator:
            self._coordinator.connect(lambda: wake.stopped)
        with self._changed:
            self._re_anchor()
            self._started = True
        self._publish(self.current_tick)

    def _advance(self, target: int, wake: WakeEvent) -> None:
        """Advance to `target` ns, stopping at each time when a member is due."""
        if self._coordinator and not wake.stopped:
            self._coordinator.run_due(self.current_tick)
            while (due := self._coordinator.next_due()) is not None and due < target:
                if self._was_reset or not self._advance_to(due, wake):
                    return
                self._coordinator.run_due(self.current_tick)
        self._advance_to(target, wake)

    def _advance_to(self, target: int, wake: WakeEvent) -> bool:
        """Wait for the wall clock, then set the time to `target`; False if interrupted."""
        target = max(target, self._ns)
        while (goal := self._wait_for_goal(target, wake)) is not None:
            if self._pre_tick_hook:
                self._pre_tick_hook(goal / NANO, self._resets_seen)
            with self._changed:
                if self._was_reset:
                    break
                self._ns = goal
                self._measure_rtf()
                self._changed.notify_all()
            self._publish(self.current_tick)
            if goal == target:
                return True
        self._publish(self.current_tick)
        return False

    def _wait_for_goal(self, target: int, wake: WakeEvent) -> int | None:
        """Wait until time may be `target`, or the end of a step before it; None: interrupted."""
        with self._changed:
            while not wake.is_set() and not self._was_reset:
                goal = min(target, self._step_end) if self._paused else target
                if (left := self._wall_time_left(goal)) <= 0:
                    return goal
                if not self._changed.wait(min(left, HEARTBEAT_S)) and left >= HEARTBEAT_S:
                    self._publish(self.current_tick)
        return None

    def _wall_time_left(self, target: int) -> float:
        """Seconds of wall time until time may be `target`."""
        if self._paused:
            return 0.0 if target > self._ns else HEARTBEAT_S
        if not self._speed:
            return 0.0
        wall, ns = self._anchor
        left = wall + (target - ns) / NANO / self._speed - self._wall()
        if left < -MAX_CATCH_UP_S:
            self._anchor = (self._wall(), target)
        return left

    def _measure_rtf(self) -> None:
        wall, (since, before) = self._wall(), self._window
        if wall - since >= RTF_WINDOW_S:
            self._factor = (self._ns - before) / NANO / (wall - since)
            self._window = (wall, self._ns)

    def _re_anchor(self) -> None:
        """Restart pacing from here after a change of speed or a pause, and wake the waiter."""
        self._anchor = self._window = (self._wall(), self._ns)
        self._changed.notify_all()

    def _notify(self) -> None:
        with self._changed:
            self._changed.notify_all()
