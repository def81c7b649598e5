"""Skin to the data that its simulation runs on: limbs, and patches with all their taxels.

In: a `<skin>` of an InnerModel body, or the description of a robot's touch. Out: the same data for
both, in m, for `hardware.scene_skin.Skin.of_data`. A skin of InnerModel is one limb, whose frame is
that of its first patch.
"""

from __future__ import annotations

import math
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

from robocomp_dsl.hardware.rotations import rotation
from robocomp_dsl.model import body
from robocomp_dsl.tactile.description.model import Robot
from robocomp_dsl.tactile.errors import DescriptionError
from robocomp_dsl.tactile.skin.cone import Cone
from robocomp_dsl.tactile.skin.layout import Layout, rings
from robocomp_dsl.tactile.skin.normalise import Sensitivity
from robocomp_dsl.tactile.skin.positions import read_positions

Data = dict[str, Any]
Floats = NDArray[np.float64]

MM = 1e-3

_NOTHING = Layout(np.zeros(0, np.int64), np.zeros((0, 3)), np.zeros((0, 3)))


@dataclass(frozen=True, eq=False)
class _Frame:
    """A frame in that of the body: points go to `turn` @ point + `place`."""

    place: Floats
    turn: Floats

    def out(self, points: Floats) -> Floats:
        """Points (n, 3) of the frame in the body."""
        carried: Floats = points @ self.turn.T + self.place
        return carried

    def into(self, points: Floats) -> Floats:
        """Points (n, 3) of the body in the frame."""
        carried: Floats = (points - self.place) @ self.turn
        return carried


def lower_robot(robot: Robot) -> Data:
    """All skin of a description."""
    limbs, patches = [], []
    for part in robot.parts:
        for limb in part.limbs:
            made = _limb(f"{part.name}/{limb.name}", limb.body, limb.origin, limb.axes)
            limbs.append(made | {"covers": list(limb.covers)})
        for patch in part.patches:
            rows = _rows(np.array(patch.ids), patch.points, patch.normals)
            limb_name = f"{part.name}/{patch.limb}"
            patches.append(_patch(patch.name, limb_name, rows, patch.sensitivity))
    return {"id": robot.name, "limbs": limbs, "patches": patches}


def lower_skin(skin: body.Skin, frame: str) -> Data:
    """The skin of an InnerModel body in a frame of it.

    What is wrong with it has been told by the checks: a patch that cannot be laid out is empty.
    """
    patches = [one for one in skin.children if isinstance(one, body.Patch)]
    frames = [_frame(one) for one in patches]
    first = frames[0] if frames else _Frame(np.zeros(3), np.eye(3))
    made = [_lower_patch(p, f, first, skin.id) for p, f in zip(patches, frames, strict=True)]
    return {
        "id": skin.id,
        "limbs": [_limb(skin.id, frame, first.place, first.turn)],
        "patches": made,
    }


def _lower_patch(patch: body.Patch, frame: _Frame, limb: _Frame, name: str) -> Data:
    try:
        layout = _layout(patch, frame)
        sensor = Sensitivity(patch.gain, patch.floor, patch.saturation)
    except (DescriptionError, OSError, ValueError):
        layout, sensor = _NOTHING, Sensitivity()
    points = limb.into(frame.out(layout.points))
    normals = layout.normals @ frame.turn.T @ limb.turn
    rows = _rows(layout.offset + patch.firstid, points, normals)
    return _patch(patch.id, name, rows, sensor)


def _frame(patch: body.Patch) -> _Frame:
    place = np.array([patch.tx, patch.ty, patch.tz]) * MM
    return _Frame(place, rotation(patch.rx, patch.ry, patch.rz))


def _layout(patch: body.Patch, frame: _Frame) -> Layout:
    """The taxels of a patch in its own frame."""
    if patch.rings:
        if not 0 < patch.count <= body.MOST_MODULES:
            raise ValueError("no such number of modules can be laid out")
        return rings(_cone(patch), tuple(x * MM for x in patch.rings), patch.count)
    if patch.file:
        path = patch.span.source.path.parent / patch.file
        return _from_file(path, frame)
    taxels = [one for one in patch.children if isinstance(one, body.Taxel)]
    placed = [_taxel(one, patch) for one in taxels]
    points = np.array([point for point, _ in placed]).reshape(-1, 3)
    normals = np.array([normal for _, normal in placed]).reshape(-1, 3)
    return Layout(np.arange(len(taxels)), points, normals)


def _from_file(path: Path, frame: _Frame) -> Layout:
    """Positions measured in the frame of the body; rows without a taxel only count."""
    read = read_positions(path.read_text(encoding="utf-8"), path)
    used = np.flatnonzero(read.used)
    return Layout(used, frame.into(read.positions[used]), read.normals[used] @ frame.turn)


def _taxel(one: body.Taxel, patch: body.Patch) -> tuple[Floats, Floats]:
    """Point and normal."""
    if one.theta is not None:
        cone = _cone(patch)
        return cone.points(one.x * MM, one.theta), cone.normals(one.theta)
    normal = np.array([one.nx, one.ny, one.nz])
    return np.array([one.x, one.y, one.z]) * MM, normal / max(float(np.linalg.norm(normal)), 1e-300)


def _cone(patch: body.Patch) -> Cone:
    return Cone(patch.x0 * MM, patch.x1 * MM, patch.r0 * MM, patch.r1 * MM)


def _limb(name: str, on: str, origin: Floats, axes: Floats) -> Data:
    return {
        "name": name,
        "body": on,
        "origin": _short(origin),
        "axes": [_short(row) for row in axes],
    }


def _patch(name: str, limb: str, rows: list[list[float]], sensor: Sensitivity) -> Data:
    made: Data = {"name": name, "limb": limb, "gain": sensor.gain, "floor": sensor.floor}
    if math.isfinite(sensor.saturation):
        made["saturation"] = sensor.saturation
    return made | {"taxels": rows}


def _rows(ids: NDArray[Any], points: Floats, normals: Floats) -> list[list[float]]:
    """One row for each taxel: id, point, normal."""
    return [
        [int(i), *_short(point), *_short(normal)]
        for i, point, normal in zip(ids, points, normals, strict=True)
    ]


def _short(numbers: Floats) -> list[float]:
    """To the nanometre, without the minus of a zero."""
    return [round(one, 9) + 0.0 for one in np.asarray(numbers, float).tolist()]
