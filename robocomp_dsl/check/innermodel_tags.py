"""The tags of InnerModel: which attributes each has, what values these take, what may stand inside.

The one table that reading, did-you-mean and completion share. Defaults are those of the model.
"""

from __future__ import annotations

from collections.abc import Mapping
from typing import TypeAlias

from robocomp_dsl.model import body
from robocomp_dsl.record import Value

NUMBER = "a number"
LENGTH = "a length: a number of mm, or with its unit (`0.5 m`)"
ANGLE = "an angle: a number of rad, or with its unit (`90 deg`)"
MASS = "a mass: a number of kg, or with its unit (`300 g`)"
LIMIT = "a number or `inf`"
ANGLE_LIMIT = "an angle (rad, or `90 deg`) or `inf`"
LENGTH_LIMIT = "a length (mm, or `0.5 m`) or `inf`"
WHOLE = "a whole number"
TEXT = "a text"
FLAG = "0 or 1"
EXTENT = "one to three numbers with commas between them"
LENGTHS = "lengths with commas between them"
SCALE = "one to three numbers with commas between them, such as a scale has"

Kind: TypeAlias = str | tuple[str, ...]
"""One of the above, or the words to choose from."""


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
"""What may stand behind a number of a kind, and what it is worth in the unit of the model."""


class Tag(Value):
    """`made` is the class of the model.

    `holds`: which tags may stand inside (True: all that need no special place); `inside`: the tags
    that it stands in, empty for every frame.
    """

    made: type[body.Node]
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

TAGS: Mapping[str, Tag] = {
    "transform": Tag(body.Transform, _ID | _MOVED | _TURNED | _PHYSICS, holds=True),
    "translation": Tag(body.Transform, _ID | _MOVED | _PHYSICS, holds=True),
    "rotation": Tag(body.Transform, _ID | _TURNED | _PHYSICS, holds=True),
    "joint": Tag(
        body.Joint,
        _ID | _MOVED | _TURNED | _JOINT | _each(LENGTH, "lx", "ly", "lz", "hx", "hy", "hz"),
        holds=True,
    ),
    "prismaticjoint": Tag(
        body.PrismaticJoint, _ID | _SLIDE | _each(LENGTH, "position", "offset", "home"), holds=True
    ),
    "motor": Tag(body.Motor, _ID | _each(LIMIT, "force", "velocity") | _each(NUMBER, "gear")),
    "differentialrobot": Tag(body.Base, _BASE, holds=True),
    "omnirobot": Tag(body.Base, _BASE, holds=True),
    "touchsensor": Tag(
        body.TouchSensor,
        _ID | {"type": TEXT} | _each(NUMBER, "nx", "ny", "nz") | _each(LIMIT, "min", "max") | _PORT,
        holds=True,
    ),
    "skin": Tag(body.Skin, _ID | {"rate": NUMBER} | _PORT, holds=("patch",)),
    "patch": Tag(
        body.Patch,
        _ID
        | _MOVED
        | _TURNED
        | _each(LENGTH, "x0", "x1", "r0", "r1")
        | {"rings": LENGTHS, "count": WHOLE, "file": TEXT, "firstid": WHOLE}
        | {"gain": NUMBER, "floor": NUMBER, "saturation": LIMIT},
        holds=("taxel",),
        inside=("skin",),
    ),
    "taxel": Tag(
        body.Taxel,
        _ID | _each(LENGTH, "x", "y", "z") | _each(NUMBER, "nx", "ny", "nz") | {"theta": ANGLE},
        inside=("patch",),
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
        | {"min": WHOLE, "max": WHOLE, "angle": ANGLE, "measures": WHOLE, "ifconfig": TEXT}
        | {"noise": NUMBER}
        | _PORT,
    ),
    "imu": Tag(body.Imu, _ID | _each(NUMBER, "noise", "gyronoise") | _PORT),
    "gps": Tag(
        body.Gps,
        _ID | _each(NUMBER, "latitude", "longitude", "noise") | {"altitude": LENGTH} | _PORT,
    ),
    "ultrasound": Tag(
        body.Ultrasound,
        _ID | {"min": WHOLE, "max": WHOLE, "angle": ANGLE, "noise": NUMBER} | _PORT,
    ),
    "battery": Tag(body.Battery, _ID | _each(NUMBER, "capacity", "voltage", "idle") | _PORT),
    "pointcloud": Tag(body.PointCloud, _ID),
    "axes": Tag(
        body.Axes,
        _ID
        | _each(LENGTH, "length", "width", "lengthx", "widthx", "lengthy", "widthy")
        | _each(LENGTH, "lengthz", "widthz"),
    ),
}
