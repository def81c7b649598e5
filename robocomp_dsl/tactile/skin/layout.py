"""Where the taxels of a patch lie when only the limb's cone is known.

In: triangle modules placed by (x, theta), or single taxels. Out: channel numbers, points and
normals in the limb frame. A module is bent round the cone: its own x goes around the limb.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from robocomp_dsl.tactile.arrays import Floats, Ints
from robocomp_dsl.tactile.skin import triangle
from robocomp_dsl.tactile.skin.cone import Cone


@dataclass(frozen=True, eq=False)
class Layout:
    """Taxels `offset` (n,), counted from the first of the patch, at `points` with `normals`."""

    offset: Ints
    points: Floats
    normals: Floats


def rings(cone: Cone, x: tuple[float, ...], count: int) -> Layout:
    """`count` modules round the limb at each x, evenly, every other one upside down.

    From ring to ring they are shifted by half a step, so that gaps do not lie in a row.
    """
    step = 2 * np.pi / count
    layouts = []
    for ring, place in enumerate(x):
        for i in range(count):
            theta = (i + 0.5 * (ring % 2)) * step
            layouts.append(module(cone, place, theta, upside_down=bool((i + ring) % 2)))
    offset = [layout.offset + i * triangle.CHANNELS for i, layout in enumerate(layouts)]
    return Layout(
        np.concatenate(offset),
        np.concatenate([layout.points for layout in layouts]),
        np.concatenate([layout.normals for layout in layouts]),
    )


def module(cone: Cone, x: float, theta: float, *, upside_down: bool = False) -> Layout:
    """The ten pressure taxels of one module centred at (x, theta)."""
    channels = np.array(triangle.PRESSURE)
    flat = triangle.LAYOUT[channels] * (-1.0 if upside_down else 1.0)
    middle = _MIDDLE * (-1.0 if upside_down else 1.0)
    along = x + flat[:, 1] - middle
    around = theta + flat[:, 0] / cone.radius(x)
    return Layout(channels, cone.points(along, around), cone.normals(around))


_EXTENT = triangle.LAYOUT[list(triangle.PRESSURE), 1]
_MIDDLE = float(_EXTENT.max() + _EXTENT.min()) / 2
"""Half way between the lowest and the highest taxel, so that a module fills its ring evenly."""


def singles(cone: Cone, places: Floats) -> Layout:
    """Taxels at rows (x, theta) of `places` (n, 2)."""
    x, theta = places.reshape(-1, 2).T
    return Layout(np.arange(len(x)), cone.points(x, theta), cone.normals(theta))
