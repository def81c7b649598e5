"""The skin of a scene: positions of taxels on limbs.

In: plain data, as stored beside a generated component. Out: immutable values, and the geometry of
the frames. Lengths are m; a limb's frame is relative to its body, whose axes are those of the
world's language.
"""

from __future__ import annotations

import math
from collections.abc import Collection, Iterable, Mapping
from dataclasses import dataclass, replace
from typing import Any

import numpy as np
from numpy.typing import NDArray

from robocomp_dsl.tactile.skin.geometry import SkinGeometry
from robocomp_dsl.tactile.skin.normalise import Sensitivity

Row = tuple[float, ...]


@dataclass(frozen=True, slots=True)
class SkinLimb:
    """A limb on `body`: its frame is at `origin`, with the rows `axes`; it `covers` bodies."""

    name: str
    body: str
    origin: Row = (0.0, 0.0, 0.0)
    axes: tuple[Row, Row, Row] = ((1.0, 0.0, 0.0), (0.0, 1.0, 0.0), (0.0, 0.0, 1.0))
    covers: tuple[str, ...] = ()


@dataclass(frozen=True, slots=True)
class SkinPatch:
    """Taxels of one kind on one limb, one row each: id, point, normal.

    `gain` is in newtons per count, `floor` and `saturation` are in counts.
    """

    name: str
    limb: str
    taxels: tuple[Row, ...]
    gain: float = 1.0
    floor: float = 0.0
    saturation: float = math.inf


@dataclass(frozen=True, slots=True)
class Skin:
    """Patches to remove, move or merge."""

    id: str
    limbs: tuple[SkinLimb, ...] = ()
    patches: tuple[SkinPatch, ...] = ()

    @classmethod
    def of_data(cls, data: Mapping[str, Any]) -> Skin:
        """The skin in `data`, as `generate.skin` makes it."""
        return cls(
            data["id"],
            tuple(SkinLimb(**_tuples(entry)) for entry in data["limbs"]),
            tuple(SkinPatch(**_tuples(entry)) for entry in data["patches"]),
        )

    def without(self, gone: Collection[str]) -> Skin:
        """The skin without the patches `gone`."""
        return replace(
            self, patches=tuple(patch for patch in self.patches if patch.name not in gone)
        )

    def moved_to(self, body: str) -> Skin:
        """The skin of a limb moved to another body."""
        return replace(self, limbs=tuple(replace(limb, body=body) for limb in self.limbs))


def _tuples(entry: Mapping[str, Any]) -> dict[str, Any]:
    return {name: _tuple(value) for name, value in entry.items()}


def _tuple(value: Any) -> Any:
    return tuple(_tuple(element) for element in value) if isinstance(value, list) else value


@dataclass(frozen=True, slots=True, eq=False)
class Mount:
    """Pose of a limb in simulator conventions: `origin` (3,) m, `axes` (3, 3) as columns."""

    name: str
    body: str
    origin: NDArray[np.float64]
    axes: NDArray[np.float64]
    covers: tuple[str, ...] = ()


def geometry_of(skins: Iterable[Skin], version: int = 1) -> SkinGeometry:
    """All taxels of all skins, in order."""
    skins = tuple(skins)
    limbs = [limb for skin in skins for limb in skin.limbs]
    patches = [patch for skin in skins for patch in skin.patches]
    index = {limb.name: i for i, limb in enumerate(limbs)}
    sizes = [len(patch.taxels) for patch in patches]
    rows = np.array([row for patch in patches for row in patch.taxels]).reshape(-1, 7)
    owner = np.array([index[patch.limb] for patch in patches], dtype=np.int64)
    return SkinGeometry(
        version=version,
        ids=rows[:, 0].astype(np.int64),
        patch=np.repeat(np.arange(len(patches)), sizes),
        limb=np.repeat(owner, sizes),
        points=rows[:, 1:4].copy(),
        normals=rows[:, 4:].copy(),
        patches=tuple(patch.name for patch in patches),
        limbs=tuple(limb.name for limb in limbs),
        sensitivities=tuple(Sensitivity(p.gain, p.floor, p.saturation) for p in patches),
        frames=tuple(
            Mount(limb.name, limb.body, np.array(limb.origin), np.array(limb.axes), limb.covers)
            for limb in limbs
        ),
    )
