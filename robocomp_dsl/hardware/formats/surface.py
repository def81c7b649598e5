"""The points and faces of a mesh file, and the error of a file without any."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from robocomp_dsl.hardware.devices.errors import HardwareError

Points = NDArray[np.float64]
Faces = NDArray[np.int32]

NO_FACES: Faces = np.empty((0, 3), np.int32)


class MeshError(HardwareError):
    """The file contains no usable mesh."""


@dataclass(frozen=True, slots=True, eq=False)
class Surface:
    """`points` of shape (n, 3), in the units of the file; `faces` of shape (m, 3) or none."""

    points: Points
    faces: Faces


def checked_surface(points: Points, faces: Faces) -> Surface:
    """A surface whose faces name existing points. Raises `ValueError`."""
    if len(faces) and (faces.min() < 0 or faces.max() >= len(points)):
        raise ValueError("a face names a point that is not there")
    return Surface(points, faces)


def joined(surfaces: Sequence[Surface]) -> Surface:
    """One surface of several."""
    if not surfaces:
        return Surface(np.empty((0, 3)), NO_FACES)
    starts = np.cumsum([0, *(len(surface.points) for surface in surfaces)])
    return Surface(
        np.concatenate([surface.points for surface in surfaces]),
        np.concatenate(
            [
                surface.faces + np.int32(start)
                for surface, start in zip(surfaces, starts, strict=False)
            ]
        ),
    )
