"""Colours for pressure, and colours distinguishable with any colour vision (Okabe and Ito)."""

from __future__ import annotations

import matplotlib as mpl
import numpy as np
from matplotlib.colors import Colormap, LinearSegmentedColormap, PowerNorm
from numpy.typing import NDArray

INK, SOFT, PAPER, FAINT = "#22303c", "#66737f", "#ffffff", "#eef1f3"
RIM, FIELD, TOUCH = "#c3cad0", "#0072b2", "#f3d9c6"
JOINTS = ("#0072b2", "#d55e00", "#009e73", "#cc79a7", "#e69f00")
UNTOUCHED = (0.90, 0.92, 0.94)
BARE = (0.55, 0.61, 0.68, 1.0)
"""Colour of untouched taxels on a robot."""

Floats = NDArray[np.float64]


def pressures() -> Colormap:
    """From the colour of untouched skin over yellow and red to nearly black."""
    dark = mpl.colormaps["inferno_r"](np.linspace(0.08, 0.92, 255))[:, :3]
    return LinearSegmentedColormap.from_list("pressure", [UNTOUCHED, *map(tuple, dark)])


def scale(highest: float) -> PowerNorm:
    """Colour scale of forces up to `highest` [N]; small forces are visible, too."""
    return PowerNorm(0.5, vmin=0.0, vmax=highest)


def pressure(force: Floats, highest: float) -> Floats:
    """Red, green, blue and opacity (n, 4), 0 to 1, for forces (n,) in N."""
    found: Floats = pressures()(scale(highest)(np.clip(force, 0.0, highest)))
    return found


def on_robot(force: Floats, highest: float) -> Floats:
    """The same on a robot's body, which is about as bright as untouched skin on paper."""
    return np.where((force > 0.0)[:, None], pressure(force, highest), BARE)
