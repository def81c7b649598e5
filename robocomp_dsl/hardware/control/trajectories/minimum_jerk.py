"""Minimum-jerk trajectories of n joints.

In: goals and speeds. Out: reference positions and velocities, step by step. With d the distance, v
the initial speed times the duration, and t from 0 to 1:

    x(t) = x0 + v t + (10 d - 6 v) t^3 - (15 d - 8 v) t^4 + (6 d - 3 v) t^5

so that it ends at rest without acceleration. The duration is the distance over the reference speed;
from rest to rest the peak speed is 1.875 times as high. A joint that has to reverse would be
faster: its duration is extended if it would exceed its speed limit.
"""

from __future__ import annotations

import numpy as np

from robocomp_dsl.hardware.control.joints import Floats, Ints

PEAK = 1.875
"""Peak speed over mean speed, from rest to rest."""

ROUNDING = 1.0 + 1e-9
"""Tolerance of a limit."""

AHEAD = 24
"""Steps whose references are computed together: numpy is about as fast as for one."""


class MinimumJerk:
    """The trajectories; `position` and `velocity` (n,) are the references after the last step.

    `active` is True while a joint moves. A joint at rest is a trajectory of rate 0, so that a
    step treats all joints alike. Coming steps are computed ahead until the next end of a
    trajectory; any change discards them. They stay within `bounds` (n,), if set.
    """

    def __init__(self, position: Floats, bounds: tuple[Floats, Floats] | None = None) -> None:
        n = len(position)
        self._bounds = bounds
        self.position = position.copy()
        self.velocity = np.zeros(n)
        self.goal = position.copy()
        self.moving = np.zeros(n, bool)
        self.active = False
        self._time = np.zeros(n)
        self._rate = np.zeros(n)
        # coefficients of t^0 to t^5, of the position and its derivative by t
        self._factors = np.zeros((6, 2, n))
        self._factors[0, 0] = position
        self._clock = 0.0
        self._end = np.full(n, np.inf)
        self._next_end = np.inf
        self._rows = np.empty((0, 2, n))
        self._next = 0
        self._dt = 0.0

    def move(
        self, joints: Ints, goal: Floats, speed: Floats, dt: float, most: Floats | None = None
    ) -> None:
        """Move to `goal` at mean `speed` > 0, from the current reference and its velocity.

        At most at speed `most`, if set, unless the joint is already faster.
        """
        self._forget()
        start, way = self.position[joints], goal - self.position[joints]
        duration = np.abs(way) / speed
        at_once = duration < dt
        if most is not None and self.active:
            duration = _long_enough(way, self.velocity[joints], duration, most)
        v = self.velocity[joints] * duration
        third, fourth, fifth = 10 * way - 6 * v, 8 * v - 15 * way, 6 * way - 3 * v
        none = np.zeros(len(joints))
        self._factors[:, 0, joints] = (start, v, none, third, fourth, fifth)
        self._factors[:, 1, joints] = (v, none, 3 * third, 4 * fourth, 5 * fifth, none)
        self._rate[joints] = 1.0 / np.where(at_once, dt, duration)
        self._time[joints] = 0.0
        self._end[joints] = self._clock + duration
        self.goal[joints] = goal
        self.moving[joints] = True
        self.halt(joints[at_once], goal[at_once])

    def halt(self, joints: Ints, position: Floats) -> None:
        """End the motion of `joints`: at rest at `position`."""
        self._forget()
        self.position[joints] = self.goal[joints] = position
        self.velocity[joints] = self._rate[joints] = 0.0
        self._factors[:, :, joints] = 0.0
        self._factors[0, 0, joints] = position
        self.moving[joints] = False
        self._end[joints] = np.inf
        self._next_end = float(self._end.min())
        self.active = bool(self.moving.any())

    def shift(self, way: Floats, low: Floats, high: Floats) -> None:
        """Shift all trajectories by `way` (n,), between `low` and `high`."""
        self.position = np.minimum(np.maximum(self.position + way, low), high)
        self.goal = np.minimum(np.maximum(self.goal + way, low), high)
        if self.active:
            self._rows[self._next :, 0] += way
        start = self._factors[0, 0]
        start += way
        np.copyto(start, self.position, where=~self.moving)

    def step(self, dt: float) -> None:
        """Advance by `dt` seconds."""
        if not self.active:
            return
        if self._next == len(self._rows) or dt != self._dt:
            self._look_ahead(dt)
        row = self._rows[self._next]
        self.position, self.velocity = row[0], row[1]
        self._next += 1
        self._clock += dt
        if self._clock >= self._next_end - 0.5 * dt:
            done = np.flatnonzero(self._end <= self._clock + 0.5 * dt)
            self.halt(done, self.goal[done])

    def _look_ahead(self, dt: float) -> None:
        """Positions and velocities (steps, 2, n) of the next steps."""
        self._forget()
        left = int(min((self._next_end - self._clock) / dt, AHEAD)) + 1
        later = np.arange(1, left + 1)[:, None, None] * (self._rate * dt)
        t = self._time + later
        value = self._factors[5] * t
        for factor in self._factors[4:0:-1]:
            value += factor
            value *= t
        value += self._factors[0]
        value[:, 1] *= self._rate
        if self._bounds:
            self._keep_within(value, *self._bounds)
        self._rows, self._next, self._dt = value, 0, dt

    @staticmethod
    def _keep_within(rows: Floats, low: Floats, high: Floats) -> None:
        """Stop references at their bounds."""
        allowed = np.minimum(np.maximum(rows[:, 0], low), high)
        outside = allowed != rows[:, 0]
        if np.count_nonzero(outside):
            rows[:, 0] = allowed
            rows[:, 1][outside] = 0.0

    def _forget(self) -> None:
        """Set the state of the last step, and discard the steps computed ahead."""
        self._time += self._next * self._dt * self._rate
        self._rows, self._next = self._rows[:0], 0


def _long_enough(way: Floats, velocity: Floats, duration: Floats, most: Floats) -> Floats:
    """The durations, extended until no speed exceeds `most` or the initial speed."""
    bound = ROUNDING * np.maximum(most, np.abs(velocity))
    for _ in range(40):
        mean = np.divide(way, duration, out=np.zeros(len(way)), where=duration > 0.0)
        fast = _top_speed(velocity, mean) > bound
        if not fast.any():
            break
        duration = np.where(fast, 1.1 * duration, duration)
    return duration


def _top_speed(velocity: Floats, mean: Floats) -> Floats:
    """The highest speed after the start, from the initial and mean speeds.

    The acceleration is 0 at t = 0, t = 1 and one more t, where the speed is highest.
    """
    below = 10.0 * mean - 5.0 * velocity
    t = np.divide(5.0 * mean - 3.0 * velocity, below, out=np.zeros(len(mean)), where=below != 0.0)
    t = np.clip(t, 0.0, 1.0)
    of_start = 1.0 - 18.0 * t**2 + 32.0 * t**3 - 15.0 * t**4
    speed: Floats = np.abs(velocity * of_start + mean * 30.0 * t**2 * (1.0 - t) ** 2)
    return speed
