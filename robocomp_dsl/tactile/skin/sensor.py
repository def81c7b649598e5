"""A model of real taxels: threshold, saturation, noise, drift, dead taxels, raw counts.

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

    Forces below `threshold` [N] read 0, forces above `saturation` [N] read `saturation`. `noise`
    [N] is the standard deviation of each reading, `drift` [counts per root second] that of the
    baseline's random walk. `dead` is the share of taxels that always read 0, as do taxels with ids
    in `broken`.
    """

    threshold: float = 0.0
    saturation: float = 12.0
    noise: float = 0.0
    drift: float = 0.0
    dead: float = 0.0
    broken: tuple[int, ...] = ()

    def __post_init__(self) -> None:
        if not (0.0 <= self.threshold < self.saturation and 0.0 <= self.dead <= 1.0):
            raise ValueError("0 <= threshold < saturation and 0 <= dead <= 1 are needed")
        if self.noise < 0.0 or self.drift < 0.0:
            raise ValueError("noise and drift must not be negative")


PERFECT = Imperfections()


class Sensor:
    """The state of the taxels: dead taxels and the drift of their baselines.

    `counts` per newton are for all taxels or per taxel (n,); `broken` (n,) taxels are always dead.
    """

    def __init__(
        self,
        size: int,
        settings: Imperfections,
        random: np.random.Generator,
        counts: Floats | float = COUNTS_PER_NEWTON,
        broken: Bools | None = None,
    ) -> None:
        self._random, self._counts = random, counts
        self._lot = random.random(size)
        self.drift = np.zeros(size)
        self.adjust(settings, broken)

    def adjust(self, settings: Imperfections, broken: Bools | None = None) -> None:
        """Change the settings; a larger share of dead taxels includes the smaller one."""
        self._settings = settings
        self.dead: Bools = self._lot < settings.dead
        if broken is not None:
            self.dead |= broken
        self.changes = bool(settings.threshold or settings.noise or self.dead.any())

    def read(self, force: Floats, noise: float = 1.0) -> Floats:
        """Readings [N] (n,), never negative and never above the saturation.

        `noise` is a factor on that of the settings.
        """
        reading = np.minimum(force, self._settings.saturation)
        if not self.changes:
            return reading
        if self._settings.noise:
            reading = reading + self._random.normal(0.0, self._settings.noise * noise, len(force))
        reading = np.where(reading > self._settings.threshold, reading, 0.0)
        reading[self.dead] = 0.0
        return np.minimum(reading, self._settings.saturation)

    def raw(self, force: Floats, dt: float, noise: float = 1.0) -> Raw:
        """Raw values (n,), lower under pressure; `dt` [s] is the time since the previous ones."""
        settings, size = self._settings, len(force)
        if settings.drift:
            self.drift += self._random.normal(0.0, settings.drift * noise * np.sqrt(dt), size)
        newtons = np.minimum(force, settings.saturation)
        if settings.noise:
            newtons = newtons + self._random.normal(0.0, settings.noise * noise, size)
        counts = newtons * self._counts
        counts[self.dead] = 0.0
        value = IDLE - np.minimum(np.round(counts + self.drift), IDLE)
        return np.clip(value, 0.0, 255.0).astype(np.uint8)
