"""The skin and field sections of a robot's description.

In: YAML values and the limbs they refer to. Out: patches with the positions of all taxels, and
fields.
"""

from __future__ import annotations

from pathlib import Path

import numpy as np

from robocomp_dsl.regular_file import read_text
from robocomp_dsl.tactile.description.model import Limb, Patch, Servo
from robocomp_dsl.tactile.description.yaml_reader import (
    ANGLE,
    LENGTH,
    NUMBER,
    YamlTable,
    YamlValue,
    degrees_hint,
)
from robocomp_dsl.tactile.errors import DescriptionError, Fault
from robocomp_dsl.tactile.reflex.law import Field
from robocomp_dsl.tactile.skin.cone import cartesian
from robocomp_dsl.tactile.skin.layout import TaxelLayout, place_rings, place_taxels
from robocomp_dsl.tactile.skin.normalise import Sensitivity
from robocomp_dsl.tactile.skin.positions import read_positions

_LAYOUT_KEYS = ("rings", "points", "file")
MAX_MODULES = 1000
"""More modules in one patch are taken for a typing error."""
MAX_IDS = 2**31
"""An id is an `int` of Skin.idsl."""


def read_patches(entry: YamlValue | None, limbs: dict[str, Limb]) -> tuple[Patch, ...]:
    """The patches of a `skin` section."""
    patches = [_patch(item, limbs) for item in entry.items()] if entry else []
    return tuple(patch for patch in patches if patch)


def _patch(entry: YamlValue, limbs: dict[str, Limb]) -> Patch | None:
    table = entry.table()
    name, limb, first = table.text("patch"), _limb(table, limbs), table.get("first_id")
    forms = {form: table.get(form) for form in _LAYOUT_KEYS}
    sensitivity = _sensitivity(table)
    table.finish()
    present = [(form, value) for form, value in forms.items() if value]
    if len(present) != 1:
        entry.report("a patch needs exactly one of " + ", ".join(_LAYOUT_KEYS))
    if limb is None or len(present) != 1:
        return None
    layout = _layout(*present[0], limb)
    if layout is None:
        return None
    start = first.integer() if first else 0
    if not 0 <= start < MAX_IDS - layout.offset.max(initial=0):
        entry.report(f"taxel ids cannot start at {start}", f"ids are 0 to {MAX_IDS - 1}")
        return None
    ids = tuple(int(i) for i in layout.offset + start)
    return Patch(name, limb.name, ids, layout.points, layout.normals, sensitivity, entry.place)


def _layout(form: str, entry: YamlValue, limb: Limb) -> TaxelLayout | None:
    if form == "points":
        places = np.array([item.numbers((LENGTH, ANGLE)) for item in entry.items()]).reshape(-1, 2)
        return place_taxels(limb.cone, places) if len(places) else None
    if form == "file":
        return _from_file(entry, limb)
    table = entry.table()
    listed, count = table.require("x"), table.require("count")
    table.finish()
    x = tuple(item.number(LENGTH) for item in listed.items()) if listed else ()
    modules = count.integer() if count else 0
    if not x or modules < 1:
        entry.report("rings need at least one x and one module")
        return None
    if len(x) * modules > MAX_MODULES:
        message = f"a patch has at most {MAX_MODULES} modules, not {len(x) * modules}"
        entry.report(message, "`count` is the number of modules in one ring")
        return None
    return place_rings(limb.cone, x, modules)


def _from_file(entry: YamlValue, limb: Limb) -> TaxelLayout | None:
    """Measured positions in the frame of the limb's body; rows without a taxel are skipped."""
    file = entry.reader.file.parent / entry.text()
    try:
        read = read_positions(read_text(file), Path(file))
    except DescriptionError as error:
        entry.reader.findings.extend(error.findings)
        return None
    except (OSError, UnicodeDecodeError) as error:
        why = getattr(error, "strerror", None) or error
        entry.report(f"the taxel positions `{entry.text()}` cannot be read: {why}")
        return None
    used = np.flatnonzero(read.used)
    points = limb.to_limb(read.positions[used])
    return TaxelLayout(used, points, read.normals[used] @ limb.axes)


