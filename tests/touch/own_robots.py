"""Two robots with other proportions and other orders of joints than the shipped ones.

`crane` has long hanging arms, and its first joint is the roll. `crab` has arms that point sideways,
no shoulder yaw, and joint angles in degrees that run backwards on one side.
"""

from __future__ import annotations

from pathlib import Path

from robocomp_dsl.tactile.description.model import RobotDescription
from robocomp_dsl.tactile.description.read import load_robot

OWN_ROBOTS = ("crane", "crab")
SIDES = {"left_arm": 1, "right_arm": -1}
MOTIONS = {
    "outer": (0, -0.25, 0.45, 0, 0),
    "inner": (0, 0.35, -0.45, 0, 0),
    "under": (0.4, 0, 0, 0.45, 0),
    "upper": (-0.4, 0, 0, -0.3, 0),
}


def write_robot(name: str, folder: Path) -> RobotDescription:
    """Writes model and description into `folder`, and reads the description."""
    model, description = {"crane": (_crane_model, _crane), "crab": (_crab_model, _crab)}[name]
    (folder / f"{name}.xml").write_text(model())
    file = folder / f"{name}.tactile.yaml"
    file.write_text(description())
    return load_robot(file)


def _world(name: str, torso: str, arms: str) -> str:
    return f"""<mujoco model="{name}"><compiler angle="radian"/><worldbody>
      <body name="torso" pos="0 0 1">{torso}{arms}</body></worldbody></mujoco>"""


def _joint(name: str, axis: str, low: float, high: float) -> str:
    return f'<joint name="{name}" axis="{axis}" range="{low} {high}"/>'


def _crane_model() -> str:
    arms = "".join(
        f"""<body name="{s}_mount" pos="0.02 {0.24 * y} 0.3">
          {_joint(s + "roll", "1 0 0", -2.5, 2.5)}
          <inertial pos="0 0 0" mass="0.1" diaginertia="1e-4 1e-4 1e-4"/>
          <body name="{s}_upper">{_joint(s + "pitch", "0 1 0", -2.5, 2.5)}
            {_joint(s + "yaw", "0 0 1", -2, 2)}
            <geom type="capsule" fromto="0 0 -0.05 0 0 -0.34" size="0.04"/>
            <body name="{s}_lower" pos="0.01 0 -0.42">{_joint(s + "elbow", "0 1 0", -2.4, 0)}
              {_joint(s + "twist", "0 0 1", -2, 2)}
              <geom type="capsule" fromto="0 0 -0.05 0 0 -0.34" size="0.035"/>
            </body></body></body>"""
        for s, y in (("l", 1), ("r", -1))
    )
    return _world("crane", '<geom type="box" size="0.1 0.14 0.35"/>', arms)


def _crane() -> str:
    parts = []
    for part, y in SIDES.items():
        s, roll = part[0], "-90" if y > 0 else "90"
        servos = [
            _servo(s + "pitch", -1, (-2.5, 2.5), 0.4),
            _servo(s + "roll", y, (-2.5, 2.5), 0.3 * y),
            _servo(s + "yaw", -y, (-2, 2), 0.2),
            _servo(s + "elbow", -1, (-2.4, 0), -0.8),
            _servo(s + "twist", -y, (-2, 2), 0),
        ]
        parts.append(_part(part, servos, f"rpy: [{roll} deg, 90 deg, 0]", 0.04, 0.035))
    return _description("crane", parts)


def _crab_model() -> str:
    arms = "".join(
        f"""<body name="{s}_upper" pos="0.05 {0.2 * y} 0.05">
            {_joint(s + "sweep", "0 0 1", -1.9, 1.9)}
            {_joint(s + "lift", "1 0 0", -1.2, 1.2)}
            <geom type="capsule" fromto="0 {0.05 * y} 0 0 {0.25 * y} 0" size="0.03"/>
            <body name="{s}_lower" pos="0 {0.3 * y} 0.02">{_joint(s + "fold", "0 0 1", -2.2, 2.2)}
              {_joint(s + "roll", "0 1 0", -2, 2)}
              <geom type="capsule" fromto="0 {0.05 * y} 0 0 {0.34 * y} 0" size="0.03"/>
            </body></body>"""
        for s, y in (("l", 1), ("r", -1))
    )
    return _world("crab", '<geom type="cylinder" size="0.15 0.1"/>', arms)


def _crab() -> str:
    parts = []
    for part, y in SIDES.items():
        s = part[0]
        servos = [
            _servo(s + "lift", y, (-68, 68), 10 * y, "deg"),
            _servo(s + "sweep", -y, (-105, 105), 0, "deg"),
            "{sigma: 0}",
            _servo(s + "fold", y, (-125, 125), 40 * y, "deg"),
            _servo(s + "roll", 1, (-110, 110), 0, "deg"),
        ]
        parts.append(_part(part, servos, f"rpy: [0, 0, {90 * y} deg]", 0.03, 0.03))
    return _description("crab", parts)


def _servo(
    joint: str, gamma: float, limits: tuple[float, float], start: float, unit: str = "rad"
) -> str:
    scale = 0.017453292519943295 if unit == "deg" else 1.0
    return (
        f"{{joint: {joint}, part: arm, unit: {unit}, gamma: {gamma * scale}, sigma: 0,"
        f" limits: [{limits[0]}, {limits[1]}], speed: {3 / scale}, start: {start}}}"
    )


def _part(name: str, servos: list[str], rpy: str, upper: float, lower: float) -> str:
    s = name[0]
    lines = [f"  {name}:", "    servos:", *(f"      - {servo}" for servo in servos), "    limbs:"]
    for limb, radius in (("upper", upper), ("lower", lower)):
        cone = f"cone: {{x: [50 mm, 240 mm], r: [{radius}, {radius}]}}"
        lines.append(f"      {limb}_arm: {{body: {s}_{limb}, {rpy}, {cone}}}")
    lines.append("    skin:")
    for number, limb in enumerate(("upper", "lower")):
        first = 10_000 * (name == "right_arm") + 1000 * number
        lines.append(
            f"      - {{patch: {s}_{limb}, limb: {limb}_arm, first_id: {first},"
            " rings: {x: [80 mm, 120 mm, 160 mm, 200 mm], count: 8}}"
        )
    lines.append("    fields:")
    for limb in ("upper", "lower"):
        for i, (place, motion) in enumerate(MOTIONS.items()):
            theta = (0, 180, 90, -90)[i] * (1 if name == "left_arm" else -1)
            lines.append(
                f"      - {{name: {limb}_arm_{place}, limb: {limb}_arm, x: 140 mm,"
                f" theta: {theta} deg, radius: 60 mm, motion: {list(motion)}}}"
            )
    return "\n".join(lines)


def _description(name: str, parts: list[str]) -> str:
    return f"robot: {name}\nmodel: {name}.xml\nparts:\n" + "\n".join(parts) + "\n"
