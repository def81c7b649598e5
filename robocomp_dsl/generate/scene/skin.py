"""Lower skin to the data of its simulation: limbs, and patches with all their taxels.

In: a `<skin>` of an InnerModel body, or a tactile description. Out: the same data for both, in m,
for `hardware.description.scene_skin.Skin.of_data`. A skin of InnerModel is one limb, whose frame is
that of its first patch.
"""

from __future__ import annotations

import math
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

from robocomp_dsl.hardware.kinematics.rotations import rotation
from robocomp_dsl.model import innermodel
from robocomp_dsl.regular_file import read_text
from robocomp_dsl.tactile.description.model import RobotDescription
from robocomp_dsl.tactile.errors import DescriptionError
from robocomp_dsl.tactile.skin.cone import Cone
from robocomp_dsl.tactile.skin.layout import TaxelLayout, place_rings
from robocomp_dsl.tactile.skin.normalise import Sensitivity
from robocomp_dsl.tactile.skin.positions import read_positions

Data = dict[str, Any]
Floats = NDArray[np.float64]

MM = 1e-3

_EMPTY_LAYOUT = TaxelLayout(np.zeros(0, np.int64), np.zeros((0, 3)), np.zeros((0, 3)))


@dataclass(frozen=True, eq=False)
class _Frame:
    """A frame in the body: a point p of it is at `orientation` @ p + `position`."""

    position: Floats
    orientation: Floats

    def to_body(self, points: Floats) -> Floats:
        """Points (n, 3) of the frame in the body."""
        transformed: Floats = points @ self.orientation.T + self.position
        return transformed

    def from_body(self, points: Floats) -> Floats:
        """Points (n, 3) of the body in the frame."""
        transformed: Floats = (points - self.position) @ self.orientation
        return transformed


def lower_robot(robot: RobotDescription) -> Data:
    """The complete skin of a description."""
    limbs, patches = [], []
    for part in robot.parts:
        for limb in part.limbs:
            data = _limb(f"{part.name}/{limb.name}", limb.body, limb.origin, limb.axes)
            limbs.append(data | {"covers": list(limb.covers)})
        for patch in part.patches:
            rows = _taxel_rows(np.array(patch.ids), patch.points, patch.normals)
            limb_name = f"{part.name}/{patch.limb}"
            patches.append(_patch(patch.name, limb_name, rows, patch.sensitivity))
    return {"id": robot.name, "limbs": limbs, "patches": patches}


def lower_skin(skin: innermodel.Skin, frame: str) -> Data:
    """The skin of an InnerModel body in a frame of it.

    The checks report its errors; here a patch that cannot be laid out is empty.
    """
    patches = [child for child in skin.children if isinstance(child, innermodel.Patch)]
    frames = [_frame(patch) for patch in patches]
    first = frames[0] if frames else _Frame(np.zeros(3), np.eye(3))
    lowered = [_lower_patch(p, f, first, skin.id) for p, f in zip(patches, frames, strict=True)]
    return {
        "id": skin.id,
        "limbs": [_limb(skin.id, frame, first.position, first.orientation)],
        "patches": lowered,
    }


def _lower_patch(patch: innermodel.Patch, frame: _Frame, limb: _Frame, name: str) -> Data:
    try:
        layout = _layout(patch, frame)
        sensor = Sensitivity(patch.gain, patch.floor, patch.saturation)
    except (DescriptionError, OSError, ValueError):
        layout, sensor = _EMPTY_LAYOUT, Sensitivity()
    points = limb.from_body(frame.to_body(layout.points))
    normals = layout.normals @ frame.orientation.T @ limb.orientation
    rows = _taxel_rows(layout.offset + patch.firstid, points, normals)
    return _patch(patch.id, name, rows, sensor)


def _frame(patch: innermodel.Patch) -> _Frame:
    place = np.array([patch.tx, patch.ty, patch.tz]) * MM
    return _Frame(place, rotation(patch.rx, patch.ry, patch.rz))


def _layout(patch: innermodel.Patch, frame: _Frame) -> TaxelLayout:
    """The taxels of a patch in its own frame."""
    if patch.rings:
        if not 0 < patch.count <= innermodel.MAX_MODULES:
            raise ValueError("invalid number of modules")
        return place_rings(_cone(patch), tuple(x * MM for x in patch.rings), patch.count)
    if patch.file:
        path = patch.span.source.path.parent / patch.file
        return _from_file(path, frame)
    taxels = [child for child in patch.children if isinstance(child, innermodel.Taxel)]
    placed = [_taxel(taxel, patch) for taxel in taxels]
    points = np.array([point for point, _ in placed]).reshape(-1, 3)
    normals = np.array([normal for _, normal in placed]).reshape(-1, 3)
    return TaxelLayout(np.arange(len(taxels)), points, normals)


def _from_file(path: Path, frame: _Frame) -> TaxelLayout:
    """Positions measured in the frame of the body; rows without a taxel only count."""
    read = read_positions(read_text(path), path)
    used = np.flatnonzero(read.used)
    return TaxelLayout(
        used, frame.from_body(read.positions[used]), read.normals[used] @ frame.orientation
    )


def _taxel(taxel: innermodel.Taxel, patch: innermodel.Patch) -> tuple[Floats, Floats]:
    """Point and normal."""
    if taxel.theta is not None:
        cone = _cone(patch)
        return cone.points(taxel.x * MM, taxel.theta), cone.normals(taxel.theta)
    normal = np.array([taxel.nx, taxel.ny, taxel.nz])
    return np.array([taxel.x, taxel.y, taxel.z]) * MM, normal / max(
        float(np.linalg.norm(normal)), 1e-300
    )


def _cone(patch: innermodel.Patch) -> Cone:
    return Cone(patch.x0 * MM, patch.x1 * MM, patch.r0 * MM, patch.r1 * MM)


def _limb(name: str, on: str, origin: Floats, axes: Floats) -> Data:
    return {
        "name": name,
        "body": on,
        "origin": _round(origin),
        "axes": [_round(row) for row in axes],
    }


def _patch(name: str, limb: str, rows: list[list[float]], sensor: Sensitivity) -> Data:
    data: Data = {"name": name, "limb": limb, "gain": sensor.gain, "floor": sensor.floor}
    if math.isfinite(sensor.saturation):
        data["saturation"] = sensor.saturation
    return data | {"taxels": rows}


def _taxel_rows(ids: NDArray[Any], points: Floats, normals: Floats) -> list[list[float]]:
    """One row per taxel: id, point, normal."""
    return [
        [int(i), *_round(point), *_round(normal)]
        for i, point, normal in zip(ids, points, normals, strict=True)
    ]


def _round(numbers: Floats) -> list[float]:
    """Numbers rounded to the nanometre, without negative zeros."""
    return [round(number, 9) + 0.0 for number in np.asarray(numbers, float).tolist()]
