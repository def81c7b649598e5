"""All taxels of a robot as parallel arrays: the order in which every frame lists its values.

In: a robot's description. Out: `SkinGeometry`. Its version goes up whenever a taxel is added, moved
or taken away, and every frame names the version that it belongs to.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from robocomp_dsl.tactile.arrays import Floats, Ints
from robocomp_dsl.tactile.description.model import Limb, Robot
from robocomp_dsl.tactile.skin.normalise import Normaliser, Sensitivity


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
    frames: tuple[Limb, ...] = ()

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

    @property
    def size(self) -> int:
        """Number of taxels."""
        return len(self.ids)

    @property
    def normaliser(self) -> Normaliser:
        """Newtons of the taxels' raw values, patch by patch."""
        return Normaliser.of(list(self.sensitivities), self.patch)
