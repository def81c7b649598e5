"""A planar range finder: its data and the Protocol of its drivers."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Protocol

import numpy as np
from numpy.typing import NDArray


@dataclass(frozen=True, slots=True)
class LaserSettings:
    """Configuration of the laser.

    `measures` rays are spread evenly over `degrees`, centred straight ahead. Distances are limited
    to `min_range` and `max_range` (mm); a ray without a hit reads `max_range`. `noise` is the
    standard deviation of a distance in mm, `period` the time between scans in s.
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
    """A driver of a laser."""

    @property
    def settings(self) -> LaserSettings:
        """Configuration of the laser."""

    def scan(self) -> Scan:
        """The latest scan; its arrays never change."""
