"""What the tags and attributes of InnerModel mean, in a few lines for hover and completion.

In: names. Out: Markdown. Which tags and attributes there are, their kinds and units come from the
table of the checks, defaults and the words about a tag from the model; only what an attribute is
good for is said here.
"""

from __future__ import annotations

import math
from collections.abc import Mapping
from dataclasses import MISSING, fields
from inspect import getdoc

from robocomp_dsl.check.innermodel_tags import FLAG, INCLUDE, ROOT, TAGS, TEXT, Kind

MEANINGS: Mapping[str, str] = {
    "id": "the name of the node, unique in the body with all that it includes",
    "length": "length of the sticks",
    "path": "the file whose nodes stand here, beside this file",
    "tx": "shift along x, to the right",
    "ty": "shift along y, upwards",
    "tz": "shift along z, ahead",
    "rx": "turn about x",
    "ry": "turn about y",
    "rz": "turn about z",
    "engine": "whether physics moves the node (`bullet`) or not (`static`)",
    "mass": "what the node weighs",
    "port": "number of the port that serves it; kept from older files",
    "min": "lower end of the range",
    "max": "upper end of the range",
    "home": "where it goes when it is told to go to zero",
    "axis": "the axis of its own frame that it moves about or along",
    "position": "where the slide is at first",
    "offset": "added to the position of the slide",
    "noise": "standard deviation of what it measures or of how it moves",
    "collide": "whether obstacles stop it",
    "force": "the most that the motor exerts, in N·m (in N where it drives a slide)",
    "velocity": "the fastest that the motor turns, in rad/s (in mm/s where it drives a slide)",
    "gear": "how many times the motor turns while the joint turns once",
    "type": "what the sensor measures; free text",
    "nx": "x of the normal",
    "ny": "y of the normal",
    "nz": "z of the normal",
    "px": "x of the centre",
    "py": "y of the centre",
    "pz": "z of the centre",
    "texture": "an image file, or a colour `#rrggbb`",
    "repeat": "length after which the texture begins again, in mm",
    "size": "width, height and thickness in mm, the last along the normal",
    "file": "the file that it is read from, beside this file",
    "scale": "factors along its own axes",
    "render": "how it is drawn",
    "width": "width of the image in pixels",
    "height": "height of the image in pixels",
    "focal": "focal length in pixels",
    "gyronoise": "standard deviation of each rate of turning, in rad/s",
    "ifconfig": "configuration of the interface; kept from older files",
    "angle": "width of the scan",
    "measures": "number of beams",
    "latitude": "degrees to the north at the origin of the world",
    "longitude": "degrees to the east at the origin of the world",
    "altitude": "height of the origin of the world above the ellipsoid",
    "capacity": "what the full battery holds, in Wh",
    "voltage": "in V",
    "idle": "what is drawn while nothing moves, in W",
    "rate": "how often it is read, in Hz",
    "x0": "where on x the cone begins",
    "x1": "where on x the cone ends",
    "r0": "radius of the cone at `x0`",
    "r1": "radius of the cone at `x1`",
    "rings": "where on x there are rings of triangle modules",
    "count": "how many modules each ring has",
    "firstid": "number of the first taxel",
    "gain": "what a sensor gives per newton",
    "floor": "the force in N from which on a sensor gives anything",
    "saturation": "the most that a sensor gives",
    "x": "x of the point, or place along the cone",
    "y": "y of the point",
    "z": "z of the point",
    "theta": "angle around the cone, from +z towards +y",
}
OF_TAG: Mapping[tuple[str, str], str] = {
    ("axes", "width"): "thickness of the sticks",
    ("imu", "noise"): "standard deviation of each acceleration, in m/s²",
    ("laser", "noise"): "standard deviation of a distance, in mm",
    ("laser", "min"): "the nearest that it sees, in mm",
    ("laser", "max"): "the farthest that it sees, in mm",
}
"""Where one name means another thing in one tag."""
_UNUSED = "kept from older files, nothing uses it"


def attributes_of(tag: str) -> Mapping[str, Kind]:
    """The attributes that `tag` has, with their kinds; none for an unknown tag."""
    if tag.lower() == INCLUDE:
        return {"path": TEXT}
    known = TAGS.get(tag.lower())
    return known.attributes if known else {}


def tags_in(tag: str) -> tuple[str, ...]:
    """The tags that may stand in `tag`; of the root those of a frame."""
    known = TAGS.get(tag.lower())
    holds = True if tag.lower() == ROOT else known.holds if known else False
    if isinstance(holds, tuple):
        return holds
    return (*(name for name, one in TAGS.items() if not one.inside), INCLUDE) if holds else ()


def about_tag(tag: str) -> str:
    """What a tag is, or nothing for an unknown one."""
    name = tag.lower()
    if name == ROOT:
        return "The body: all nodes stand in it."
    if name == INCLUDE:
        return "The nodes of another file."
    known = TAGS.get(name)
    return (getdoc(known.made) or "") if known else ""


def about_attribute(tag: str, name: str) -> str:
    """Meaning, kind with its unit, and default of an attribute, or nothing for an unknown one."""
    kind = attributes_of(tag).get(name)
    if kind is None:
        return ""
    meaning = OF_TAG.get((tag.lower(), name)) or MEANINGS.get(name, _UNUSED)
    default = default_of(tag, name)
    said = [f"**{name}**: {meaning}", f"Takes {kind_words(kind)}."]
    if default is not None:
        said.append(f"Default: `{default}`")
    return "\n\n".join(said)


def kind_words(kind: Kind) -> str:
    """What values a kind stands for."""
    if isinstance(kind, tuple):
        return "one of " + ", ".join(f"`{word}`" for word in kind)
    return kind


def default_of(tag: str, name: str) -> str | None:
    """The value that an attribute has when it is left out, as it would be written."""
    known = TAGS.get(tag.lower())
    for field in fields(known.made) if known else ():
        if field.name == name and field.default is not MISSING and field.default is not None:
            return written(field.default, attributes_of(tag)[name])
    return None


def written(value: object, kind: Kind) -> str:
    """A value of the model as an attribute has it."""
    if isinstance(value, tuple):
        return ", ".join(written(one, kind) for one in value)
    if kind == FLAG:
        return str(int(bool(value)))
    if isinstance(value, float):
        sign = "-" if value < 0 else ""
        return f"{sign}inf" if math.isinf(value) else f"{value:g}"
    return str(value)
