"""The tags of InnerModel: their attributes, the values of these, and the allowed children.

The table is used for checking, suggestions and completion. Defaults are in the model classes.
"""

from __future__ import annotations

from collections.abc import Mapping
from typing import TypeAlias

from robocomp_dsl.model import innermodel
from robocomp_dsl.record import ValueRecord

NUMBER = "a number"
LENGTH = "a length: a number of mm, or with its unit (`0.5 m`)"
ANGLE = "an angle: a number of rad, or with its unit (`90 deg`)"
MASS = "a mass: a number of kg, or with its unit (`300 g`)"
LIMIT = "a number or `inf`"
ANGLE_LIMIT = "an angle (rad, or `90 deg`) or `inf`"
LENGTH_LIMIT = "a length (mm, or `0.5 m`) or `inf`"
WHOLE = "an integer"
TEXT = "a string"
FLAG = "0 or 1"
EXTENT = "one to three numbers separated by commas"
LENGTHS = "lengths separated by commas"
SCALE = "one to three scale factors separated by commas"

Kind: TypeAlias = str | tuple[str, ...]
"""One of the constants above, or the accepted words."""


_METRIC = {"mm": 1.0, "cm": 10.0, "m": 1000.0}
_ANGULAR = {"rad": 1.0, "deg": 0.017453292519943295}
UNITS: Mapping[Kind, Mapping[str, float]] = {
    LENGTH: _METRIC,
    LENGTH_LIMIT: _METRIC,
    LENGTHS: _METRIC,
    ANGLE: _ANGULAR,
    ANGLE_LIMIT: _ANGULAR,
    MASS: {"kg": 1.0, "g": 0.001},
}
"""The units that may follow a number of a kind, and their factors to the unit of the model."""


class InnerModelTag(ValueRecord):
    """`node_class` is the class of the model.

    `holds`: the allowed child tags (True: all without a special parent); `inside`: the allowed
    parent tags, empty for every frame.
    """

    node_class: type[innermodel.Node]
    attributes: Mapping[str, Kind]
    holds: bool | tuple[str, ...] = False
    inside: tuple[str, ...] = ()


def _each(kind: Kind, *names: str) -> dict[str, Kind]:
    return dict.fromkeys(names, kind)


AXIS: Kind = ("x", "y", "z")
_ID: dict[str, Kind] = {"id": TEXT}
_MOVED = _each(LENGTH, "tx", "ty", "tz")
_TURNED = _each(ANGLE, "rx", "ry", "rz")
_PHYSICS: dict[str, Kind] = {"engine": ("static", "bullet"), "mass": MASS}
_PORT: dict[str, Kind] = {"port": WHOLE}
_JOINT = _each(ANGLE_LIMIT, "min", "max") | {"home": ANGLE, "axis": AXIS} | _PORT
_SLIDE = _each(LENGTH_LIMIT, "min", "max") | {"axis": AXIS} | _PORT
_BASE = _ID | _MOVED | _TURNED | _PORT | {"noise": NUMBER, "collide": FLAG}
_PLANE = (
    _ID
    | {"texture": TEXT, "repeat": WHOLE, "size": EXTENT, "collide": FLAG}
    | _each(NUMBER, "nx", "ny", "nz")
    | _each(LENGTH, "px", "py", "pz")
)
_CAMERA = _ID | {"width": WHOLE, "height": WHOLE, "focal": NUMBER}

INCLUDE = "include"
ROOT = "innermodel"

TAGS: Mapping[str, InnerModelTag] = {
    "transform": InnerModelTag(innermodel.Transform, _ID | _MOVED | _TURNED | _PHYSICS, holds=True),
    "translation": InnerModelTag(innermodel.Transform, _ID | _MOVED | _PHYSICS, holds=True),
    "rotation": InnerModelTag(innermodel.Transform, _ID | _TURNED | _PHYSICS, holds=True),
    "joint": InnerModelTag(
        innermodel.Joint,
        _ID | _MOVED | _TURNED | _JOINT | _each(LENGTH, "lx", "ly", "lz", "hx", "hy", "hz"),
        holds=True,
    ),
    "prismaticjoint": InnerModelTag(
        innermodel.PrismaticJoint,
        _ID | _SLIDE | _each(LENGTH, "position", "offset", "home"),
        holds=True,
    ),
    "motor": InnerModelTag(
        innermodel.Motor, _ID | _each(LIMIT, "force", "velocity") | _each(NUMBER, "gear")
    ),
    "differentialrobot": InnerModelTag(innermodel.Base, _BASE, holds=True),
    "omnirobot": InnerModelTag(innermodel.Base, _BASE, holds=True),
    "touchsensor": InnerModelTag(
        innermodel.TouchSensor,
        _ID | {"type": TEXT} | _each(NUMBER, "nx", "ny", "nz") | _each(LIMIT, "min", "max") | _PORT,
        holds=True,
    ),
    "skin": InnerModelTag(innermodel.Skin, _ID | {"rate": NUMBER} | _PORT, holds=("patch",)),
    "patch": InnerModelTag(
        innermodel.Patch,
        _ID
        | _MOVED
        | _TURNED
        | _each(LENGTH, "x0", "x1", "r0", "r1")
        | {"rings": LENGTHS, "count": WHOLE, "file": TEXT, "firstid": WHOLE}
        | {"gain": NUMBER, "floor": NUMBER, "saturation": LIMIT},
        holds=("taxel",),
        inside=("skin",),
    ),
    "taxel": InnerModelTag(
        innermodel.Taxel,
        _ID | _each(LENGTH, "x", "y", "z") | _each(NUMBER, "nx", "ny", "nz") | {"theta": ANGLE},
        inside=("patch",),
    ),
    "plane": InnerModelTag(innermodel.Plane, _PLANE),
    "display": InnerModelTag(innermodel.Plane, _PLANE | _PORT),
    "mesh": InnerModelTag(
        innermodel.Mesh,
        _ID
        | {"file": TEXT, "scale": SCALE, "render": ("normal", "wireframe"), "collide": FLAG}
        | _MOVED
        | _TURNED,
    ),
    "camera": InnerModelTag(innermodel.Camera, _CAMERA),
    "rgbd": InnerModelTag(innermodel.Camera, _CAMERA | {"noise": NUMBER, "ifconfig": TEXT} | _PORT),
    "laser": InnerModelTag(
        innermodel.Laser,
        _ID
        | {"min": WHOLE, "max": WHOLE, "angle": ANGLE, "measures": WHOLE, "ifconfig": TEXT}
        | {"noise": NUMBER}
        | _PORT,
    ),
    "imu": InnerModelTag(innermodel.Imu, _ID | _each(NUMBER, "noise", "gyronoise") | _PORT),
    "gps": InnerModelTag(
        innermodel.Gps,
        _ID | _each(NUMBER, "latitude", "longitude", "noise") | {"altitude": LENGTH} | _PORT,
    ),
    "ultrasound": InnerModelTag(
        innermodel.Ultrasound,
        _ID | {"min": WHOLE, "max": WHOLE, "angle": ANGLE, "noise": NUMBER} | _PORT,
    ),
    "battery": InnerModelTag(
        innermodel.Battery, _ID | _each(NUMBER, "capacity", "voltage", "idle") | _PORT
    ),
    "pointcloud": InnerModelTag(innermodel.PointCloud, _ID),
    "axes": InnerModelTag(
        innermodel.Axes,
        _ID
        | _each(LENGTH, "length", "width", "lengthx", "widthx", "lengthy", "widthy")
        | _each(LENGTH, "lengthz", "widthz"),
    ),
}
