"""Reference of the tags and attributes of InnerModel, for hover and completion.

In: names. Out: Markdown. The table of the checks defines the tags, attributes, kinds and units; the
model defines the defaults and the documentation of tags. This module documents the attributes.
"""

from __future__ import annotations

import math
from collections.abc import Mapping
from dataclasses import MISSING, fields
from inspect import getdoc

from robocomp_dsl.check.innermodel.tags import FLAG, INCLUDE, ROOT, TAGS, TEXT, Kind

ATTRIBUTE_MEANINGS: Mapping[str, str] = {
    "id": "the name of the node, unique in the world with all included files",
    "length": "length of the sticks",
    "path": "the file whose nodes are inserted here, relative to this file",
    "tx": "translation along x, to the right",
    "ty": "translation along y, upwards",
    "tz": "translation along z, ahead",
    "rx": "rotation about x",
    "ry": "rotation about y",
    "rz": "rotation about z",
    "engine": "whether physics moves the node (`bullet`) or not (`static`)",
    "mass": "mass of the node",
    "port": "port number of its server; from older files",
    "min": "lower end of the range",
    "max": "upper end of the range",
    "home": "where a joint starts, and where the command to go to zero sends it; default: its "
    "angle about `axis`, or its `position`",
    "axis": "the axis of its own frame about or along which it moves",
    "position": "the initial position of the slide; default: `home`",
    "offset": "added to the position of the slide",
    "noise": "standard deviation of its measurements or of its motion",
    "collide": "whether it collides with obstacles",
    "force": "maximum torque of the motor in N·m (maximum force in N for a slide)",
    "velocity": "maximum speed of the motor in rad/s (in mm/s for a slide)",
    "gear": "gear ratio: turns of the motor per turn of the joint",
    "type": "the measured quantity; free text",
    "nx": "x of the normal",
    "ny": "y of the normal",
    "nz": "z of the normal",
    "px": "x of the centre",
    "py": "y of the centre",
    "pz": "z of the centre",
    "texture": "an image file, or a colour `#rrggbb`",
    "repeat": "length after which the texture repeats, in mm",
    "size": "width, height and thickness in mm, the last along the normal",
    "file": "the file with its data, relative to this file",
    "scale": "scale factors along its own axes",
    "render": "the rendering mode",
    "width": "width of the image in pixels",
    "height": "height of the image in pixels",
    "focal": "focal length in pixels",
    "gyronoise": "standard deviation of each angular velocity, in rad/s",
    "ifconfig": "configuration of the interface; from older files",
    "angle": "width of the scan",
    "measures": "number of beams",
    "latitude": "latitude of the world's origin, in degrees north",
    "longitude": "longitude of the world's origin, in degrees east",
    "altitude": "height of the world's origin above the ellipsoid",
    "capacity": "capacity of the battery, in Wh",
    "voltage": "in V",
    "idle": "idle power, in W",
    "rate": "sampling rate, in Hz",
    "x0": "start of the cone on the x axis",
    "x1": "end of the cone on the x axis",
    "r0": "radius of the cone at `x0`",
    "r1": "radius of the cone at `x1`",
    "rings": "positions on the x axis of the rings of triangle modules",
    "count": "number of modules per ring",
    "firstid": "number of the first taxel",
    "gain": "sensor output per newton",
    "floor": "the smallest force that a sensor detects, in N",
    "saturation": "the maximum sensor output",
    "x": "x of the point, or position along the cone",
    "y": "y of the point",
    "z": "z of the point",
    "theta": "angle around the cone, from +z towards +y",
}
MEANINGS_BY_TAG: Mapping[tuple[str, str], str] = {
    ("axes", "width"): "thickness of the sticks",
    ("imu", "noise"): "standard deviation of each acceleration, in m/s²",
    ("laser", "noise"): "standard deviation of a distance, in mm",
    ("laser", "min"): "minimum range, in mm",
    ("laser", "max"): "maximum range, in mm",
}
"""Meanings of attributes that differ for one tag."""
_UNUSED = "from older files; unused"


def attributes_of(tag: str) -> Mapping[str, Kind]:
    """The attributes of `tag` with their kinds; none for an unknown tag."""
    if tag.lower() == INCLUDE:
        return {"path": TEXT}
    known = TAGS.get(tag.lower())
    return known.attributes if known else {}


def allowed_tags(tag: str) -> tuple[str, ...]:
    """The tags that may be nested in `tag`; the root allows those of a frame."""
    known = TAGS.get(tag.lower())
    holds = True if tag.lower() == ROOT else known.holds if known else False
    if isinstance(holds, tuple):
        return holds
    return (*(name for name, spec in TAGS.items() if not spec.inside), INCLUDE) if holds else ()


def describe_tag(tag: str) -> str:
    """The documentation of a tag; empty for an unknown tag."""
    name = tag.lower()
    if name == ROOT:
        return "The world: the root of all nodes."
    if name == INCLUDE:
        return "Includes the nodes of another file."
    known = TAGS.get(name)
    return (getdoc(known.node_class) or "") if known else ""


def describe_attribute(tag: str, name: str) -> str:
    """Meaning, kind with unit, and default of an attribute; empty for an unknown attribute."""
    kind = attributes_of(tag).get(name)
    if kind is None:
        return ""
    meaning = MEANINGS_BY_TAG.get((tag.lower(), name)) or ATTRIBUTE_MEANINGS.get(name, _UNUSED)
    default = default_of(tag, name)
    parts = [f"**{name}**: {meaning}", f"Takes {describe_kind(kind)}."]
    if default is not None:
        parts.append(f"Default: `{default}`")
    return "\n\n".join(parts)


def describe_kind(kind: Kind) -> str:
    """The values that a kind accepts."""
    if isinstance(kind, tuple):
        return "one of " + ", ".join(f"`{word}`" for word in kind)
    return kind


def default_of(tag: str, name: str) -> str | None:
    """The default of an attribute as it would be written in a file; None if it has none."""
    known = TAGS.get(tag.lower())
    for field in fields(known.node_class) if known else ():
        if field.name == name and field.default is not MISSING and field.default is not None:
            return format_value(field.default, attributes_of(tag)[name])
    return None


def format_value(value: object, kind: Kind) -> str:
    """A value of the model as the value of an attribute."""
    if isinstance(value, tuple):
        return ", ".join(format_value(part, kind) for part in value)
    if kind == FLAG:
        return str(int(bool(value)))
    if isinstance(value, float):
        sign = "-" if value < 0 else ""
        return f"{sign}inf" if math.isinf(value) else f"{value:g}"
    return str(value)
