"""The skin and field sections of a robot's description.

In: YAML entries and the limbs they refer to. Out: patches with every taxel placed, and fields.
"""

from __future__ import annotations

from pathlib import Path

import numpy as np

from robocomp_dsl.tactile.description.located import (
    ANGLE,
    LENGTH,
    NUMBER,
    Entry,
    Table,
    meant_in_degrees,
)
from robocomp_dsl.tactile.description.model import Limb, Patch, Servo
from robocomp_dsl.tactile.errors import DescriptionError, Fault
from robocomp_dsl.tactile.reflex.law import Field
from robocomp_dsl.tactile.skin.cone import cartesian
from robocomp_dsl.tactile.skin.layout import Layout, rings, singles
from robocomp_dsl.tactile.skin.normalise import Sensitivity
from robocomp_dsl.tactile.skin.positions import read_positions

_FORMS = ("rings", "points", "file")
MOST_MODULES = 1000
"""More in one patch is a slip of the keyboard."""
MOST_IDS = 2**31
"""An id is an `int` of Skin.idsl."""


def read_patches(entry: Entry | None, limbs: dict[str, Limb]) -> tuple[Patch, ...]:
    """The patches of a `skin` section."""
    made = [_patch(one, limbs) for one in entry.items()] if entry else []
    return tuple(patch for patch in made if patch)


def _patch(entry: Entry, limbs: dict[str, Limb]) -> Patch | None:
    table = entry.table()
    name, limb, first = table.text("patch"), _limb(table, limbs), table.get("first_id")
    forms = {form: table.get(form) for form in _FORMS}
    sensitivity = _sensitivity(table)
    table.finish()
    given = [(form, found) for form, found in forms.items() if found]
    if len(given) != 1:
        entry.complain("a patch is laid out by exactly one of " + ", ".join(_FORMS))
    if limb is None or len(given) != 1:
        return None
    layout = _layout(*given[0], limb)
    if layout is None:
        return None
    start = first.integer() if first else 0
    if not 0 <= start < MOST_IDS - layout.offset.max(initial=0):
        entry.complain(f"taxels cannot have ids from {start}", f"ids are 0 to {MOST_IDS - 1}")
        return None
    ids = tuple(int(i) for i in layout.offset + start)
    return Patch(name, limb.name, ids, layout.points, layout.normals, sensitivity, entry.place)


def _layout(form: str, entry: Entry, limb: Limb) -> Layout | None:
    if form == "points":
        places = np.array([one.numbers((LENGTH, ANGLE)) for one in entry.items()]).reshape(-1, 2)
        return singles(limb.cone, places) if len(places) else None
    if form == "file":
        return _from_file(entry, limb)
    table = entry.table()
    listed, count = table.need("x"), table.need("count")
    table.finish()
    x = tuple(one.number(LENGTH) for one in listed.items()) if listed else ()
    around = count.integer() if count else 0
    if not x or around < 1:
        entry.complain("rings need at least one x and one module")
        return None
    if len(x) * around > MOST_MODULES:
        said = f"a patch has at most {MOST_MODULES} modules, not {len(x) * around}"
        entry.complain(said, "`count` is the number of modules in one ring")
        return None
    return rings(limb.cone, x, around)


def _from_file(entry: Entry, limb: Limb) -> Layout | None:
    """Positions measured in the frame of the limb's body; rows without a taxel are left out."""
    file = entry.reading.file.parent / entry.text()
    try:
        read = read_positions(file.read_text(encoding="utf-8"), Path(file))
    except DescriptionError as error:
        entry.reading.findings.extend(error.findings)
        return None
    except (OSError, UnicodeDecodeError) as error:
        why = getattr(error, "strerror", None) or error
        entry.complain(f"the taxel positions `{entry.text()}` cannot be read: {why}")
        return None
    used = np.flatnonzero(read.used)
    points = limb.to_limb(read.positions[used])
    return Layout(used, points, read.normals[used] @ limb.axes)


def _sensitivity(table: Table) -> Sensitivity:
    found = table.get("sensitivity")
    if found is None:
        return Sensitivity()
    inner = found.table()
    gain, floor = inner.number("gain", NUMBER, 1.0), inner.number("floor", NUMBER, 0.0)
    saturation = inner.number("saturation", NUMBER, float("inf"))
    inner.finish()
    try:
        return Sensitivity(gain, floor, saturation)
    except ValueError as error:
        found.complain(str(error))
        return Sensitivity()


def read_fields(
    entry: Entry | None,
    limbs: dict[str, Limb],
    patches: tuple[Patch, ...],
    servos: tuple[Servo, ...],
) -> tuple[Field, ...]:
    """The receptive fields of a part with these servos, on limbs with these patches."""
    made: dict[str, Field] = {}
    for one in entry.items() if entry else []:
        field = _field(one, limbs, len(servos))
        if field and field.name in made:
            said = f"there are two fields of the name `{field.name}`"
            one.complain(said, fault=Fault.TWICE)
        elif field:
            made[field.name] = field
            _reached(field, patches, one)
            _possible(field, servos, one)
    return tuple(made.values())


def _field(entry: Entry, limbs: dict[str, Limb], size: int) -> Field | None:
    table = entry.table()
    name, limb, rho = table.text("name"), _limb(table, limbs), table.get("rho")
    x, radius = (table.number(key, LENGTH) for key in ("x", "radius"))
    theta = table.number("theta", ANGLE)
    if abs(theta) > 2 * np.pi:
        said = f"theta {theta:g} rad of the field `{name}` is more than a whole turn"
        entry.complain(said, meant_in_degrees(theta, 2 * np.pi).removeprefix("; "))
    motion = table.numbers("motion", (ANGLE,) * size)
    table.finish()
    if radius <= 0.0:
        entry.complain("the radius of a field must be positive")
        return None
    if limb is None:
        return None
    out = rho.number(LENGTH) if rho else float(limb.cone.radius(x))
    return Field(name, limb.name, cartesian(x, theta, out), radius, np.array(motion))


def _reached(field: Field, patches: tuple[Patch, ...], entry: Entry) -> None:
    """Where the limb has skin, some of it must be in the field."""
    points = [patch.points for patch in patches if patch.limb == field.limb]
    if not points:
        return
    away = float(np.linalg.norm(np.concatenate(points) - field.centre, axis=1).min(initial=np.inf))
    if away >= field.radius:
        said = f"no taxel of `{field.limb}` is in the field `{field.name}`"
        nearest = f"the nearest is {1000 * away:.0f} mm from its centre"
        entry.complain(said, nearest, Fault.OFF_BODY)


def _possible(field: Field, servos: tuple[Servo, ...], entry: Entry) -> None:
    """No joint can be told to turn by more than all that it can."""
    for way, servo in zip(field.motion, servos, strict=True):
        whole = abs(servo.gamma) * (servo.high - servo.low)
        if servo.joint and abs(way) > whole:
            said = f"`{field.name}` moves `{servo.joint}` by {way:g}, more than it can turn at all"
            way_out = f"from limit to limit it is {whole:.3g}" + meant_in_degrees(way, whole)
            entry.complain(said, way_out, Fault.LIMITS)


def _limb(table: Table, limbs: dict[str, Limb]) -> Limb | None:
    found = table.need("limb")
    name = found.text() if found else ""
    if found and name and name not in limbs:
        found.complain(f"there is no limb `{name}`", "limbs: " + (", ".join(limbs) or "none"))
    return limbs.get(name)
