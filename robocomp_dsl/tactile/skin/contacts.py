"""The list of contacts that a skin tells: one entry for each touch.

In: geometry and forces of one frame. Out: centre, normal, force and area of every touch, as iCub's
skinContact has them, in the frame of the limb.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from robocomp_dsl.tactile.arrays import Floats, Ints
from robocomp_dsl.tactile.skin.geometry import SkinGeometry
from robocomp_dsl.tactile.skin.touches import Neighbours
from robocomp_dsl.tactile.skin.triangle import PITCH

TAXEL_AREA = float(np.sqrt(3.0) / 2.0 * PITCH**2)
"""Skin that one taxel of the triangular pattern stands for [m²]."""


@dataclass(frozen=True, slots=True, eq=False)
class SkinContact:
    """One touch. Positions [m] and directions in the limb's frame, `force` [N] into the limb.

    `centre` is weighted by force, `middle` is the mean place of the taxels; `pressure` is the mean
    force of a taxel [N]; `area` [m²].
    """

    limb: str
    taxels: Ints
    centre: Floats
    middle: Floats
    normal: Floats
    force: float
    shear: Floats
    pressure: float
    area: float


def contacts(
    geometry: SkinGeometry,
    neighbours: Neighbours,
    force: Floats,
    shear: Floats | None = None,
    threshold: float = 0.0,
) -> list[SkinContact]:
    """The touches of one frame, lowest taxel first; `force` (n,), `shear` (n, 3) or None."""
    found = []
    for touch in neighbours.touches(force > threshold):
        share = force[touch]
        total = float(share.sum())
        normal = share @ geometry.normals[touch]
        length = float(np.linalg.norm(normal))
        found.append(
            SkinContact(
                limb=geometry.limbs[int(geometry.limb[touch[0]])],
                taxels=touch,
                centre=share @ geometry.points[touch] / total,
                middle=geometry.points[touch].mean(axis=0),
                normal=normal / length if length > 0.0 else normal,
                force=total,
                shear=np.zeros(3) if shear is None else shear[touch].sum(axis=0),
                pressure=total / len(touch),
                area=len(touch) * TAXEL_AREA,
            )
        )
    return found
