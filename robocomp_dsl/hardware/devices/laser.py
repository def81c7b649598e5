"""A planar range finder: its data and the Protocol of its drivers."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Protocol

import numpy as np
from numpy.typing import NDArray


@dataclass(frozen=True, slots=True)
class LaserSettings:
    """How the laser scans.

    `measures` rays are spread evenly over `degrees`, half of them on either side of straight
    ahead. What is nearer than `min_range` (mm) reads `min_range`, what is farther than `max_range`
    or absent reads `max_range`. `noise` is the standard deviation of a distance in mm, `period`
    the time from scan to scan in s.
    """

    measures: int = 361
    degrees: float = 240.0
    min_range: float = 60.0
    max_range: float = 5600.0
    noise: float = 0.0
    period: float = 0.05

    def angles(self) -> NDArray[np.float32]:
        """Angle of every ray in rad, from left (negative) to right; shape (measures,)."""
        half = np.deg2rad(self.degrees) / 2 if self.measures > 1 else 0.0
        return np.linspace(-half, half, self.measures, dtype=np.float32)


@dataclass(frozen=True, slots=True, eq=False)
class Scan:
    """One scan at `time` (s): `angles` in rad and `distances` in mm, both shape (measures,)."""

    time: float
    angles: NDArray[np.float32]
    distances: NDArray[np.float32]


class LaserDevice(Protocol):
    """A driver."""

    @property
    def settings(self) -> LaserSettings:
        """How the laser scans."""

    def scan(self) -> Scan:
        """The latest scan; its arrays are not written to again."""
