"""The geometry of a skin, from the message that its component sends.

In: the reply to `getGeometry` of Skin.idsl; its contents are validated. Out: `SkinGeometry`, or
`BadGeometry`.
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

POSITIONS = ("x", "y", "z")
NORMALS = ("nx", "ny", "nz")
ROTATION = tuple(f"r{row}{column}" for row in range(3) for column in range(3))


class GeometryMessage(Protocol):
    """`Geometry` of Skin.idsl; it also has the arrays (n,) as fields."""

    version: int

    @property
    def patches(self) -> Sequence[Any]:
        """`Patches` of Skin.idsl."""

    @property
    def limbs(self) -> Sequence[Any]:
        """`Limbs` of Skin.idsl."""


def geometry_from_message(message: GeometryMessage) -> SkinGeometry:
    """The geometry in `message`, which does not hold the cones of limbs. Raises `BadGeometry`."""
    ids, patch, limb = (_integers(message, name) for name in ("id", "patch", "limb"))
    points, normals = (_columns(message, names) for names in (POSITIONS, NORMALS))
    for name, size in (("patch", len(patch)), ("limb", len(limb)), ("x", len(points))):
        if size != len(ids):
            raise BadGeometry(f"`{name}` has {size} entries for {len(ids)} taxels")
    if len(normals) != len(ids):
        raise BadGeometry(f"`nx` has {len(normals)} entries for {len(ids)} taxels")
    _check_indices("patch", patch, len(message.patches))
    _check_indices("limb", limb, len(message.limbs))
    return SkinGeometry(
        version=message.version,
        ids=ids,
        patch=patch,
        limb=limb,
        points=points,
        normals=normals,
        patches=tuple(part.name for part in message.patches),
        limbs=tuple(part.name for part in message.limbs),
        sensitivities=tuple(_sensitivity(part) for part in message.patches),
        frames=tuple(_limb(part) for part in message.limbs),
    )


def _integers(message: GeometryMessage, name: str) -> Ints:
    return np.asarray(getattr(message, name), dtype=np.int64)


def _columns(message: GeometryMessage, names: tuple[str, ...]) -> Floats:
    columns = [np.asarray(getattr(message, name), dtype=np.float64) for name in names]
    if len({column.shape for column in columns}) != 1:
        raise BadGeometry(f"{', '.join(f'`{name}`' for name in names)} differ in length")
    matrix = np.column_stack(columns)
    if not np.isfinite(matrix).all():
        raise BadGeometry(f"{', '.join(f'`{name}`' for name in names)} hold NaN or infinity")
    return matrix


def _check_indices(name: str, index: Ints, size: int) -> None:
    if len(index) and (index.min() < 0 or index.max() >= size):
        raise BadGeometry(f"`{name}` refers to entry {index.max()} of a list of {size}")


def _sensitivity(patch: Any) -> Sensitivity:
    try:
        return Sensitivity(patch.gain, patch.floor, patch.saturation)
    except ValueError as error:
        raise BadGeometry(f"patch `{patch.name}`: {error}") from None


def _limb(limb: Any) -> Limb:
    """The limb without its shape, which the message lacks."""
    rotation = np.array([getattr(limb, name) for name in ROTATION]).reshape(3, 3)
    origin = np.array([limb.x, limb.y, limb.z])
    return Limb(limb.name.rpartition("/")[2], limb.body, origin, rotation, _UNKNOWN_CONE)


_UNKNOWN_CONE = Cone(0.0, 1.0, 1.0, 1.0)
