"""All taxels of a robot as parallel arrays: the order in which every frame lists its values.

In: a robot's description. Out: `SkinGeometry`. Its version goes up whenever a taxel is added, moved
or taken away, and every frame names the version that it belongs to.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import Protocol, Self

import numpy as np

from robocomp_dsl.tactile.arrays import Floats, Ints
from robocomp_dsl.tactile.description.model import Robot
from robocomp_dsl.tactile.skin.normalise import Normaliser, Sensitivity


class LimbFrame(Protocol):
    """Where the frame of a limb is on the robot; see `description.model.Limb`."""

    @property
    def name(self) -> str:
        """What the robot calls the limb."""

    @property
    def body(self) -> str:
        """The body that it is on."""

    @property
    def covers(self) -> tuple[str, ...]:
        """Further bodies below the same skin."""

    @property
    def origin(self) -> Floats:
        """Its place in the body, (3,)."""

    @property
    def axes(self) -> Floats:
        """Its axes as columns, (3, 3)."""


@dataclass(frozen=True, eq=False)
class SkinGeometry:
    """n taxels on patches on limbs.

    `ids`, `patch` and `limb` are (n,): the taxel's id and the index of its patch and limb; `points`
    and `normals` are (n, 3), in the frame of the taxel's limb. Names of limbs are `part/limb`.
    """

    version: int
    ids: Ints
    patch: Ints
    limb: Ints
    points: Floats
    normals: Floats
    patches: tuple[str, ...]
    limbs: tuple[str, ...]
    sensitivities: tuple[Sensitivity, ...] = ()
    frames: tuple[LimbFrame, ...] = ()

    @classmethod
    def of(cls, robot: Robot, version: int = 1) -> SkinGeometry:
        """The skin of all parts of `robot`, patch by patch in the order of its description."""
        limbs = [(f"{part.name}/{limb.name}", limb) for part in robot.parts for limb in part.limbs]
        index = {name: i for i, (name, _) in enumerate(limbs)}
        patches = [(part, patch) for part in robot.parts for patch in part.patches]
        sizes = [len(patch.ids) for _, patch in patches]
        owner = [index[f"{part.name}/{patch.limb}"] for part, patch in patches]
        none = np.empty((0, 3))
        return cls(
            version=version,
            ids=np.array([i for _, patch in patches for i in patch.ids], dtype=np.int64),
            patch=np.repeat(np.arange(len(patches)), sizes),
            limb=np.repeat(np.array(owner, dtype=np.int64), sizes),
            points=np.concatenate([none, *(patch.points for _, patch in patches)]),
            normals=np.concatenate([none, *(patch.normals for _, patch in patches)]),
            patches=tuple(patch.name for _, patch in patches),
            limbs=tuple(name for name, _ in limbs),
            sensitivities=tuple(patch.sensitivity for _, patch in patches),
            frames=tuple(limb for _, limb in limbs),
        )

    def __deepcopy__(self, memo: object) -> Self:
        """It never changes: copies of a world share it."""
        return self

    def same_taxels(self, other: SkinGeometry) -> bool:
        """Whether both, versions aside, have the same taxels in the same places."""
        mine, theirs = (
            [
                *(one.ids, one.patch, one.limb, one.points, one.normals),
                *(array for limb in one.frames for array in (limb.origin, limb.axes)),
            ]
            for one in (self, other)
        )
        return (
            (self.patches, self.limbs, self.sensitivities)
            == (other.patches, other.limbs, other.sensitivities)
            and [limb.body for limb in self.frames] == [limb.body for limb in other.frames]
            and all(np.array_equal(a, b) for a, b in zip(mine, theirs, strict=True))
        )

    @property
    def size(self) -> int:
        """Number of taxels."""
        return len(self.ids)

    @property
    def normaliser(self) -> Normaliser:
        """Newtons of the taxels' raw values, patch by patch."""
        return Normaliser.of(list(self.sensitivities), self.patch)
