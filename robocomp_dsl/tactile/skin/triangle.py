"""The triangular sensor module of the iCub and NAO skins.

In: a channel number. Out: its position on the module and whether it measures pressure. Numbers:
iCub skin GUI layout; 257.2 layout units are the 6.5 mm measured between neighbours.
"""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from robocomp_dsl.tactile.arrays import Ints

Raw = NDArray[np.uint8]

CHANNELS = 12
THERMAL = (6, 10)
PRESSURE = (0, 1, 2, 3, 4, 5, 7, 8, 9, 11)
TRIANGLES_PER_BOARD = 16
PITCH = 0.0065
"""Distance between neighbouring taxels [m]."""

_UNIT = PITCH / 257.2
LAYOUT = _UNIT * np.array(
    [
        (257.2, 0.0),
        (385.83, -222.83),
        (128.62, -222.83),
        (0.0, 0.0),
        (-128.62, -222.83),
        (-385.83, -222.83),
        (-256.3, -147.64),
        (-257.2, 0.0),
        (-128.62, 222.83),
        (0.0, 445.54),
        (0.0, 296.55),
        (128.62, 222.83),
    ]
)
"""Position of each channel [m], shape (12, 2); the centre taxel, channel 3, at the origin."""


def published(channels: Ints, values: Raw, size: int, rest: int = 240) -> Raw:
    """The vector of `size` channels that a skin part publishes: `values` at `channels`.

    All others, thermal channels and absent modules, stay at `rest`.
    """
    vector = np.full(size, rest, np.uint8)
    vector[channels] = values
    return vector


def index(board: int, triangle: int, channel: int) -> int:
    """Number of a channel in the published vector of its skin part."""
    return (board * TRIANGLES_PER_BOARD + triangle) * CHANNELS + channel
