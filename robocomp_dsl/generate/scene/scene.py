"""Lower an InnerModel body to the data of its simulation and devices.

In: a resolved `Body`. Out: frames, shapes and devices as JSON data for
`hardware.description.scene.Scene.of_data`; infinite limits are left out.
"""

from __future__ import annotations

import math
from dataclasses import fields
from typing import Any

from robocomp_dsl.generate.scene.frames import lower_frame
from robocomp_dsl.generate.scene.skin import lower_skin
from robocomp_dsl.model import innermodel
from robocomp_dsl.model.touch_shapes import feels

Data = dict[str, Any]

_NOT_SETTINGS = {"id", "tag", "span", "children"}
_AXIS_COLOURS = (("x", "#ff0000"), ("y", "#00ff00"), ("z", "#0000ff"))


def lower_body(source: innermodel.InnerModel) -> Data:
    """The data of `source`."""
    data: Data = {"frames": [{"id": source.root.id, "parent": ""}]}
    data |= {"boxes": [], "meshes": [], "devices": [], "skins": []}
    taken = {node.id for node, _ in source.nodes()}
    for node, parent in source.nodes():
        if parent is not None:
            _lower(node, parent, data, taken)
    return data


def _lower(node: innermodel.Node, parent: innermodel.Node, data: Data, taken: set[str]) -> None:
    match node:
        case innermodel.Transform() | innermodel.PrismaticJoint():
            data["frames"].append(lower_frame(node, parent))
        case innermodel.TouchSensor():
            data["frames"].append({"id": node.id, "parent": parent.id})
            if not feels(node):
                return  # the checks report it
        case innermodel.Plane():
            data["boxes"].append(_box(node, parent))
        case innermodel.Mesh():
            data["meshes"].append(_mesh(node, parent))
        case innermodel.Axes():
            data["boxes"] += _axes_boxes(node, parent, taken)
        case innermodel.Skin() if any(
            skin["limbs"][0]["body"] == parent.id for skin in data["skins"]
        ):
            return  # a frame has one skin; the checks report a second one
        case innermodel.Skin():
            data["skins"].append(lower_skin(node, parent.id))
    if isinstance(node, _DEVICES) or node.tag == "display":
        data["devices"].append(_device(node, parent))


_DEVICES = (
    innermodel.Skin,
    innermodel.Joint,
    innermodel.PrismaticJoint,
    innermodel.Base,
    innermodel.TouchSensor,
    innermodel.Camera,
    innermodel.Laser,
    innermodel.Imu,
    innermodel.Gps,
    innermodel.Ultrasound,
    innermodel.Battery,
    innermodel.PointCloud,
)


def _box(node: innermodel.Plane, parent: innermodel.Node) -> Data:
    normal = [node.nx, node.ny, node.nz]
    if all(abs(part) < 0.001 for part in normal):  # RoboComp's default
        normal[2] = -1.0
    box: Data = {
        "id": node.id,
        "frame": parent.id,
        "size": list(node.size),
        "place": [node.px, node.py, node.pz],
        "normal": normal,
        "colour": node.texture if node.texture.startswith("#") else "",
        "collide": node.collide,
    }
    if node.tag == "display":
        box["screen"] = True
    if not node.texture or node.texture.startswith("#"):
        return box
    picture = str(node.span.source.path.parent / node.texture)
    return box | {"texture": picture, "tile": float(node.repeat if node.repeat > 0 else 1000)}


def _mesh(node: innermodel.Mesh, parent: innermodel.Node) -> Data:
    return {
        "id": node.id,
        "frame": parent.id,
        "file": str(node.span.source.path.parent / node.file) if node.file else "",
        "place": [node.tx, node.ty, node.tz],
        "turn": [node.rx, node.ry, node.rz],
        "scale": list(node.scale),
        "collide": node.collide,
    }


def unique_name(name: str, taken: set[str]) -> str:
    """A free name based on the requested one."""
    while name in taken:
        name += "'"
    return name


def _axes_boxes(node: innermodel.Axes, parent: innermodel.Node, taken: set[str]) -> list[Data]:
    boxes = []
    for i, (axis, colour) in enumerate(_AXIS_COLOURS):
        length, width = getattr(node, f"length{axis}"), getattr(node, f"width{axis}")
        length = length if length > 0 else node.length if node.length >= 0 else 200.0
        width = width if width > 0 else node.width if node.width >= 0 else 15.0
        size, place = [width] * 3, [0.0] * 3
        size[i], place[i] = length, length / 2
        # with this normal a box is aligned with the axes of its frame
        stick = {"size": size, "place": place, "normal": [0.0, 0.0, -1.0], "colour": colour}
        boxes.append(
            {"id": unique_name(f"{node.id}.{axis}", taken), "frame": parent.id, "collide": False}
            | stick
        )
    return boxes


def _device(node: innermodel.Node, parent: innermodel.Node) -> Data:
    """A device; its settings are the node's attributes without absent and infinite values."""
    settings = {
        field.name: value
        for field in fields(node)
        if field.name not in _NOT_SETTINGS
        and not isinstance(value := getattr(node, field.name), tuple | None)
        and not (isinstance(value, float) and math.isinf(value))
    }
    frame = node.id if innermodel.is_frame(node) else parent.id
    return {"id": node.id, "kind": node.tag, "frame": frame, "settings": settings}
