"""The generated simulator in a process of its own, and what a subscriber here hears of its skin.

In: the component of `skin_world`. Out: how fast it lives while it publishes, and how long a touch
takes from the physics to the subscriber's handler.
"""

from __future__ import annotations

import os
import subprocess
import sys
import time
import uuid
from collections.abc import Iterator
from contextlib import contextmanager
from dataclasses import dataclass, field
from importlib import util
from itertools import pairwise
from pathlib import Path
from time import monotonic_ns
from typing import Any

import numpy as np

from robocomp_dsl.runtime.component.callback_group import CallbackGroup
from robocomp_dsl.runtime.component.statistics import Statistics
from robocomp_dsl.runtime.connection.component_ports import open_ports
from robocomp_dsl.runtime.connection.endpoint import Endpoint
from robocomp_dsl.runtime.connection.ports import ComponentContext

PATIENCE = 60.0
PERIOD = 0.0873
"""Seconds from tap to tap, as the worker of `skin_world` has it."""
TICKS = os.sysconf("SC_CLK_TCK")


@dataclass
class Heard:
    """Frames as they came: sequence, time [s], sum of forces [N], and when [ns of this machine]."""

    process: subprocess.Popen[bytes]
    rows: list[tuple[int, float, float, int]] = field(default_factory=list)

    def frame(self, frame: Any) -> None:
        """The handler of `SkinFrame`."""
        now = monotonic_ns()
        self.rows.append((frame.sequence, frame.time, float(frame.force.sum()), now))

    def until(self, frames: int) -> None:
        """Wait until so many have come."""
        end = time.monotonic() + PATIENCE
        while len(self.rows) < frames:
            if time.monotonic() > end or self.process.poll() is not None:
                raise RuntimeError(f"only {len(self.rows)} frames came")
            time.sleep(0.01)

    @property
    def cpu(self) -> float:
        """Seconds of the processor that the simulator has used, in all its threads."""
        words = Path(f"/proc/{self.process.pid}/stat").read_text().rpartition(")")[2].split()
        return (int(words[11]) + int(words[12])) / TICKS


def interfaces(folder: Path) -> Any:
    """The generated interfaces, as a module."""
    spec = util.spec_from_file_location(
        "skin_interfaces", next(folder.glob("*_generated/interfaces.py"))
    )
    assert spec
    assert spec.loader
    module = util.module_from_spec(spec)
    sys.modules[spec.name] = module
    spec.loader.exec_module(module)
    return module


@contextmanager
def running(folder: Path, *settings: str, taps: Path | None = None) -> Iterator[Heard]:
    """The simulator with `settings` (`speed=0`), heard over zenoh from its first frames on."""
    domain = f"bench-{uuid.uuid4().hex[:8]}"
    options = [word for setting in settings for word in ("--set", setting)]
    process = subprocess.Popen(
        [sys.executable, "main.py", "--domain", domain, *options],
        cwd=folder,
        env={**os.environ, **({"TAPS": str(taps)} if taps else {})},
        stderr=subprocess.DEVNULL,
    )
    heard = Heard(process)
    middleware = open_ports(
        "zenoh", ComponentContext("client", domain, CallbackGroup(), Statistics())
    )
    try:
        topic = interfaces(folder).SkinFrameProxy.INTERFACE
        at = Endpoint(topic, "client", "SkinFrame")
        middleware.subscribe(at, {"frame": heard.frame}, CallbackGroup())
        heard.until(10)
        yield heard
    finally:
        middleware.close()
        process.terminate()
        process.wait(30)


@dataclass(frozen=True)
class Pace:
    """Simulated seconds per second in each window: by the clock, and by the processor's time."""

    wall: list[float]
    cpu: list[float]
    lost: int


def pace(folder: Path, windows: int = 12, frames: int = 100) -> Pace:
    """The pace of the simulator at full speed, in `windows` of `frames` frames each."""
    marks = []
    with running(folder, "speed=0") as heard:
        heard.until(200)
        for _ in range(windows + 1):
            heard.until(len(heard.rows) + frames)
            marks.append((heard.rows[-1], heard.cpu))
        numbers = [row[0] for row in heard.rows]
    wall, cpu = [], []
    for (before, used), (after, used_then) in pairwise(marks):
        passed = after[1] - before[1]
        wall.append(passed / ((after[3] - before[3]) * 1e-9))
        cpu.append(passed / max(used_then - used, 1 / TICKS))
    return Pace(wall, cpu, numbers[-1] - numbers[0] + 1 - len(numbers))


@dataclass(frozen=True)
class Taps:
    """What became of taps: `way` (n,) [ms] from the physics to the handler; `count` of all taps.

    `lateness` (m,) [ms] of sleeps of a millisecond meanwhile: what the machine alone adds.
    """

    way: Any
    count: int
    lateness: Any


def latencies(folder: Path, file: Path, count: int) -> Taps:
    """From the step of the physics that meets the skin to the handler here.

    The frame in which the touch falls must end first: up to 20 ms of each are that.
    """
    late = []
    with running(folder, "speed=1", taps=file) as heard:
        while len(heard.rows) < 50 + round(count * PERIOD * 50):
            begun = monotonic_ns()
            time.sleep(0.001)
            late.append((monotonic_ns() - begun) * 1e-6 - 1.0)
            if heard.process.poll() is not None:
                raise RuntimeError("the simulator has ended")
        rows = np.array(heard.rows)
    touched = rows[rows[:, 2] > 0.0]
    met = np.loadtxt(file, dtype=[("time", float), ("wall", np.int64)])
    met = met[met["time"] < rows[-1, 1] - 0.05]
    way = []
    for simulated, wall in met:
        after = np.searchsorted(touched[:, 1], simulated - 1e-9)
        if after < len(touched) and touched[after, 1] - simulated < 0.0201:
            way.append((touched[after, 3] - wall) * 1e-6)
    return Taps(np.array(way), len(met), np.array(late))
