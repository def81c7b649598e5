"""The floor plan of a world: outlines of all static bodies, and distances to them.

In: a compiled MuJoCo model. Out: convex polygons in mm (x, z), for pictures and for distances of
paths to obstacles.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from itertools import product
from typing import Any

import mujoco
import numpy as np
from numpy.typing import NDArray

from robocomp_dsl.simulation.scene import axes

_TURNS = np.linspace(0, 2 * np.pi, 48, endpoint=False)
_CORNERS = np.array(list(product((-1.0, 1.0), repeat=3)))
_GEOM = mujoco.mjtGeom


@dataclass(frozen=True, slots=True, eq=False)
class Outline:
    """One outline from above: its name and its corners in order, shape (n, 2), mm."""

    name: str
    corners: NDArray[np.float64]


def outlines(model: Any) -> tuple[Outline, ...]:
    """Outlines of the fixed geoms of `model` without floors (planes)."""
    data = mujoco.MjData(model)
    mujoco.mj_kinematics(model, data)
    found = []
    for i in range(model.ngeom):
        fixed = model.body_weldid[model.geom_bodyid[i]] == 0
        if fixed and model.geom_type[i] != _GEOM.mjGEOM_PLANE:
            rotation = data.geom_xmat[i].reshape(3, 3)
            world = data.geom_xpos[i] + _surface(model, i) @ rotation.T
            found.append(Outline(model.geom(i).name, _hull(axes.floor(world))))
    return tuple(found)


def _surface(model: Any, geom: int) -> NDArray[np.float64]:
    """Points in the frame of a geom with the same convex hull from above, (n, 3)."""
    size = np.asarray(model.geom_size[geom], dtype=np.float64)
    match model.geom_type[geom]:
        case _GEOM.mjGEOM_CYLINDER:
            ring = np.stack([np.cos(_TURNS), np.sin(_TURNS)], axis=1) * size[0]
            surface = np.concatenate(
                [np.insert(ring, 2, end, axis=1) for end in (-size[1], size[1])]
            )
        case _GEOM.mjGEOM_SPHERE:
            surface = _ball() * size[0]
        case _GEOM.mjGEOM_ELLIPSOID:
            surface = _ball() * size
        case _GEOM.mjGEOM_CAPSULE:
            ball, axis = _ball() * size[0], np.array([0, 0, size[1]])
            surface = np.concatenate([ball - axis, ball + axis])
        case _GEOM.mjGEOM_MESH:
            mesh = model.geom_dataid[geom]
            first, count = model.mesh_vertadr[mesh], model.mesh_vertnum[mesh]
            surface = np.asarray(model.mesh_vert[first : first + count], dtype=np.float64)
        case _:
            centre, half = model.geom_aabb[geom, :3], model.geom_aabb[geom, 3:]
            surface = np.asarray(_CORNERS * half + centre, dtype=np.float64)
    return surface


def _ball() -> NDArray[np.float64]:
    rise = np.linspace(-np.pi / 2, np.pi / 2, 25)[:, None]
    grid = np.broadcast_arrays(
        np.cos(rise) * np.cos(_TURNS), np.cos(rise) * np.sin(_TURNS), np.sin(rise)
    )
    return np.stack(grid, axis=-1).reshape(-1, 3)


def _hull(points: NDArray[np.float64]) -> NDArray[np.float64]:
    """Corners of the convex hull of points (n, 2), in order (Andrew's monotone chain, 1979)."""
    ordered = sorted({(round(float(x), 6), round(float(z), 6)) for x, z in points})
    if len(ordered) < 3:
        return np.array(ordered)
    lower, upper = _chain(ordered), _chain(ordered[::-1])
    return np.array(lower[:-1] + upper[:-1])


def _chain(points: Sequence[tuple[float, float]]) -> list[tuple[float, float]]:
    chain: list[tuple[float, float]] = []
    for x, z in points:
        while len(chain) > 1:
            (ax, az), (bx, bz) = chain[-2:]
            if (bx - ax) * (z - az) - (bz - az) * (x - ax) > 0:
                break
            chain.pop()
        chain.append((x, z))
    return chain


def clearance(
    points: NDArray[np.float64], things: Sequence[Outline]
) -> tuple[NDArray[np.float64], NDArray[np.float64]]:
    """Distance of each of `points` (n, 2) to the nearest of `things`.

    Returns the distances in mm, shape (n,), and the nearest points of the outlines, shape (n, 2);
    infinite and NaN without outlines.
    """
    best = np.full(len(points), np.inf)
    nearest = np.full((len(points), 2), np.nan)
    for thing in things:
        for a, b in zip(thing.corners, np.roll(thing.corners, -1, axis=0), strict=True):
            along = b - a
            share = (points - a) @ along / max(float(along @ along), 1e-12)
            foot = a + np.clip(share, 0, 1)[:, None] * along
            distance = np.linalg.norm(points - foot, axis=1)
            closer = distance < best
            best[closer], nearest[closer] = distance[closer], foot[closer]
    return best, nearest
