"""Read a tactile description from YAML.

In: the text of a file. Out: a checked `RobotDescription`, or `DescriptionError` with all findings.
The format:

    robot: name
    model: body.xml          (InnerModel, MJCF or URDF; optional)
    parts:
      left_arm:
        servos: [{joint, part, gamma, sigma, limits, speed, stiffness, damping, start, unit}, ...]
        chain: {base: {position, rpy}, tool: {...}, rows: [{servo | fixed, a, d, alpha, offset}],
                tip: body or site of the model at the end of the chain (optional)}
        limbs: {upper_arm: {body, covers, position, rpy, cone: {x: [x0, x1], r: [r0, r1]}}}
        skin: [{patch, limb, first_id, rings | points | file, sensitivity}]
        fields: [{name, limb, x, theta, rho, radius, motion}]
        held: [{joint, part, at, unit}]
"""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path

import numpy as np

from robocomp_dsl.regular_file import read_text
from robocomp_dsl.tactile.arm.chain import Chain, DhLink
from robocomp_dsl.tactile.arrays import Floats
from robocomp_dsl.tactile.description.check import check
from robocomp_dsl.tactile.description.model import (
    FixedJoint,
    GenericPart,
    Limb,
    RobotDescription,
    Servo,
)
from robocomp_dsl.tactile.description.skin import read_fields, read_patches
from robocomp_dsl.tactile.description.yaml_reader import (
    ANGLE,
    LENGTH,
    NUMBER,
    UNITS,
    UNITS_OF,
    YamlReader,
    YamlTable,
    YamlValue,
)
from robocomp_dsl.tactile.skin.cone import Cone

_ZERO_VECTOR = (0.0, 0.0, 0.0)


def read_robot(text: str, file: Path) -> RobotDescription:
    """The robot that `text` describes. Raises `DescriptionError` with all findings."""
    reading = YamlReader(file)
    top = reading.root(text).table()
    name, parts, body = top.text("robot"), top.require("parts"), top.get("model")
    top.finish()
    rows = parts.table().rows if parts else {}
    robot_parts = tuple(_part(key, entry) for key, entry in rows.items())
    robot = RobotDescription(name, robot_parts, file)
    if body:
        robot = replace(robot, model=body.text(), model_place=body.place)
    reading.finish()
    check(robot, reading.findings)
    reading.finish()
    return robot


def load_robot(file: Path) -> RobotDescription:
    """The robot that the file describes. Raises as `read_robot`, and `OSError`."""
    return read_robot(read_text(file), file)


def _part(name: str, entry: YamlValue) -> GenericPart:
    table = entry.table()
    listed, limb_table = table.require("servos"), table.get("limbs")
    servos = tuple(_servo(item) for item in listed.items()) if listed else ()
    chain = table.get("chain")
    rows = limb_table.table().rows if limb_table else {}
    limbs = {key: _limb(key, row) for key, row in rows.items()}
    patches = read_patches(table.get("skin"), limbs)
    fields = read_fields(table.get("fields"), limbs, patches, servos)
    fixed = table.get("held")
    held = tuple(_fixed_joint(item) for item in fixed.items()) if fixed else ()
    table.finish()
    part = GenericPart(
        name, servos, None, tuple(limbs.values()), patches, fields, held, entry.place
    )
    return _with_chain(part, chain) if chain else part


def _servo(entry: YamlValue) -> Servo:
    table = entry.table()
    joint, unit = table.text("joint", ""), _unit(table, entry)
    quantity = ANGLE if unit in UNITS_OF[ANGLE] else LENGTH
    unlimited = () if joint else (-np.inf, np.inf)
    low, high = table.numbers("limits", (quantity, quantity), unlimited, default_unit=unit)
    gamma = _gamma(table, entry, joint)
    servo = Servo(
        joint=joint,
        part=table.text("part", ""),
        gamma=gamma,
        sigma=table.number("sigma", quantity),
        low=min(low, high),
        high=max(low, high),
        speed=table.number("speed", quantity, None if joint else 0.0, unit),
        stiffness=table.number("stiffness", NUMBER, 0.0),
        damping=table.number("damping", NUMBER, 0.0),
        start=table.number("start", quantity, 0.0, unit),
        unit=unit,
        place=entry.place,
    )
    if low > high:
        entry.report(f"the lower limit {low:g} is above the upper limit {high:g}")
    table.finish()
    return servo


