"""The tags of InnerModel: which attributes each has, what values these take, what may stand inside.

The one table that reading, did-you-mean and completion share. Defaults are those of the model.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field
from typing import TypeAlias

from robocomp_dsl.model import body

NUMBER = "a number"
LIMIT = "a number or `inf`"
WHOLE = "a whole number"
TEXT = "a text"
FLAG = "0 or 1"
EXTENT = "one to three numbers with commas between them"
SCALE = "one to three numbers with commas between them, such as a scale has"

Kind: TypeAlias = str | tuple[str, ...]
"""One of the above, or the words to choose from."""


@dataclass(frozen=True, slots=True)
class Tag:
    """`made` is the class of the model; `holds` whether other nodes may stand inside."""

    made: type[body.Node]
    attributes: Mapping[str, Kind]
    holds: bool = False
    fixed: Mapping[str, object] = field(default_factory=dict)


def _numbers(*names: str) -> dict[str, Kind]:
    return dict.fromkeys(names, NUMBER)


def _limits(*names: str) -> dict[str, Kind]:
    return dict.fromkeys(names, LIMIT)


AXIS: Kind = ("x", "y", "z")
_ID: dict[str, Kind] = {"id": TEXT}
_MOVED = _numbers("tx", "ty", "tz")
_TURNED = _numbers("rx", "ry", "rz")
_PHYSICS: dict[str, Kind] = {"engine": ("static", "bullet"), "mass": NUMBER}
_PORT: dict[str, Kind] = {"port": WHOLE}
_JOINT: dict[str, Kind] = {**_limits("min", "max"), "home": NUMBER, "axis": AXIS, **_PORT}
_BASE = _ID | _MOVED | _TURNED | _PORT | {"noise": NUMBER, "collide": FLAG}
_PLANE = (
    _ID
    | {"texture": TEXT, "repeat": WHOLE, "size": EXTENT, "collide": FLAG}
    | _numbers("nx", "ny", "nz", "px", "py", "pz")
)
_CAMERA = _ID | {"width": WHOLE, "height": WHOLE, "focal": NUMBER}

INCLUDE = "include"
ROOT = "innermodel"

TAGS: Mapping[str, Tag] = {
    "transform": Tag(body.Transform, _ID | _MOVED | _TURNED | _PHYSICS, holds=True),
    "translation": Tag(body.Transform, _ID | _MOVED | _PHYSICS, holds=True),
    "rotation": Tag(body.Transform, _ID | _TURNED | _PHYSICS, holds=True),
    "joint": Tag(
        body.Joint,
        _ID | _MOVED | _TURNED | _JOINT | _numbers("lx", "ly", "lz", "hx", "hy", "hz"),
        holds=True,
    ),
    "prismaticjoint": Tag(
        body.PrismaticJoint, _ID | _JOINT | _numbers("position", "offset"), holds=True
    ),
    "motor": Tag(body.Motor, _ID | _limits("force", "velocity") | _numbers("gear")),
    "differentialrobot": Tag(body.Base, _BASE, holds=True),
    "omnirobot": Tag(body.Base, _BASE, holds=True),
    "touchsensor": Tag(
        body.TouchSensor,
        _ID | {"type": TEXT} | _numbers("nx", "ny", "nz") | _limits("min", "max") | _PORT,
        holds=True,
    ),
    "plane": Tag(body.Plane, _PLANE),
    "display": Tag(body.Plane, _PLANE | _PORT),
    "mesh": Tag(
        body.Mesh,
        _ID
        | {"file": TEXT, "scale": SCALE, "render": ("normal", "wireframe"), "collide": FLAG}
        | _MOVED
        | _TURNED,
    ),
    "camera": Tag(body.Camera, _CAMERA),
    "rgbd": Tag(body.Camera, _CAMERA | {"noise": NUMBER, "ifconfig": TEXT} | _PORT),
    "laser": Tag(
        body.Laser,
        _ID
        | {"min": WHOLE, "max": WHOLE, "angle": NUMBER, "measures": WHOLE, "ifconfig": TEXT}
        | _PORT,
    ),
    "imu": Tag(body.Imu, _ID | _PORT),
    "pointcloud": Tag(body.PointCloud, _ID),
    "axes": Tag(
        body.Axes,
        _ID
        | _numbers(
            "length", "width", "lengthx", "widthx", "lengthy", "widthy", "lengthz", "widthz"
        ),
    ),
}
