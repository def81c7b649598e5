"""The shapes of a scene as geoms of MuJoCo.

In: a body of an `MjSpec` and a shape. Out: a geom on the body, massless, or a marker; and a note on
deviations from the description. A file that does not exist gives no note: `world_files` has those.
"""

from __future__ import annotations

import math
from pathlib import Path
from typing import Any

import mujoco
import numpy as np

from robocomp_dsl.hardware.description.scene import Box, Mesh, Triple
from robocomp_dsl.hardware.description.world_files import exists
from robocomp_dsl.hardware.formats.mesh_file import read_mesh
from robocomp_dsl.hardware.formats.picture_file import PictureError, read_picture
from robocomp_dsl.hardware.formats.surface import MeshError, Surface, scaled, used_part
from robocomp_dsl.hardware.kinematics.rotations import Matrix, rotation
from robocomp_dsl.simulation.devices.screen import add_screen
from robocomp_dsl.simulation.models.mesh_geom import bounding_box_reason, is_flat
from robocomp_dsl.simulation.models.mesh_marker import add_marker
from robocomp_dsl.simulation.scene import axes
from robocomp_dsl.simulation.scene.axes import MM
from robocomp_dsl.simulation.scene.textures import add_material

_THINNEST = 1e-6  # m: MuJoCo geoms need a thickness
_SMALLEST = 1e-5  # m: MuJoCo rejects meshes of almost no area
_LARGEST = 1e6  # m
_GREY = (0.7, 0.7, 0.7, 1.0)
_GEOM = mujoco.mjtGeom
_UPRIGHT = rotation(math.pi / 2, 0.0, 0.0)
"""Turns y to z: MuJoCo's third axis, which is y here, along a plane's thickness."""


def add_box(spec: Any, body: Any, box: Box, notes: list[str]) -> None:
    """Add a box to `body`."""
    x, thick, y = _sized(box.size, box.id, notes)
    material = _material(spec, box, (x, y), notes)
    if material:  # MuJoCo maps pictures along the third axis of a box
        turned = rotation_to_normal(box.normal) @ _UPRIGHT
        geom = {"size": [x, y, thick], "quat": axes.quaternion(turned), "material": material}
    else:
        colour = _colour(box.colour, box.id, notes)
        geom = {
            "size": [x, thick, y],
            "quat": axes.quaternion(rotation_to_normal(box.normal)),
            "rgba": colour,
        }
    body.add_geom(
        name=box.id,
        type=_GEOM.mjGEOM_BOX,
        pos=axes.point(*box.place),
        **geom,
        **_touch(box.collide),
    )


def _material(spec: Any, box: Box, size: tuple[float, float], notes: list[str]) -> str:
    """The texture of a box: a picture, or a screen; empty for a colour."""
    if not box.texture and not box.screen:
        return ""
    try:
        if not box.screen:
            return add_material(spec, Path(box.texture), box.tile * MM)
        shown = read_picture(Path(box.texture)) if box.texture else None
    except PictureError as error:
        if exists(Path(box.texture)):
            notes.append(f"`{box.id}` has no picture: {box.texture}: {error}")
        if not box.screen:
            return ""
        shown = None
    if shown is None:
        colour = np.array(_colour(box.colour, box.id, notes)[:3]) * 255
        shown = colour.astype(np.uint8).reshape(1, 1, 3)
    return add_screen(spec, box.id, *size, shown)


def rotation_to_normal(normal: Triple) -> Matrix:
    """The rotation of a plane's thickness to `normal`, by the shortest rotation from -z.

    RoboComp's viewer turns z to the normal in its own frame, whose z is backwards.
    """
    length = math.sqrt(sum(part * part for part in normal))
    if not 0 < length < math.inf:
        return np.eye(3)
    x, y, z = (part / length for part in normal)
    if z > 1 - 1e-12:  # opposite direction: half a turn about y
        return np.diag([-1.0, 1.0, -1.0])
    # Rodrigues' formula for -z turned to (x, y, z); the axis is their product, the cosine is -z
    skew = np.array([[0, 0, -x], [0, 0, -y], [x, y, 0.0]])
    quat: Matrix = np.eye(3) + skew + skew @ skew / (1 - z)
    return quat


def add_mesh(spec: Any, body: Any, mesh: Mesh) -> str:
    """Add a mesh to `body`, or a marker if it cannot be read.

    Returns how the mesh deviates from its file; empty if it does not, or if there is no such file.
    """
    placed = {
        "name": mesh.id,
        "pos": axes.point(*mesh.place),
        "quat": axes.quaternion(rotation(*mesh.turn)),
    }
    try:
        whole = scaled(read_mesh(Path(mesh.file)), mesh.scale, _LARGEST / MM)
    except MeshError as error:
        add_marker(body, mesh.id, axes.point(*mesh.place))
        return f"a small marker: {error}" if not mesh.file or exists(Path(mesh.file)) else ""
    surface = used_part(whole)
    points = surface.points
    low, high = points.min(axis=0), points.max(axis=0)
    if len(surface.faces) and not is_flat(points) and (high - low).max() * MM > _SMALLEST:
        asset = spec.add_mesh(
            name=mesh.id,
            uservert=axes.points(points).ravel().tolist(),
            userface=_outside(surface, mesh.scale).ravel().tolist(),
            inertia=mujoco.mjtMeshInertia.mjMESH_INERTIA_SHELL,
        )
        body.add_geom(
            type=_GEOM.mjGEOM_MESH,
            meshname=asset.name,
            rgba=_GREY,
            **placed,
            **_touch(mesh.collide),
        )
        return ""
    centre = rotation(*mesh.turn) @ ((low + high) / 2) + mesh.place
    placed["pos"] = axes.point(*centre)
    half = _half(tuple((high - low).tolist()))
    body.add_geom(type=_GEOM.mjGEOM_BOX, size=half, rgba=_GREY, **placed, **_touch(mesh.collide))
    return "" if len(surface.faces) else bounding_box_reason(whole)


def _outside(surface: Surface, scale: Triple) -> Any:
    """Faces with the correct orientation: exchanging two axes mirrors them, as may a scale."""
    return surface.faces if math.prod(scale) < 0 else surface.faces[:, ::-1]


def _sized(size: Triple, name: str, notes: list[str]) -> list[float]:
    if any(part == 0 or not math.isfinite(part) for part in size):
        notes.append(f"`{name}` has no size that can be built: {size}")
    return _half(size)


def _half(size: Triple) -> list[float]:
    """Half of a size in m along MuJoCo's axes, greater than 0."""
    x, y, z = np.clip(np.nan_to_num(np.abs(size)) * MM / 2, _THINNEST, _LARGEST).tolist()
    return [x, z, y]


def _colour(written: str, name: str, notes: list[str]) -> tuple[float, float, float, float]:
    if not written:
        return _GREY
    try:
        red, green, blue = bytes.fromhex(written[1:])
    except ValueError:
        notes.append(f"`{name}` is grey: `{written}` is no colour")
        return _GREY
    return red / 255, green / 255, blue / 255, 1.0


def _touch(collide: bool) -> dict[str, int | float]:
    return {"contype": int(collide), "conaffinity": int(collide), "mass": 0.0}
