"""Read a robot's description from YAML.

In: the text of a file. Out: `Robot`, checked; or `DescriptionError` with every finding. The form:

    robot: name
    model: body.xml          (InnerModel, MJCF or URDF; may be left out)
    parts:
      left_arm:
        servos: [{joint, part, gamma, sigma, limits, speed, stiffness, damping, start, unit}, ...]
        chain: {base: {position, rpy}, tool: {...}, rows: [{servo | fixed, a, d, alpha, offset}]}
        limbs: {upper_arm: {body, covers, position, rpy, cone: {x: [x0, x1], r: [r0, r1]}}}
        skin: [{patch, limb, first_id, rings | points | file, sensitivity}]
        fields: [{name, limb, x, theta, rho, radius, motion}]
        held: [{joint, part, at, unit}]
"""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path

import numpy as np

from robocomp_dsl.tactile.arm.chain import Chain, Row
from robocomp_dsl.tactile.arrays import Floats
from robocomp_dsl.tactile.description.check import check
from robocomp_dsl.tactile.description.located import (
    ANGLE,
    LENGTH,
    NUMBER,
    UNITS,
    UNITS_OF,
    Entry,
    Reading,
    Table,
)
from robocomp_dsl.tactile.description.model import Held, Limb, Part, Robot, Servo
from robocomp_dsl.tactile.description.skin import read_fields, read_patches
from robocomp_dsl.tactile.skin.cone import Cone

_NO_TURN = (0.0, 0.0, 0.0)


def read_robot(text: str, file: Path) -> Robot:
    """The robot that `text` describes. Raises `DescriptionError` with every finding."""
    reading = Reading(file)
    top = reading.root(text).table()
    name, parts, body = top.text("robot"), top.need("parts"), top.get("model")
    top.finish()
    rows = parts.table().rows if parts else {}
    found = tuple(_part(key, entry) for key, entry in rows.items())
    robot = Robot(name, found, file)
    if body:
        robot = replace(robot, model=body.text(), model_place=body.place)
    reading.finish()
    check(robot, reading)
    reading.finish()
    return robot


def load_robot(file: Path) -> Robot:
    """The robot that the file describes; see `read_robot`."""
    return read_robot(file.read_text(encoding="utf-8"), file)


def _part(name: str, entry: Entry) -> Part:
    table = entry.table()
    listed, limb_table = table.need("servos"), table.get("limbs")
    servos = tuple(_servo(one) for one in listed.items()) if listed else ()
    chain = table.get("chain")
    rows = limb_table.table().rows if limb_table else {}
    limbs = {key: _limb(key, one) for key, one in rows.items()}
    patches = read_patches(table.get("skin"), limbs)
    fields = read_fields(table.get("fields"), limbs, patches, servos)
    kept = table.get("held")
    held = tuple(_held(one) for one in kept.items()) if kept else ()
    table.finish()
    made = _chain(chain, len(servos)) if chain else None
    return Part(name, servos, made, tuple(limbs.values()), patches, fields, held, entry.place)


def _servo(entry: Entry) -> Servo:
    table = entry.table()
    joint, unit = table.text("joint", ""), _unit(table, entry)
    what = ANGLE if unit in UNITS_OF[ANGLE] else LENGTH
    endless = () if joint else (-np.inf, np.inf)
    low, high = table.numbers("limits", (what, what), endless, counted=unit)
    gamma = _gamma(table, entry, joint)
    servo = Servo(
        joint=joint,
        part=table.text("part", ""),
        gamma=gamma,
        sigma=table.number("sigma", what),
        low=min(low, high),
        high=max(low, high),
        speed=table.number("speed", what, None if joint else 0.0, unit),
        stiffness=table.number("stiffness", NUMBER, 0.0),
        damping=table.number("damping", NUMBER, 0.0),
        start=table.number("start", what, 0.0, unit),
        unit=unit,
        place=entry.place,
    )
    if low > high:
        entry.complain(f"the lower limit {low:g} lies above the upper limit {high:g}")
    table.finish()
    return servo


