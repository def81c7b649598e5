"""Simulated time where it is made: the clock of the component that all others follow.

In: the moments for which the source's own life cycle waits, a speed, a wall clock. Out: ticks. The
time moves only in `wait_until`: it waits until the wall clock is there, and then it is that moment.
So a simulator that advances its world to `clock.now()` in every `compute` needs no pacing of its
own; its period is the resolution of the deployment's time. A world that is to be there before
anybody is told so (`carry`) goes along at every move, also at those between two computes.
"""

from __future__ import annotations

import threading
import time
from collections.abc import Callable
from functools import partial
from typing import Protocol

from robocomp_dsl.runtime.clock import NANO, Wake
from robocomp_dsl.runtime.clock_interface import Tick

BEHIND_S = 0.1
"""How much a source that was held up makes good; what is more is lost, and time runs slower."""
FACTOR_S = 0.5
"""Time of the wall clock over which the real-time factor is taken."""
BEAT_S = 0.5
"""A source whose time does not move says so again after this time: it is there."""


class Steps(Protocol):
    """What has to happen between two steps of the source; in lock-step the others' computes."""

    def meet(self, over: Callable[[], bool]) -> None:
        """Find all who take part. Ends early where `over()`."""

    def next(self) -> int | None:
        """When the first of the others has something to do, in ns."""

    def run(self, tick: Tick) -> None:
        """Let all do what is due by now."""


class ClockSource:
    """A `Clock` that its owner's life cycle drives. Any thread may control it."""

    silent = False

    def __init__(
        self,
        publish: Callable[[Tick], None],
        steps: Steps | None = None,
        speed: float = 1.0,
        wall: Callable[[], float] = time.monotonic,
    ) -> None:
        self._publish = publish
        self._steps = steps
        self._speed = speed
        self._wall = wall
        self._changed = threading.Condition()
        self._ns = 0
        self._resets = 0
        self._began = False
        self._lived = 0
        self._paused = False
        self._until = 0
        self._carry: Callable[[float, int], None] | None = None
        self._anchor = (0.0, 0)
        self._window = (0.0, 0)
        self._factor = 0.0

    @property
    def epoch(self) -> int:
        """See `Clock`."""
        return self._resets if self._began else -1

    @property
    def speed(self) -> float:
        """Simulated seconds per second that are wanted; 0: as many as possible."""
        return self._speed

    @property
    def paused(self) -> bool:
        """Whether time stands still."""
        return self._paused

    @property
    def told(self) -> Tick:
        """The present, as it is told to others."""
        return Tick(self._ns, self._resets, 0.0 if self._paused else self._factor, self._paused)

    @property
    def nanoseconds(self) -> int:
        """The present."""
        return self._ns

    def now(self) -> float:
        """Simulated seconds since the last reset."""
        return self._ns / NANO

    def set_speed(self, factor: float) -> None:
        """Simulated seconds per second; 0: as fast as possible. Raises `ValueError`."""
        if not 0 <= factor < float("inf"):
            raise ValueError(f"{factor:g} is no speed: it is 0 (as fast as possible) or more")
        with self._changed:
            self._speed = factor
            self._re_anchor()

    def pause(self) -> None:
        """Let time stand still."""
        with self._changed:
            self._paused = True
            self._re_anchor()

    def resume(self) -> None:
        """Let time go on."""
        with self._changed:
            self._paused = False
            self._until = 0
            self._re_anchor()

    def step(self, seconds: float) -> None:
        """While it is paused, let so much time pass, as fast as possible."""
        with self._changed:
            if self._paused:
                self._until = max(self._until, self._ns) + round(seconds * NANO)
                self._changed.notify_all()

    def stepped(self, patience: float) -> bool:
        """Wait until what `step` lets pass has passed.

        False when time did not move for `patience` s of the wall clock; the rest is taken back.
        """
        with self._changed:
            while (left := self._until - self._ns) > 0:
                if not self._changed.wait_for(partial(self._is_nearer, left), patience):
                    self._until = 0
                    return False
        return True

    def _is_nearer(self, left: int) -> bool:
        """Whether less than `left` ns of a step are left."""
        return self._until - self._ns < left

    def reset(self, seconds: float = 0.0) -> None:
        """Time begins anew, at `seconds`, for all."""
        with self._changed:
            self._resets += 1
            self._ns = round(seconds * NANO)
            self._until = 0
            self._re_anchor()

    def carry(self, along: Callable[[float, int], None]) -> None:
        """Call `along(seconds, epoch)` just before it is `seconds`, from the thread that waits."""
        self._carry = along

    def wait_until(self, moment: float | None, wake: Wake) -> None:
        """See `Clock`: time goes on to `moment`, no faster than the speed allows."""
        wake.listener = self._notify
        if not self._began:
            self._begin(wake)
        elif moment is not None:
            self._go(round(moment * NANO), wake)
        else:
            with self._changed:
                self._changed.wait_for(lambda: wake.is_set() or self._is_anew)
        self._lived = self._resets

    @property
    def _is_anew(self) -> bool:
        return self._resets != self._lived

    def _begin(self, wake: Wake) -> None:
        if self._steps:
            self._steps.meet(lambda: wake.over)
        with self._changed:
            self._re_anchor()
            self._began = True
        self._publish(self.told)

    def _go(self, target: int, wake: Wake) -> None:
        """To `target` ns, and on the way to all at which others have something to do."""
        if self._steps and not wake.over:
            self._steps.run(self.told)
            while (due := self._steps.next()) is not None and due < target:
                if self._is_anew or not self._reach(due, wake):
                    return
                self._steps.run(self.told)
        self._reach(target, wake)

    def _reach(self, target: int, wake: Wake) -> bool:
        """Wait for the wall clock, then it is `target`; False when something else came first."""
        target = max(target, self._ns)
        while (goal := self._awaited(target, wake)) is not None:
            if self._carry:
                self._carry(goal / NANO, self._lived)
            with self._changed:
                if self._is_anew:
                    break
                self._ns = goal
                self._measure()
                self._changed.notify_all()
            self._publish(self.told)
            if goal == target:
                return True
        self._publish(self.told)
        return False

    def _awaited(self, target: int, wake: Wake) -> int | None:
        """`target`, or where a step ends on the way there, when time may be there."""
        with self._changed:
            while not wake.is_set() and not self._is_anew:
                goal = min(target, self._until) if self._paused else target
                if (left := self._left(goal)) <= 0:
                    return goal
                if not self._changed.wait(min(left, BEAT_S)) and left >= BEAT_S:
                    self._publish(self.told)
        return None

    def _left(self, target: int) -> float:
        """Seconds of the wall clock until it may be `target`."""
        if self._paused:
            return 0.0 if target > self._ns else BEAT_S
        if not self._speed:
            return 0.0
        wall, ns = self._anchor
        left = wall + (target - ns) / NANO / self._speed - self._wall()
        if left < -BEHIND_S:
            self._anchor = (self._wall(), target)
        return left

    def _measure(self) -> None:
        wall, (since, before) = self._wall(), self._window
        if wall - since >= FACTOR_S:
            self._factor = (self._ns - before) / NANO / (wall - since)
            self._window = (wall, self._ns)

    def _re_anchor(self) -> None:
        """Count from here, at another speed or after a pause; whoever waits looks again."""
        self._anchor = self._window = (self._wall(), self._ns)
        self._changed.notify_all()

    def _notify(self) -> None:
        with self._changed:
            self._changed.notify_all()
