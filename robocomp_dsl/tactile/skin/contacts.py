"""The list of contacts of a skin: one entry for each touch.

In: geometry and forces of one frame. Out: centre, normal, force and area of every touch, as iCub's
skinContact has them, in the frame of the limb.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from robocomp_dsl.tactile.arrays import Floats, Ints
from robocomp_dsl.tactile.skin.geometry import SkinGeometry
from robocomp_dsl.tactile.skin.touches import TaxelGraph
from robocomp_dsl.tactile.skin.triangle import PITCH

TAXEL_AREA = float(np.sqrt(3.0) / 2.0 * PITCH**2)
"""Skin area per taxel of the triangular pattern [m²]."""


@dataclass(frozen=True, slots=True, eq=False)
class SkinContact:
    """One touch. Positions [m] and directions in the limb's frame, `force` [N] into the limb.

    `centre` is weighted by force, `middle` is the mean position of the taxels; `pressure` is the
    mean force of a taxel [N]; `area` [m²].
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


@dataclass(frozen=True, slots=True, eq=False)
class Touches:
    """All touches of one frame as columns of k rows; see `SkinContact`.

    `limb` is the index of the limb, `count` that of taxels. `active` are all touched taxels, of
    which number i belongs to row `label[i]`.
    """

    limb: Ints
    count: Ints
    centre: Floats
    middle: Floats
    normal: Floats
    force: Floats
    shear: Floats
    active: Ints
    label: Ints

    @property
    def pressure(self) -> Floats:
        """Mean force of a taxel (k,) [N]."""
        return np.asarray(self.force / self.count, dtype=np.float64)

    @property
    def area(self) -> Floats:
        """Skin that is touched (k,) [m²]."""
        return np.asarray(self.count * TAXEL_AREA, dtype=np.float64)


def touches(
    geometry: SkinGeometry,
    graph: TaxelGraph,
    force: Floats,
    shear: Floats | None = None,
    threshold: float = 0.0,
) -> Touches:
    """The touches of one frame, lowest taxel first; `force` (n,), `shear` (n, 3) or None."""
    active = np.flatnonzero(force > threshold)
    label = graph.labels(active)
    count = np.bincount(label)
    k, share = len(count), force[active]

    def summed(columns: Floats) -> Floats:
        sums = np.empty((k, 3))
        for i in range(3):
            sums[:, i] = np.bincount(label, columns[:, i], k)
        return sums

    total = np.asarray(np.bincount(label, share, k), dtype=np.float64)
    points = geometry.points[active]
    normal = summed(geometry.normals[active] * share[:, None])
    length = np.linalg.norm(normal, axis=1, keepdims=True)
    np.divide(normal, length, out=normal, where=length > 0.0)
    return Touches(
        limb=geometry.limb[active[np.unique(label, return_index=True)[1]]],
        count=count,
        centre=summed(points * share[:, None]) / total[:, None],
        middle=summed(points) / count[:, None],
        normal=normal,
        force=total,
        shear=np.zeros((k, 3)) if shear is None else summed(shear[active]),
        active=active,
        label=label,
    )


def contacts(
    geometry: SkinGeometry,
    graph: TaxelGraph,
    force: Floats,
    shear: Floats | None = None,
    threshold: float = 0.0,
) -> list[SkinContact]:
    """The result of `touches`, as one object per touch."""
    columns = touches(geometry, graph, force, shear, threshold)
    return [
        SkinContact(
            limb=geometry.limbs[columns.limb[i]],
            taxels=columns.active[columns.label == i],
            centre=columns.centre[i],
            middle=columns.middle[i],
            normal=columns.normal[i],
            force=float(columns.force[i]),
            shear=columns.shear[i],
            pressure=float(columns.pressure[i]),
            area=float(columns.area[i]),
        )
        for i in range(len(columns.force))
    ]
