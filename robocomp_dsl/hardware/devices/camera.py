"""A camera, with depth or without: its data and the Protocol of its drivers."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Protocol

import numpy as np
from numpy.typing import NDArray


@dataclass(frozen=True, slots=True)
class CameraSettings:
    """Image size and focal length in px; `noise` of the depth in mm; `period` in s."""

    width: int = 640
    height: int = 480
    focal: float = 500.0
    noise: float = 0.0
    period: float = 1 / 15
    depth: bool = False


@dataclass(frozen=True, slots=True, eq=False)
class Picture:
    """A picture taken at `time` (s of the world), rows from the top; its arrays never change.

    `colour` has the shape (height, width, 3); `depth`, in mm along the axis of the camera, the
    shape (height, width), infinite where there is nothing, or (0, 0) for a camera without it.
    """

    time: float
    colour: NDArray[np.uint8]
    depth: NDArray[np.float32]


class CameraDevice(Protocol):
    """A driver of a camera."""

    @property
    def settings(self) -> CameraSettings:
        """Size and optics."""

    def picture(self) -> Picture:
        """The latest picture. Raises `HardwareError` if none is available."""


def points(settings: CameraSettings, depth: NDArray[np.float32]) -> NDArray[np.float32]:
    """The points of a depth image in the frame of the camera: x right, y up, z ahead.

    Shape (number of pixels with a depth, 3), in mm.
    """
    rows, columns = np.nonzero(np.isfinite(depth))
    z = depth[rows, columns]
    x = (columns - (settings.width - 1) / 2) * z / settings.focal
    y = ((settings.height - 1) / 2 - rows) * z / settings.focal
    return np.stack([x, y, z], axis=1).astype(np.float32)
