"""A skin's geometry as its component tells it, for those who take its frames.

In: an answer to `getGeometry` of Skin.idsl, by the names of its fields: whoever answers may be
wrong. Out: `SkinGeometry`, or `BadGeometry`.
"""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any, Protocol

import numpy as np

from robocomp_dsl.tactile.arrays import Floats, Ints
from robocomp_dsl.tactile.description.model import Limb
from robocomp_dsl.tactile.errors import BadGeometry
from robocomp_dsl.tactile.skin.cone import Cone
from robocomp_dsl.tactile.skin.geometry import SkinGeometry
from robocomp_dsl.tactile.skin.normalise import Sensitivity

PLACES = ("x", "y", "z")
NORMALS = ("nx", "ny", "nz")
ROTATION = tuple(f"r{row}{column}" for row in range(3) for column in range(3))


class Told(Protocol):
    """`Geometry` of Skin.idsl; the arrays (n,) are fields, too."""

    version: int

    @property
    def patches(self) -> Sequence[Any]:
        """`Patches` of Skin.idsl."""

    @property
    def limbs(self) -> Sequence[Any]:
        """`Limbs` of Skin.idsl."""


def told_geometry(told: Told) -> SkinGeometry:
    """What `told` says; the cones of the limbs are not told. Raises `BadGeometry`."""
    ids, patch, limb = (_whole(told, name) for name in ("id", "patch", "limb"))
    points, normals = (_columns(told, names) for names in (PLACES, NORMALS))
    for name, size in (("patch", len(patch)), ("limb", len(limb)), ("x", len(points))):
        if size != len(ids):
            raise BadGeometry(f"`{name}` has {size} entries for {len(ids)} taxels")
    if len(normals) != len(ids):
        raise BadGeometry(f"`nx` has {len(normals)} entries for {len(ids)} taxels")
    _indices("patch", patch, len(told.patches))
    _indices("limb", limb, len(told.limbs))
    return SkinGeometry(
        version=told.version,
        ids=ids,
        patch=patch,
        limb=limb,
        points=points,
        normals=normals,
        patches=tuple(one.name for one in told.patches),
        limbs=tuple(one.name for one in told.limbs),
        sensitivities=tuple(_sensitivity(one) for one in told.patches),
        frames=tuple(_limb(one) for one in told.limbs),
    )


def _whole(told: Told, name: str) -> Ints:
    return np.asarray(getattr(told, name), dtype=np.int64)


def _columns(told: Told, names: tuple[str, ...]) -> Floats:
    columns = [np.asarray(getattr(told, name), dtype=np.float64) for name in names]
    if len({one.shape for one in columns}) != 1:
        raise BadGeometry(f"{', '.join(f'`{name}`' for name in names)} differ in length")
    made = np.column_stack(columns)
    if not np.isfinite(made).all():
        raise BadGeometry(f"{', '.join(f'`{name}`' for name in names)} hold NaN or infinity")
    return made


def _indices(name: str, index: Ints, size: int) -> None:
    if len(index) and (index.min() < 0 or index.max() >= size):
        raise BadGeometry(f"`{name}` refers to entry {index.max()} of a list of {size}")


def _sensitivity(one: Any) -> Sensitivity:
    try:
        return Sensitivity(one.gain, one.floor, one.saturation)
    except ValueError as error:
        raise BadGeometry(f"patch `{one.name}`: {error}") from None


def _limb(one: Any) -> Limb:
    """The limb without its shape, which is that of the skin upon it."""
    rotation = np.array([getattr(one, name) for name in ROTATION]).reshape(3, 3)
    origin = np.array([one.x, one.y, one.z])
    return Limb(one.name.rpartition("/")[2], one.body, origin, rotation, _NO_CONE)


_NO_CONE = Cone(0.0, 1.0, 1.0, 1.0)
