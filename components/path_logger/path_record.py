"""The path of a base: samples, their statistics, and the file."""

from __future__ import annotations

import csv
import math
from dataclasses import astuple, dataclass, field, fields
from pathlib import Path


@dataclass(frozen=True, slots=True)
class Sample:
    """One state; the names are the columns of the file. `run` counts from 0."""

    run: int
    time_s: float
    x_mm: float
    z_mm: float
    alpha_rad: float
    odometry_x_mm: float
    odometry_z_mm: float
    odometry_alpha_rad: float
    adv_mm_s: float
    rot_rad_s: float


@dataclass(slots=True)
class PathRecord:
    """Samples in order. `distance` is the path length in mm; consecutive runs are not connected."""

    interval: float = 0.0
    samples: list[Sample] = field(default_factory=list)
    runs: int = 0
    distance: float = 0.0
    time: float = 0.0

    def add(self, time: float, numbers: tuple[float, ...]) -> None:
        """Add a state at `time` (s). A time before the last one starts another run."""
        again = not self.samples or time < self.time
        if again:
            self.runs += 1
        elif time - self.samples[-1].time_s < self.interval:
            self.time = time
            return
        sample = Sample(self.runs - 1, time, *numbers)
        if not again:
            last = self.samples[-1]
            self.distance += math.hypot(sample.x_mm - last.x_mm, sample.z_mm - last.z_mm)
        self.time = time
        self.samples.append(sample)

    def write(self, path: Path) -> None:
        """Write all samples as CSV, atomically."""
        path.parent.mkdir(parents=True, exist_ok=True)
        part = path.with_name(path.name + ".part")
        with part.open("w", newline="", encoding="utf-8") as stream:
            writer = csv.writer(stream)
            writer.writerow(column.name for column in fields(Sample))
            for sample in self.samples:
                writer.writerow(round(number, 4) for number in astuple(sample))
        part.replace(path)
