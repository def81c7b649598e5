"""Forces from sensor values of different skins: a normalisation that the paper leaves open.

In: sensor values in the counts or newtons of each patch. Out: newtons. A value below the noise
floor of its patch counts as no touch; one at or above the saturation is taken as the saturation.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from robocomp_dsl.tactile.arrays import Bools, Floats, Ints


@dataclass(frozen=True, slots=True)
class Sensitivity:
    """The response of a patch: `gain` [N per unit], `floor` and `saturation` [units]."""

    gain: float = 1.0
    floor: float = 0.0
    saturation: float = np.inf

    def __post_init__(self) -> None:
        if not (self.gain > 0.0 and 0.0 <= self.floor < self.saturation):
            raise ValueError("gain > 0 and 0 <= floor < saturation are needed")


@dataclass(frozen=True, eq=False)
class Normaliser:
    """The sensitivities of all taxels, each array (n,)."""

    gain: Floats
    floor: Floats
    saturation: Floats

    @classmethod
    def of(cls, patches: list[Sensitivity], patch: Ints) -> Normaliser:
        """For taxels that belong to `patches[patch[i]]`."""
        table = np.array([(p.gain, p.floor, p.saturation) for p in patches]).reshape(-1, 3)
        return cls(*table[patch].T)

    def force(self, values: Floats) -> Floats:
        """Newtons (n,) of sensor values (n,), never negative."""
        clipped = np.minimum(values, self.saturation)
        force: Floats = np.where(clipped > self.floor, clipped * self.gain, 0.0)
        return force

    def saturated(self, values: Floats) -> Bools:
        """Taxels whose true force may be larger than the measured one (n,)."""
        full: Bools = values >= self.saturation
        return full
