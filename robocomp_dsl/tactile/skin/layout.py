"""Place the taxels of a patch on the limb's cone.

In: triangle modules placed by (x, theta), or single taxels. Out: channel numbers, points and
normals in the limb frame. A module is bent around the cone: its own x axis goes around the limb.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from robocomp_dsl.tactile.arrays import Floats, Ints
from robocomp_dsl.tactile.skin import triangle
from robocomp_dsl.tactile.skin.cone import Cone


@dataclass(frozen=True, eq=False)
class TaxelLayout:
    """Taxels `offset` (n,), counted from the first of the patch, at `points` with `normals`."""

    offset: Ints
    points: Floats
    normals: Floats


def place_rings(cone: Cone, x: tuple[float, ...], count: int) -> TaxelLayout:
    """`count` evenly spaced modules around the limb at each x, alternately upside down.

    Neighbouring rings are shifted by half a step, so that gaps are not aligned.
    """
    step = 2 * np.pi / count
    layouts = []
    for ring, place in enumerate(x):
        for i in range(count):
            theta = (i + 0.5 * (ring % 2)) * step
            layouts.append(place_module(cone, place, theta, upside_down=bool((i + ring) % 2)))
    offset = [layout.offset + i * triangle.CHANNELS for i, layout in enumerate(layouts)]
    return TaxelLayout(
        np.concatenate(offset),
        np.concatenate([layout.points for layout in layouts]),
        np.concatenate([layout.normals for layout in layouts]),
    )


def place_module(cone: Cone, x: float, theta: float, *, upside_down: bool = False) -> TaxelLayout:
    """The ten pressure taxels of one module centred at (x, theta)."""
    channels = np.array(triangle.PRESSURE)
    flat = triangle.LAYOUT[channels] * (-1.0 if upside_down else 1.0)
    middle = _MIDDLE * (-1.0 if upside_down else 1.0)
    along = x + flat[:, 1] - middle
    angle = theta + flat[:, 0] / cone.radius(x)
    return TaxelLayout(channels, cone.points(along, angle), cone.normals(angle))


_EXTENT = triangle.LAYOUT[list(triangle.PRESSURE), 1]
_MIDDLE = float(_EXTENT.max() + _EXTENT.min()) / 2
"""The middle between the lowest and the highest taxel, which is placed on the ring."""


def place_taxels(cone: Cone, places: Floats) -> TaxelLayout:
    """Taxels at rows (x, theta) of `places` (n, 2)."""
    x, theta = places.reshape(-1, 2).T
    return TaxelLayout(np.arange(len(x)), cone.points(x, theta), cone.normals(theta))
