"""Artificial skin: its frames, its settings, and the Protocol of its drivers."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from typing import Protocol

import numpy as np
from numpy.typing import NDArray

from robocomp_dsl.tactile.skin.contacts import Touches
from robocomp_dsl.tactile.skin.geometry import SkinGeometry
from robocomp_dsl.tactile.skin.kernel import SIGMA
from robocomp_dsl.tactile.skin.manager import Compensation
from robocomp_dsl.tactile.skin.sensor import PERFECT, Imperfections
from robocomp_dsl.tactile.skin.triangle import Raw

Floats = NDArray[np.float64]


@dataclass(frozen=True, slots=True)
class SkinSettings:
    """Settings of a simulated skin: `rate` [Hz] of its frames, `sigma` [m] of its kernel.

    With `raw`, frames include the raw values of the electronics; with `compensation`, forces are
    computed from these, as on the robot, after a calibration; `shear` adds shear forces.
    """

    rate: float = 50.0
    sigma: float = SIGMA
    shear: bool = True
    raw: bool = False
    imperfections: Imperfections = PERFECT
    compensation: Compensation | None = None


@dataclass(frozen=True, slots=True, eq=False)
class SkinFrame:
    """One frame; arrays (n,) in the order of the geometry, `shear` (n, 3) in the limbs' frames.

    `time` [s] is that of its last physics step; `off_skin` [N] is the contact force on covered
    bodies away from all taxels. `raw` and `shear` are None unless enabled.
    """

    sequence: int
    time: float
    geometry: int
    force: Floats
    shear: Floats | None
    raw: Raw | None
    off_skin: float


class SkinDevice(Protocol):
    """A driver of a skin."""

    @property
    def geometry(self) -> SkinGeometry:
        """The current positions of the taxels."""

    @property
    def frame(self) -> SkinFrame:
        """The latest frame. Raises `HardwareError` when there is none."""

    def touches(self, frame: SkinFrame) -> Touches:
        """The touches of a frame."""

    def calibrate(self, seconds: float) -> None:
        """Measure the baseline during the next `seconds`. Raises `CommandRefused`."""

    def subscribe(self, on_frame: Callable[[SkinFrame], None]) -> None:
        """Call `hear` with every new frame from now on."""
