"""The skin and field sections of a robot's description.

In: YAML entries and the limbs they refer to. Out: patches with every taxel placed, and fields.
"""

from __future__ import annotations

from pathlib import Path

import numpy as np

from robocomp_dsl.tactile.description.located import Entry, Table
from robocomp_dsl.tactile.description.model import Limb, Patch
from robocomp_dsl.tactile.errors import DescriptionError
from robocomp_dsl.tactile.reflex.law import Field
from robocomp_dsl.tactile.skin.cone import cartesian
from robocomp_dsl.tactile.skin.layout import Layout, rings, singles
from robocomp_dsl.tactile.skin.normalise import Sensitivity
from robocomp_dsl.tactile.skin.positions import read_positions

_FORMS = ("rings", "points", "file")


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
    ids = tuple(int(i) for i in layout.offset + (first.integer() if first else 0))
    return Patch(name, limb.name, ids, layout.points, layout.normals, sensitivity, entry.place)


def _layout(form: str, entry: Entry, limb: Limb) -> Layout | None:
    if form == "points":
        places = np.array([one.numbers(2) for one in entry.items()]).reshape(-1, 2)
        return singles(limb.cone, places) if len(places) else None
    if form == "file":
        return _from_file(entry, limb)
    table = entry.table()
    listed, count = table.need("x"), table.need("count")
    table.finish()
    x = tuple(one.number() for one in listed.items()) if listed else ()
    around = count.integer() if count else 0
    if not x or around < 1:
        entry.complain("rings need at least one x and one module")
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
        entry.complain(f"the taxel positions cannot be read: {why}")
        return None
    used = np.flatnonzero(read.used)
    points = limb.to_limb(read.positions[used])
    return Layout(used, points, read.normals[used] @ limb.axes)


def _sensitivity(table: Table) -> Sensitivity:
    found = table.get("sensitivity")
    if found is None:
        return Sensitivity()
    inner = found.table()
    gain, floor = inner.number("gain", 1.0), inner.number("floor", 0.0)
    saturation = inner.number("saturation", float("inf"))
    inner.finish()
    try:
        return Sensitivity(gain, floor, saturation)
    except ValueError as error:
        found.complain(str(error))
        return Sensitivity()


def read_fields(entry: Entry | None, limbs: dict[str, Limb], size: int) -> tuple[Field, ...]:
    """The receptive fields of a part with `size` servos."""
    made = [_field(one, limbs, size) for one in entry.items()] if entry else []
    return tuple(one for one in made if one)


def _field(entry: Entry, limbs: dict[str, Limb], size: int) -> Field | None:
    table = entry.table()
    name, limb = table.text("name"), _limb(table, limbs)
    x, theta, radius = table.number("x"), table.number("theta"), table.number("radius")
    rho, motion = table.get("rho"), table.numbers("motion", size)
    table.finish()
    if radius <= 0.0:
        entry.complain("the radius of a field must be positive")
        return None
    if limb is None:
        return None
    out = rho.number() if rho else float(limb.cone.radius(x))
    return Field(name, limb.name, cartesian(x, theta, out), radius, np.array(motion))


def _limb(table: Table, limbs: dict[str, Limb]) -> Limb | None:
    found = table.need("limb")
    name = found.text() if found else ""
    if found and name and name not in limbs:
        found.complain(f"there is no limb `{name}`", "limbs: " + (", ".join(limbs) or "none"))
    return limbs.get(name)
