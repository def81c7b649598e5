"""Meshes of PLY files, read by trimesh, which is installed with the extra `view`.

In: the bytes of a file. Out: points and faces, or `MeshError` without trimesh.
"""

from __future__ import annotations

import io

import numpy as np

from robocomp_dsl.extras import MissingExtra
from robocomp_dsl.hardware.formats.surface import NO_FACES, MeshError, Surface, checked_surface


def read_ply(data: bytes) -> Surface:
    """Raises `MeshError`, and `ValueError` for a damaged file."""
    try:
        from trimesh.exchange.ply import load_ply  # noqa: PLC0415 - slow, and most worlds have none
    except ModuleNotFoundError as error:
        raise MeshError(str(MissingExtra("reading PLY meshes", "view", error))) from None
    try:
        found = load_ply(io.BytesIO(data))
    except (KeyError, TypeError, AttributeError) as error:  # of a header that lacks a part
        raise ValueError(f"{type(error).__name__}: {error}") from None
    points = np.asarray(found.get("vertices", np.empty((0, 3))), np.float64).reshape(-1, 3)
    faces = np.asarray(found.get("faces", NO_FACES))
    if faces.size and faces.shape[1] == 4:
        faces = faces[:, [0, 1, 2, 0, 2, 3]].reshape(-1, 3)
    return checked_surface(points, faces.reshape(-1, 3).astype(np.int32))
