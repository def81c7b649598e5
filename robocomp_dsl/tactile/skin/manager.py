"""Calibration and compensation of raw taxel values, as in iCub's skin manager.

In: raw values 0 to 255 (idle high, pressing lowers them, unless `zero_up`). Out: counts of touch
after removal of the baseline, which follows slow drift. Defaults: the manager's configuration.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from robocomp_dsl.tactile.arrays import Bools, Floats

FULL = 255.0
BINARY_TOUCH = 100.0
DRIFT_GAIN = 0.02


@dataclass(frozen=True, slots=True)
class Compensation:
    """Settings; thresholds in counts. `alpha` is the weight of the last smoothed value."""

    add_threshold: float = 7.0
    gain: float = 0.2
    contact_gain: float = 0.05
    min_baseline: float = 3.0
    smooth: bool = True
    alpha: float = 0.5
    binary: bool = False
    zero_up: bool = False


@dataclass(slots=True, eq=False)
class SkinManager:
    """Baseline, threshold and smoothed value per taxel. All arrays are (n,)."""

    settings: Compensation
    baseline: Floats
    threshold: Floats
    _last: Floats | None = None

    @classmethod
    def calibrated(cls, samples: Floats, settings: Compensation) -> SkinManager:
        """Compute the baseline from raw frames (frames, n) of an untouched skin.

        The threshold is the distance from the mean to the 95th percentile, at least one count.
        Raises `ValueError` without a frame.
        """
        if samples.ndim != 2 or not len(samples):
            raise ValueError("calibration needs at least one frame")
        up = samples if settings.zero_up else FULL - samples
        baseline = up.mean(axis=0)
        spread = np.percentile(up, 95, axis=0) - baseline
        return cls(settings, baseline, np.maximum(spread, 1.0))

    def compensate(self, raw: Floats) -> Floats:
        """Counts of touch (n,), never negative; 100 or 0 if binary. Updates the baseline."""
        up = raw if self.settings.zero_up else FULL - raw
        change = np.minimum(up - self.baseline, FULL)
        if self.settings.smooth:
            change = self._smoothed(change)
        touch = self.touched(change)
        self._update_baseline(change, touch)
        if self.settings.binary:
            return np.where(touch, BINARY_TOUCH, 0.0)
        return np.maximum(change, 0.0)

    def touched(self, change: Floats) -> Bools:
        """Where compensated counts are above the threshold."""
        above: Bools = change > self.threshold + self.settings.add_threshold
        return above

    def alarms(self) -> Bools:
        """Taxels whose baseline has drifted too far to be reliable (n,)."""
        low = self.settings.min_baseline
        out: Bools = (self.baseline < low) | (self.baseline > FULL - low)
        return out

    def _update_baseline(self, change: Floats, touch: Bools) -> None:
        """Move the baseline a little towards the value: slowly, and slower under touch."""
        gain = np.where(touch, self.settings.contact_gain, self.settings.gain)
        self.baseline = self.baseline + DRIFT_GAIN * gain * change / self.threshold

    def _smoothed(self, change: Floats) -> Floats:
        alpha = min(self.settings.alpha, 0.99)
        last = change if self._last is None else self._last
        self._last = (1.0 - alpha) * change + alpha * last
        return self._last