def _held(entry: Entry) -> Held:
    table = entry.table()
    unit = _unit(table, entry)
    what = ANGLE if unit in UNITS_OF[ANGLE] else LENGTH
    at = table.number("at", what, counted=unit) * UNITS[unit]
    held = Held(table.text("joint"), table.text("part", ""), at, entry.place)
    table.finish()
    return held


def _unit(table: Table, entry: Entry) -> str:
    """In what a joint counts; rad after a complaint."""
    unit = table.text("unit", "rad")
    if unit in UNITS:
        return unit
    entry.complain(f"`{unit}` is no unit of a joint", "use one of " + ", ".join(UNITS))
    return "rad"


def _gamma(table: Table, entry: Entry, joint: str) -> float:
    """The factor of a servo; 1 after a complaint, so that it is complained about once."""
    faults = len(entry.reading.findings)
    gamma = table.number("gamma", NUMBER, None if joint else 1.0)
    if gamma == 0.0 and len(entry.reading.findings) == faults:
        entry.complain("gamma must not be 0: a command could not be carried to the device")
    return gamma or 1.0


def _limb(name: str, entry: Entry) -> Limb:
    table = entry.table()
    body, pose, shape = table.text("body"), _pose(table), table.need("cone")
    covered = table.get("covers")
    table.finish()
    cone = _cone(shape) if shape else Cone(0, 1, 1, 1)
    covers = tuple(one.text() for one in covered.items()) if covered else ()
    return Limb(name, body, pose[:3, 3], pose[:3, :3], cone, covers, entry.place)


def _cone(entry: Entry) -> Cone:
    table = entry.table()
    (x0, x1), (r0, r1) = (table.numbers(key, (LENGTH,) * 2) for key in ("x", "r"))
    table.finish()
    try:
        return Cone(x0, x1, r0, r1)
    except ValueError as error:
        entry.complain(str(error))
        return Cone(0, 1, 1, 1)


def _chain(entry: Entry, size: int) -> Chain:
    table = entry.table()
    base, tool = (_pose_at(table, key) for key in ("base", "tool"))
    listed = table.need("rows")
    table.finish()
    rows = tuple(_row(one, size) for one in listed.items()) if listed else ()
    try:
        return Chain(rows, size, base, tool)
    except ValueError as error:
        entry.complain(str(error))
        return Chain((), size)


def _row(entry: Entry, size: int) -> Row:
    table = entry.table()
    servo, fixed = table.get("servo"), table.number("fixed", ANGLE, 0.0)
    joint = servo.integer() if servo else None
    if servo and not 0 <= (joint or 0) < size:
        servo.complain(f"there is no servo {joint}: the part has 0 to {size - 1}")
        joint = None
    a, d = (table.number(key, LENGTH, 0.0) for key in ("a", "d"))
    alpha, offset = (table.number(key, ANGLE, 0.0) for key in ("alpha", "offset"))
    table.finish()
    return Row(a, d, alpha, offset + (fixed if joint is None else 0.0), joint)


def _pose_at(table: Table, key: str) -> Floats:
    found = table.get(key)
    if found is None:
        return np.eye(4)
    inner = found.table()
    pose = _pose(inner)
    inner.finish()
    return pose


def _pose(table: Table) -> Floats:
    """4 x 4 from `position` and `rpy` (turns about the fixed x, y, z, in this order)."""
    pose = np.eye(4)
    pose[:3, 3] = table.numbers("position", (LENGTH,) * 3, _NO_TURN)
    roll, pitch, yaw = table.numbers("rpy", (ANGLE,) * 3, _NO_TURN)
    pose[:3, :3] = rotation(roll, pitch, yaw)
    return pose


def rotation(roll: float, pitch: float, yaw: float) -> Floats:
    """Rz(yaw) Ry(pitch) Rx(roll), 3 x 3."""
    (cr, cp, cy), (sr, sp, sy) = np.cos((roll, pitch, yaw)), np.sin((roll, pitch, yaw))
    return np.array(
        [
            [cy * cp, cy * sp * sr - sy * cr, cy * sp * cr + sy * sr],
            [sy * cp, sy * sp * sr + cy * cr, sy * sp * cr - cy * sr],
            [-sp, cp * sr, cp * cr],
        ]
    )
