"""Geoms of a MuJoCo model as triangles and colours, for viewers without primitives.

In: an `MjModel` and the index of a geom. Out: points in the geom's frame, in m, and faces.
"""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import Any

import mujoco
import numpy as np
from numpy.typing import NDArray

_GEOM = mujoco.mjtGeom
_AROUND = 24
_ARC = 8
_ENDLESS = 50.0
"""m: displayed extent of an infinite plane."""


@dataclass(frozen=True, slots=True, eq=False)
class Triangles:
    """`points` of shape (n, 3), `faces` of shape (m, 3)."""

    points: NDArray[np.float64]
    faces: NDArray[np.int32]


def triangles(model: Any, geom: int) -> Triangles | None:  # noqa: PLR0911 - one for each kind
    """The surface of a geom; None for kinds without one."""
    size = model.geom_size[geom]
    match int(model.geom_type[geom]):
        case _GEOM.mjGEOM_PLANE:
            half = np.where(size[:2] > 0, size[:2], _ENDLESS / 2)
            return _box(np.array([half[0], half[1], 0.0005]), np.array([0, 0, -0.0005]))
        case _GEOM.mjGEOM_BOX:
            return _box(size, np.zeros(3))
        case _GEOM.mjGEOM_SPHERE:
            return _lathe(_arc(-90, 90) * size[0])
        case _GEOM.mjGEOM_ELLIPSOID:
            ball = _lathe(_arc(-90, 90))
            return Triangles(ball.points * size, ball.faces)
        case _GEOM.mjGEOM_CAPSULE:
            half = np.array([0.0, size[1]])
            return _lathe(
                np.concatenate((_arc(-90, 0) * size[0] - half, _arc(0, 90) * size[0] + half))
            )
        case _GEOM.mjGEOM_CYLINDER:
            radius, half = size[:2].tolist()
            return _lathe(np.array([[0, -half], [radius, -half], [radius, half], [0, half]]))
        case _GEOM.mjGEOM_MESH | _GEOM.mjGEOM_SDF:
            return _mesh(model, int(model.geom_dataid[geom]))
        case _GEOM.mjGEOM_HFIELD:
            return _field(model, int(model.geom_dataid[geom]))
    return None


def colour(model: Any, geom: int) -> tuple[int, int, int, float]:
    """Red, green, blue 0 to 255, and the opacity; the mean colour of a texture."""
    material = int(model.geom_matid[geom])
    rgba = model.geom_rgba[geom] if material < 0 else model.mat_rgba[material]
    rgb = rgba[:3]
    if material >= 0:
        texture = int(model.mat_texid[material][mujoco.mjtTextureRole.mjTEXROLE_RGB])
        rgb = rgb * (_mean(model, texture) if texture >= 0 else 1.0)
    red, green, blue = np.clip(rgb * 255, 0, 255).astype(int).tolist()
    return red, green, blue, float(rgba[3])


def _mean(model: Any, texture: int) -> NDArray[np.float64]:
    start, channels = int(model.tex_adr[texture]), int(model.tex_nchannel[texture])
    count = int(model.tex_height[texture]) * int(model.tex_width[texture]) * channels
    pixels = model.tex_data[start : start + count].reshape(-1, channels)
    mean: NDArray[np.float64] = np.resize(pixels.mean(axis=0) / 255, 3)
    return mean


def _box(half: NDArray[np.float64], centre: NDArray[np.float64]) -> Triangles:
    signs = np.array([[x, y, z] for x in (-1, 1) for y in (-1, 1) for z in (-1, 1)], dtype=float)
    squares = [(0, 1, 3, 2), (4, 6, 7, 5), (0, 4, 5, 1), (2, 3, 7, 6), (0, 2, 6, 4), (1, 5, 7, 3)]
    faces = [face for a, b, c, d in squares for face in ((a, b, c), (a, c, d))]
    return Triangles(signs * half + centre, np.array(faces, dtype=np.int32))


def _arc(low: float, high: float) -> NDArray[np.float64]:
    """Points (r, z) on the unit circle between two angles in degrees."""
    turn = np.radians(np.linspace(low, high, _ARC + 1))
    return np.stack((np.cos(turn), np.sin(turn)), axis=1)


def _lathe(profile: NDArray[np.float64]) -> Triangles:
    """The surface of revolution of (r, z) points about z, from bottom to top."""
    turn = np.arange(_AROUND) * (2 * math.pi / _AROUND)
    ring = np.stack((np.cos(turn), np.sin(turn)), axis=1)
    points = [np.column_stack((max(r, 0.0) * ring, np.full(_AROUND, z))) for r, z in profile]
    here = np.arange(_AROUND)
    ahead = (here + 1) % _AROUND
    faces = []
    for level in range(len(profile) - 1):
        a, b = here + level * _AROUND, ahead + level * _AROUND
        c, d = b + _AROUND, a + _AROUND
        faces += [np.stack((a, b, c), axis=1), np.stack((a, c, d), axis=1)]
    return Triangles(np.concatenate(points), np.concatenate(faces).astype(np.int32))


def _mesh(model: Any, mesh: int) -> Triangles | None:
    if mesh < 0:
        return None
    first, count = int(model.mesh_vertadr[mesh]), int(model.mesh_vertnum[mesh])
    start, faces = int(model.mesh_faceadr[mesh]), int(model.mesh_facenum[mesh])
    points = model.mesh_vert[first : first + count].astype(np.float64)
    return Triangles(points, model.mesh_face[start : start + faces].astype(np.int32))


def _field(model: Any, field: int) -> Triangles:
    rows, columns = int(model.hfield_nrow[field]), int(model.hfield_ncol[field])
    start = int(model.hfield_adr[field])
    heights = model.hfield_data[start : start + rows * columns]
    wide, deep, high, _ = model.hfield_size[field].tolist()
    x, y = np.meshgrid(np.linspace(-wide, wide, columns), np.linspace(-deep, deep, rows))
    points = np.stack((x.ravel(), y.ravel(), heights * high), axis=1)
    corner = (np.arange(rows - 1)[:, None] * columns + np.arange(columns - 1)).ravel()
    cell = np.stack((corner, corner + 1, corner + columns + 1), axis=1)
    two = np.stack((corner, corner + columns + 1, corner + columns), axis=1)
    return Triangles(points, np.concatenate((cell, two)).astype(np.int32))
