"""From the forces on the skin to its readings: sensors, raw values, compensation.

In: true forces (n,) [N], frame by frame. Out: measured forces and, on request, raw values. With
compensation, forces are computed from the raw values alone, as on a robot; compensation calibrates
itself when it is switched on, and reads zero until then.
"""

from __future__ import annotations

import numpy as np

from robocomp_dsl.tactile.arrays import Bools, Floats
from robocomp_dsl.tactile.skin.geometry import SkinGeometry
from robocomp_dsl.tactile.skin.manager import Compensation, SkinManager
from robocomp_dsl.tactile.skin.sensor import COUNTS_PER_NEWTON, Imperfections, Sensor
from robocomp_dsl.tactile.skin.triangle import Raw

CALIBRATION_S = 5.0
"""Duration of the first calibration [s]."""


class SkinElectronics:
    """The sensors of one skin and their software."""

    def __init__(
        self, geometry: SkinGeometry, settings: Imperfections, random: np.random.Generator
    ) -> None:
        self._ids = geometry.ids
        self.counts = counts_per_newton(geometry)
        self.sensor = Sensor(geometry.size, settings, random, self.counts, self._broken(settings))
        self.manager: SkinManager | None = None
        self._samples: list[Raw] = []
        self._left = 0.0
        self._compensating: Compensation | None = None

    def adjust(self, settings: Imperfections) -> None:
        """Change the settings of the sensors; their drift stays."""
        self.sensor.adjust(settings, self._broken(settings))

    def calibrate(self, seconds: float) -> None:
        """Measure the baseline during the next `seconds`."""
        self._left, self._samples = seconds, []

    def read(self, force: Floats, noise: float) -> Floats:
        """Readings of the sensors (n,) [N]; `noise` is a factor."""
        return self.sensor.read(force, noise)

    def raw(self, force: Floats, dt: float, noise: float) -> Raw:
        """Raw values (n,); `dt` [s] is the time since the previous ones."""
        return self.sensor.raw(force, dt, noise)

    def compensated(self, raw: Raw, dt: float, settings: Compensation) -> Floats:
        """Forces (n,) [N] from raw values; zero without a baseline."""
        if self._compensating is None and self.manager is None and not self._left:
            self.calibrate(CALIBRATION_S)
        if self.manager is not None and settings != self._compensating:
            self.manager.settings = settings
        self._compensating = settings
        if self._left > 0.0:
            self._sample(raw, dt, settings)
            return np.zeros(len(raw))
        if self.manager is None:
            return np.zeros(len(raw))
        counts = self.manager.compensate(raw.astype(float))
        return np.where(self.manager.touched(counts), counts / self.counts, 0.0)

    def _sample(self, raw: Raw, dt: float, settings: Compensation) -> None:
        self._samples.append(raw)
        self._left -= dt
        if self._left <= 0.5 * dt:
            self._left = 0.0
            self.manager = SkinManager.calibrated(np.array(self._samples, dtype=float), settings)
            self._samples = []

    def _broken(self, settings: Imperfections) -> Bools:
        return np.isin(self._ids, np.array(settings.broken, dtype=np.int64))


def counts_per_newton(geometry: SkinGeometry) -> Floats:
    """Decrease of each taxel's raw value per newton (n,).

    A patch with values in newtons has `COUNTS_PER_NEWTON`.
    """
    counts = [
        COUNTS_PER_NEWTON if sensitivity.gain == 1.0 else 1.0 / sensitivity.gain
        for sensitivity in geometry.sensitivities
    ]
    return np.array(counts, dtype=float)[geometry.patch]
