"""All taxels of a robot as parallel arrays, in the order of the values of every frame.

In: a robot's description. Out: `SkinGeometry`. Its version increases when a taxel is added, moved
or removed; every frame holds the version that it belongs to.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import Protocol, Self

import numpy as np

from robocomp_dsl.tactile.arrays import Floats, Ints
from robocomp_dsl.tactile.description.model import RobotDescription
from robocomp_dsl.tactile.skin.normalise import Normaliser, Sensitivity


class LimbFrame(Protocol):
    """The frame of a limb on the robot; see `description.model.Limb`."""

    @property
    def name(self) -> str:
        """The name of the limb."""

    @property
    def body(self) -> str:
        """The body that the limb is on."""

    @property
    def covers(self) -> tuple[str, ...]:
        """Other bodies below the same skin."""

    @property
    def origin(self) -> Floats:
        """The frame's position in the body, (3,) [m]."""

    @property
    def axes(self) -> Floats:
        """The frame's axes as columns, (3, 3)."""


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
    def of(cls, robot: RobotDescription, version: int = 1) -> SkinGeometry:
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
        """Immutable: copies of a world share it."""
        return self

    def same_taxels(self, other: SkinGeometry) -> bool:
        """Whether both have the same taxels at the same positions, regardless of the version."""
        mine, theirs = (
            [
                *(geometry.ids, geometry.patch, geometry.limb, geometry.points, geometry.normals),
                *(array for limb in geometry.frames for array in (limb.origin, limb.axes)),
            ]
            for geometry in (self, other)
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
        """Newtons per raw value, for all taxels, patch by patch."""
        return Normaliser.of(list(self.sensitivities), self.patch)
