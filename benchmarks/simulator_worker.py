"""The worker of a simulator that is measured: it tells what it costs, on lines of its own.

It is copied into a generated component as its `specificworker.py`. Each simulated second is told as
JSON: simulated time, CPU time of the whole process before and after the telling, wall clock, and
the CPU time of so much bare physics of the same model. At its end it tells when the torque of the
joint `TAPPED` has changed, by the clock that all processes share.
"""

from __future__ import annotations

import json
import os
import time
from typing import Any

import mujoco
from humanoid_simulator_generated.simulator import Simulator

TAP = "BENCH_TAP"
"""Set in the environment where the joint is to be watched, which costs a little."""

TAPPED = "left_wrist_z"
EVERY = 1.0
"""Simulated seconds from line to line."""

SAMPLE = 200
"""Steps of bare physics."""


class SpecificWorker(Simulator):
    """The simulator as it comes, measured."""

    next = EVERY

    def initialize(self) -> None:
        """The world runs already."""
        super().initialize()
        with self.simulation.lock:
            self.bare = mujoco.MjData(self.simulation.world.model)
            self.effects: list[tuple[float, float]] = []
            if os.environ.get(TAP):
                self._watch(self.simulation.devices[TAPPED])

    def _watch(self, part: Any) -> None:
        drive, joint = part.before_step, part.board.spec.names.index(TAPPED)
        last = 0.0

        def watched(dt: float) -> None:
            nonlocal last
            drive(dt)
            torque = float(part.board.torque[joint])
            if torque != last:
                self.effects.append((torque, time.perf_counter()))
                last = torque

        part.before_step = watched

    def compute(self) -> None:
        """Publish; tell once in a while."""
        super().compute()
        if self.simulation.time >= self.next:
            self.next += EVERY
            self._tell()

    def _tell(self) -> None:
        before, world = time.process_time(), self.simulation.world
        with self.simulation.lock:
            mujoco.mj_copyData(self.bare, world.model, world.data)
        begun = time.thread_time()
        for _ in range(SAMPLE):
            mujoco.mj_step(world.model, self.bare)
        bare = (time.thread_time() - begun) / SAMPLE / world.step
        record = (world.time, before, time.process_time(), time.perf_counter(), bare)
        print(json.dumps(record), flush=True)

    def finalize(self) -> None:
        """Tell the effects."""
        super().finalize()
        print(json.dumps(self.effects), flush=True)
