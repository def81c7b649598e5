"""A screen: the Protocol of its drivers."""

from __future__ import annotations

from typing import Protocol

import numpy as np
from numpy.typing import NDArray

Image = NDArray[np.uint8]


class DisplayDevice(Protocol):
    """A driver of a screen."""

    def show(self, image: Image) -> None:
        """Show an image, shape (height, width, 3), rows from the top, over the whole screen."""