def _sensitivity(table: YamlTable) -> Sensitivity:
    value = table.get("sensitivity")
    if value is None:
        return Sensitivity()
    inner = value.table()
    gain, floor = inner.number("gain", NUMBER, 1.0), inner.number("floor", NUMBER, 0.0)
    saturation = inner.number("saturation", NUMBER, float("inf"))
    inner.finish()
    try:
        return Sensitivity(gain, floor, saturation)
    except ValueError as error:
        value.report(str(error))
        return Sensitivity()


def read_fields(
    entry: YamlValue | None,
    limbs: dict[str, Limb],
    patches: tuple[Patch, ...],
    servos: tuple[Servo, ...],
) -> tuple[Field, ...]:
    """The receptive fields of a part."""
    fields: dict[str, Field] = {}
    for item in entry.items() if entry else []:
        field = _field(item, limbs, len(servos))
        if field and field.name in fields:
            message = f"there are two fields named `{field.name}`"
            item.report(message, fault=Fault.TWICE)
        elif field:
            fields[field.name] = field
            _check_taxels_in_field(field, patches, item)
            _check_motion(field, servos, item)
    return tuple(fields.values())


def _field(entry: YamlValue, limbs: dict[str, Limb], size: int) -> Field | None:
    table = entry.table()
    name, limb, rho = table.text("name"), _limb(table, limbs), table.get("rho")
    x, radius = (table.number(key, LENGTH) for key in ("x", "radius"))
    theta = table.number("theta", ANGLE)
    if abs(theta) > 2 * np.pi:
        message = f"theta {theta:g} rad of the field `{name}` is more than a full turn"
        entry.report(message, degrees_hint(theta, 2 * np.pi).removeprefix("; "))
    motion = table.numbers("motion", (ANGLE,) * size)
    table.finish()
    if radius <= 0.0:
        entry.report("the radius of a field must be positive")
        return None
    if limb is None:
        return None
    out = rho.number(LENGTH) if rho else float(limb.cone.radius(x))
    return Field(name, limb.name, cartesian(x, theta, out), radius, np.array(motion))


def _check_taxels_in_field(field: Field, patches: tuple[Patch, ...], entry: YamlValue) -> None:
    """If the limb has skin, the field must contain at least one taxel."""
    points = [patch.points for patch in patches if patch.limb == field.limb]
    if not points:
        return
    away = float(np.linalg.norm(np.concatenate(points) - field.centre, axis=1).min(initial=np.inf))
    if away >= field.radius:
        message = f"no taxel of `{field.limb}` is in the field `{field.name}`"
        nearest = f"the nearest is {1000 * away:.0f} mm from its centre"
        entry.report(message, nearest, Fault.OFF_BODY)


def _check_motion(field: Field, servos: tuple[Servo, ...], entry: YamlValue) -> None:
    """A field's motion must not exceed the range of a joint."""
    for turn, servo in zip(field.motion, servos, strict=True):
        whole = abs(servo.gamma) * (servo.high - servo.low)
        if servo.joint and abs(turn) > whole:
            message = f"`{field.name}` moves `{servo.joint}` by {turn:g}, more than its whole range"
            way_out = f"from limit to limit it is {whole:.3g}" + degrees_hint(turn, whole)
            entry.report(message, way_out, Fault.LIMITS)


def _limb(table: YamlTable, limbs: dict[str, Limb]) -> Limb | None:
    value = table.require("limb")
    name = value.text() if value else ""
    if value and name and name not in limbs:
        value.report(f"there is no limb `{name}`", "limbs: " + (", ".join(limbs) or "none"))
    return limbs.get(name)
