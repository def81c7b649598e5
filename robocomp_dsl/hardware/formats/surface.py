"""The points and faces of a mesh file, and the error of a file without any."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from robocomp_dsl.hardware.devices.errors import HardwareError

Points = NDArray[np.float64]
Faces = NDArray[np.int32]

_LEAST_AREA = 1e-12
"""Of the square of the extent: smaller triangles are lines or points."""

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


def scaled(surface: Surface, scale: Sequence[float], largest: float) -> Surface:
    """The surface with its points multiplied along the axes.

    Raises `MeshError` if a coordinate would exceed `largest`.
    """
    with np.errstate(all="ignore"):
        points: Points = surface.points * scale
    if not (np.abs(points) <= largest).all():
        raise MeshError(f"no world holds it with the scale {', '.join(f'{s:g}' for s in scale)}")
    return Surface(points, surface.faces)


def used_part(surface: Surface) -> Surface:
    """The triangles that have an area, and only their points; all points if there are none."""
    if not len(surface.faces):
        return surface
    corners = surface.points[surface.faces]
    sides = np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0])
    extent = float((corners.max(axis=(0, 1)) - corners.min(axis=(0, 1))).max())
    faces = surface.faces[np.linalg.norm(sides, axis=1) > _LEAST_AREA * extent**2]
    if not len(faces):
        return Surface(surface.points, NO_FACES)
    index, renumbered = np.unique(faces, return_inverse=True)
    return Surface(surface.points[index], renumbered.reshape(-1, 3).astype(np.int32))


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