def _fixed_joint(entry: YamlValue) -> FixedJoint:
    table = entry.table()
    unit = _unit(table, entry)
    quantity = ANGLE if unit in UNITS_OF[ANGLE] else LENGTH
    position = table.number("at", quantity, default_unit=unit) * UNITS[unit]
    joint = FixedJoint(table.text("joint"), table.text("part", ""), position, entry.place)
    table.finish()
    return joint


def _unit(table: YamlTable, entry: YamlValue) -> str:
    """The unit of a joint; rad, with a finding, if it is invalid."""
    unit = table.text("unit", "rad")
    if unit in UNITS:
        return unit
    entry.report(f"`{unit}` is not a unit of a joint", "use one of " + ", ".join(UNITS))
    return "rad"


def _gamma(table: YamlTable, entry: YamlValue, joint: str) -> float:
    """The factor of a servo; 1, with a single finding, if it is invalid."""
    faults = len(entry.reader.findings)
    gamma = table.number("gamma", NUMBER, None if joint else 1.0)
    if gamma == 0.0 and len(entry.reader.findings) == faults:
        entry.report("gamma must not be 0: commands could not be converted for the device")
    return gamma or 1.0


def _limb(name: str, entry: YamlValue) -> Limb:
    table = entry.table()
    body, pose, shape = table.text("body"), _pose(table), table.require("cone")
    covered = table.get("covers")
    table.finish()
    cone = _cone(shape) if shape else Cone(0, 1, 1, 1)
    covers = tuple(item.text() for item in covered.items()) if covered else ()
    return Limb(name, body, pose[:3, 3], pose[:3, :3], cone, covers, entry.place)


def _cone(entry: YamlValue) -> Cone:
    table = entry.table()
    (x0, x1), (r0, r1) = (table.numbers(key, (LENGTH,) * 2) for key in ("x", "r"))
    table.finish()
    try:
        return Cone(x0, x1, r0, r1)
    except ValueError as error:
        entry.report(str(error))
        return Cone(0, 1, 1, 1)


def _with_chain(part: GenericPart, entry: YamlValue) -> GenericPart:
    table = entry.table()
    size, tip = len(part.servos), table.text("tip", "")
    base, tool = (_pose_at(table, key) for key in ("base", "tool"))
    listed = table.require("rows")
    table.finish()
    items = listed.items() if listed else []
    rows = tuple(_dh_link(row, size) for row in items)
    try:
        chain = Chain(rows, size, base, tool)
    except ValueError as error:
        entry.report(str(error))
        chain = Chain((), size)
    joints = (row.joint for row in rows)
    places = tuple(zip(joints, (item.place for item in items), strict=True))
    return replace(part, chain=chain, tip=tip, chain_place=entry.place, row_places=places)


def _dh_link(entry: YamlValue, size: int) -> DhLink:
    table = entry.table()
    servo, fixed = table.get("servo"), table.number("fixed", ANGLE, 0.0)
    joint = servo.integer() if servo else None
    if servo and not 0 <= (joint or 0) < size:
        servo.report(f"there is no servo {joint}: the part has 0 to {size - 1}")
        joint = None
    a, d = (table.number(key, LENGTH, 0.0) for key in ("a", "d"))
    alpha, offset = (table.number(key, ANGLE, 0.0) for key in ("alpha", "offset"))
    table.finish()
    return DhLink(a, d, alpha, offset + (fixed if joint is None else 0.0), joint)


def _pose_at(table: YamlTable, key: str) -> Floats:
    value = table.get(key)
    if value is None:
        return np.eye(4)
    inner = value.table()
    pose = _pose(inner)
    inner.finish()
    return pose


def _pose(table: YamlTable) -> Floats:
    """4 x 4 from `position` and `rpy` (rotations about fixed x, y and z axes, in this order)."""
    pose = np.eye(4)
    pose[:3, 3] = table.numbers("position", (LENGTH,) * 3, _ZERO_VECTOR)
    roll, pitch, yaw = table.numbers("rpy", (ANGLE,) * 3, _ZERO_VECTOR)
    pose[:3, :3] = rotation_from_rpy(roll, pitch, yaw)
    return pose


def rotation_from_rpy(roll: float, pitch: float, yaw: float) -> Floats:
    """Rz(yaw) Ry(pitch) Rx(roll), 3 x 3."""
    (cr, cp, cy), (sr, sp, sy) = np.cos((roll, pitch, yaw)), np.sin((roll, pitch, yaw))
    return np.array(
        [
            [cy * cp, cy * sp * sr - sy * cr, cy * sp * cr + sy * sr],
            [sy * cp, sy * sp * sr + cy * cr, sy * sp * cr - cy * sr],
            [-sp, cp * sr, cp * cr],
        ]
    )
