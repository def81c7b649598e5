"""Minimum-jerk trajectories of n joints at once.

In: goals and speeds. Out: reference positions and velocities, step by step. With d the way, v the
speed at the start times the duration, and t from 0 to 1:

    x(t) = x0 + v t + (10 d - 6 v) t^3 - (15 d - 8 v) t^4 + (6 d - 3 v) t^5

so that it ends at rest and without acceleration. The duration is the way over the reference speed;
from rest to rest the peak speed is 1.875 times as high.
"""

from __future__ import annotations

import numpy as np

from robocomp_dsl.hardware.control.joints import Floats, Ints

PEAK = 1.875
"""Peak speed over mean speed, from rest to rest."""


class MinimumJerk:
    """The trajectories; `position` and `velocity` (n,) are the references after the last step."""

    def __init__(self, position: Floats) -> None:
        n = len(position)
        self.position = position.copy()
        self.velocity = np.zeros(n)
        self.goal = position.copy()
        self.moving = np.zeros(n, bool)
        self._time = np.zeros(n)
        self._rate = np.zeros(n)
        self._start = position.copy()
        self._powers = np.zeros((4, n))  # factors of t, t^3, t^4, t^5
        self._any = False

    def move(self, joints: Ints, goal: Floats, speed: Floats, dt: float) -> None:
        """Go to `goal` at mean `speed` > 0, from where the reference is, as fast as it moves."""
        way = goal - self.position[joints]
        duration = np.abs(way) / speed
        at_once = duration < dt
        v = self.velocity[joints] * duration
        self._start[joints] = self.position[joints]
        self._powers[:, joints] = (v, 10 * way - 6 * v, 8 * v - 15 * way, 6 * way - 3 * v)
        self._rate[joints] = 1.0 / np.where(at_once, dt, duration)
        self._time[joints] = 0.0
        self.goal[joints] = goal
        self.moving[joints] = ~at_once
        done = joints[at_once]
        self.position[done] = self.goal[done]
        self.velocity[done] = 0.0
        self._any = bool(self.moving.any())

    def halt(self, joints: Ints, position: Floats) -> None:
        """Forget the motion of `joints`: at rest at `position`."""
        self.position[joints] = self.goal[joints] = position
        self.velocity[joints] = 0.0
        self.moving[joints] = False
        self._any = bool(self.moving.any())

    def shift(self, way: Floats, low: Floats, high: Floats) -> None:
        """Carry everything along by `way` (n,), between `low` and `high`."""
        self.position = np.minimum(np.maximum(self.position + way, low), high)
        self.goal = np.minimum(np.maximum(self.goal + way, low), high)
        self._start += way

    def step(self, dt: float) -> None:
        """Let `dt` seconds pass."""
        if not self._any:
            return
        moving = self.moving
        step = self._rate * dt
        np.add(self._time, step, out=self._time, where=moving)
        t, (first, third, fourth, fifth) = self._time, self._powers
        square = t * t
        x = self._start + t * (first + square * (third + t * (fourth + t * fifth)))
        speed = first + square * (3 * third + t * (4 * fourth + t * (5 * fifth)))
        np.copyto(self.position, x, where=moving)
        np.copyto(self.velocity, speed * self._rate, where=moving)
        done = moving & (t >= 1.0 - 0.5 * step)
        if done.any():
            self.halt(np.flatnonzero(done), self.goal[done])
