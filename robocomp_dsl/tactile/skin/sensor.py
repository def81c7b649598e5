"""What real taxels make of a force: threshold, saturation, noise, drift, dead taxels, raw counts.

In: true forces (n,) [N], frame by frame. Out: sensor readings in newtons and as raw values 0 to
255. Random numbers come from a generator that the caller seeds.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from robocomp_dsl.tactile.arrays import Bools, Floats
from robocomp_dsl.tactile.skin.triangle import Raw

IDLE = 240.0
"""Raw value of an untouched taxel."""

COUNTS_PER_NEWTON = 20.0


@dataclass(frozen=True, slots=True)
class Imperfections:
    """A perfect sensor by default.

    Forces below `threshold` [N] read 0, above `saturation` [N] as that; `noise` [N] is the standard
    deviation of each reading, `drift` [counts per root second] of the wandering baseline, `dead`
    the share of taxels that never feel anything.
    """

    threshold: float = 0.0
    saturation: float = 12.0
    noise: float = 0.0
    drift: float = 0.0
    dead: float = 0.0

    def __post_init__(self) -> None:
        if not (0.0 <= self.threshold < self.saturation and 0.0 <= self.dead <= 1.0):
            raise ValueError("0 <= threshold < saturation and 0 <= dead <= 1 are needed")
        if self.noise < 0.0 or self.drift < 0.0:
            raise ValueError("noise and drift must not be negative")


PERFECT = Imperfections()


class Sensor:
    """The taxels' state: which are dead, and where their baselines have drifted to."""

    def __init__(self, size: int, settings: Imperfections, random: np.random.Generator) -> None:
        self._settings, self._random = settings, random
        self.dead: Bools = random.random(size) < settings.dead
        self.drift = np.zeros(size)
        self.changes = any((settings.threshold, settings.noise, settings.dead))

    def read(self, force: Floats) -> Floats:
        """Readings [N] (n,), never negative and never above the saturation."""
        reading = np.minimum(force, self._settings.saturation)
        if not self.changes:
            return reading
        if self._settings.noise:
            reading = reading + self._random.normal(0.0, self._settings.noise, len(force))
        reading = np.where(reading > self._settings.threshold, reading, 0.0)
        reading[self.dead] = 0.0
        return np.minimum(reading, self._settings.saturation)

    def raw(self, force: Floats, dt: float) -> Raw:
        """Raw values (n,), lower under pressure; `dt` seconds have passed since the last ones."""
        settings, size = self._settings, len(force)
        if settings.drift:
            self.drift += self._random.normal(0.0, settings.drift * np.sqrt(dt), size)
        counts = np.minimum(force, settings.saturation) * COUNTS_PER_NEWTON
        if settings.noise:
            counts = counts + self._random.normal(0.0, settings.noise * COUNTS_PER_NEWTON, size)
        counts[self.dead] = 0.0
        value = IDLE - np.minimum(np.round(counts + self.drift), IDLE)
        return np.clip(value, 0.0, 255.0).astype(np.uint8)
