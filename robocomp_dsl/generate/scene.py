"""A body to the data that its simulation and its devices run on.

In: a resolved `Body`. Out: frames, shapes and devices as JSON holds them, for
`hardware.scene.Scene.of_data`: every kind of node becomes one of the three, limits that are
infinite are left out.
"""

from __future__ import annotations

import math
from dataclasses import fields
from typing import Any

from robocomp_dsl.generate.skin import lower_skin
from robocomp_dsl.model import body

Data = dict[str, Any]

_NOT_SETTINGS = {"id", "tag", "span", "children"}
_STICKS = (("x", "#ff0000"), ("y", "#00ff00"), ("z", "#0000ff"))


def lower(source: body.Body) -> Data:
    """The data of `source`."""
    made: Data = {"frames": [{"id": source.root.id, "parent": ""}]}
    made |= {"boxes": [], "meshes": [], "devices": [], "skins": []}
    taken = {node.id for node, _ in source.nodes()}
    for node, parent in source.nodes():
        if parent is not None:
            _lower(node, parent, made, taken)
    return made


def _lower(node: body.Node, parent: body.Node, made: Data, taken: set[str]) -> None:
    match node:
        case body.Transform() | body.PrismaticJoint():
            made["frames"].append(_frame(node, parent))
        case body.TouchSensor():
            made["frames"].append({"id": node.id, "parent": parent.id})
        case body.Plane():
            made["boxes"].append(_box(node, parent))
        case body.Mesh():
            made["meshes"].append(_mesh(node, parent))
        case body.Axes():
            made["boxes"] += _sticks(node, parent, taken)
        case body.Skin() if any(one["limbs"][0]["body"] == parent.id for one in made["skins"]):
            return  # a frame has one skin; the checks have told so
        case body.Skin():
            made["skins"].append(lower_skin(node, parent.id))
    if isinstance(node, _SERVED) or node.tag == "display":
        made["devices"].append(_device(node, parent))


_SERVED = (
    body.Skin,
    body.Joint,
    body.PrismaticJoint,
    body.Base,
    body.TouchSensor,
    body.Camera,
    body.Laser,
    body.Imu,
    body.Gps,
    body.Ultrasound,
    body.Battery,
    body.PointCloud,
)


def _frame(node: body.Transform | body.PrismaticJoint, parent: body.Node) -> Data:
    made: Data = {"id": node.id, "parent": parent.id}
    if isinstance(node, body.PrismaticJoint):
        place = [0.0, 0.0, 0.0]
        place["xyz".index(node.axis)] = node.position + node.offset
        return made | {"place": place, "motion": _motion(node, "slide", node.offset)}
    made["place"] = [node.tx, node.ty, node.tz]
    made["turn"] = [node.rx, node.ry, node.rz]
    if isinstance(node, body.Joint):
        made["motion"] = _motion(node, "hinge", 0.0)
    if node.mass > 0:
        made["mass"] = node.mass
    return made | {"drives": isinstance(node, body.Base), "physics": node.engine == "bullet"}


def _motion(node: body.Joint | body.PrismaticJoint, kind: str, offset: float) -> Data:
    made: Data = {"kind": kind, "axis": node.axis, "home": node.home, "offset": offset}
    limits: Data = {"low": node.min, "high": node.max}
    for child in node.children:
        if isinstance(child, body.Motor):
            limits |= {"force": child.force, "gear": child.gear, "velocity": child.velocity}
    return made | {name: value for name, value in limits.items() if math.isfinite(value)}


def _box(node: body.Plane, parent: body.Node) -> Data:
    normal = [node.nx, node.ny, node.nz]
    if all(abs(part) < 0.001 for part in normal):  # as RoboComp has it
        normal[2] = -1.0
    made: Data = {
        "id": node.id,
        "frame": parent.id,
        "size": list(node.size),
        "place": [node.px, node.py, node.pz],
        "normal": normal,
        "colour": node.texture if node.texture.startswith("#") else "",
        "collide": node.collide,
    }
    if node.tag == "display":
        made["screen"] = True
    if not node.texture or node.texture.startswith("#"):
        return made
    picture = str(node.span.source.path.parent / node.texture)
    return made | {"texture": picture, "tile": float(node.repeat if node.repeat > 0 else 1000)}


def _mesh(node: body.Mesh, parent: body.Node) -> Data:
    return {
        "id": node.id,
        "frame": parent.id,
        "file": str(node.span.source.path.parent / node.file) if node.file else "",
        "place": [node.tx, node.ty, node.tz],
        "turn": [node.rx, node.ry, node.rz],
        "scale": list(node.scale),
        "collide": node.collide,
    }


def free(wanted: str, taken: set[str]) -> str:
    """A name like `wanted` that is not taken."""
    while wanted in taken:
        wanted += "'"
    return wanted


def _sticks(node: body.Axes, parent: body.Node, taken: set[str]) -> list[Data]:
    made = []
    for i, (axis, colour) in enumerate(_STICKS):
        length, width = getattr(node, f"length{axis}"), getattr(node, f"width{axis}")
        length = length if length > 0 else node.length if node.length >= 0 else 200.0
        width = width if width > 0 else node.width if node.width >= 0 else 15.0
        size, place = [width] * 3, [0.0] * 3
        size[i], place[i] = length, length / 2
        # with this normal a box stands along the axes of its frame
        stick = {"size": size, "place": place, "normal": [0.0, 0.0, -1.0], "colour": colour}
        made.append(
            {"id": free(f"{node.id}.{axis}", taken), "frame": parent.id, "collide": False} | stick
        )
    return made


def _device(node: body.Node, parent: body.Node) -> Data:
    """The settings are the attributes, without those that are infinite."""
    settings = {
        one.name: value
        for one in fields(node)
        if one.name not in _NOT_SETTINGS
        and not isinstance(value := getattr(node, one.name), tuple)
        and not (isinstance(value, float) and math.isinf(value))
    }
    frame = node.id if body.is_frame(node) else parent.id
    return {"id": node.id, "kind": node.tag, "frame": frame, "settings": settings}
