"""The iCub's upper body, version 2, as data: torso, head and two arms of seven joints.

Root frame: x backward, y right, z up, at the waist. The chain is the Denavit-Hartenberg table of
iKin (1.0 <= v < 3.0 for arms, 2.0 <= v < 3.0 for the head), link = Rz(q + offset) Tz(d) Tx(a)
Rx(alpha); a link's body is the frame before its row, so that its joint turns about z. Limits: the
board files of a real robot. Masses: the robot's CAD model. Own choices: torque and speed limits
(none are published), shapes where not measured, moments of inertia (those of the shapes).
"""

from __future__ import annotations

from dataclasses import dataclass
from math import pi, radians

import numpy as np

from robocomp_dsl.simulation.robots.links import (
    Floats,
    Joint,
    Link,
    Mass,
    RobotModel,
    Shape,
    ball,
    box,
    capsule,
    shift,
    solid_ball,
    solid_box,
)
from robocomp_dsl.tactile.arm.chain import link as transform

H0 = np.array([[0.0, -1, 0, 0], [0, 0, -1, 0], [1, 0, 0, 0], [0, 0, 0, 1]])
Z = (0.0, 0.0, 1.0)
SPEED = 2.0
"""Maximum speed of every joint [rad/s]; the board files say 1000 deg/s, which is no real limit."""


@dataclass(frozen=True, slots=True)
class Dh:
    """One row, angles in degrees, with the joint's name, limits and torque, and its body's mass."""

    body: str
    joint: str
    a: float
    d: float
    alpha: float
    offset: float
    low: float
    high: float
    effort: float
    mass: float
    size: float
    armature: float

    @property
    def fixed(self) -> Floats:
        """The row at q = 0: from this body's frame to the next."""
        return transform(self.a, self.d, radians(self.alpha), radians(self.offset))


# body, joint, a, d, alpha, offset, low, high, N m, kg, radius of the ball of its inertia, armature
TORSO = (
    Dh("torso_1", "torso_pitch", 0.032, 0, 90, 0, -20, 70, 60, 0.67144, 0.05, 0.1),
    Dh("torso_2", "torso_roll", 0, -0.0055, 90, -90, -30, 30, 60, 0.425685, 0.04, 0.1),
)
YAW_TO_RIGHT = Dh(
    "chest", "torso_yaw", -0.0233647, -0.1433, 90, -105, -50, 50, 60, 7.638, 0.09, 0.1
)
YAW_TO_LEFT = Dh("chest", "torso_yaw", 0.0233647, -0.1433, -90, 105, -50, 50, 60, 7.638, 0.09, 0.1)
YAW_TO_HEAD = Dh("chest", "torso_yaw", 0, -0.2233, -90, -90, -50, 50, 60, 7.638, 0.09, 0.1)
HEAD = (
    Dh("neck_1", "neck_pitch", 0.0095, 0, 90, 90, -30, 22, 8, 0.125793, 0.03, 0.02),
    Dh("neck_2", "neck_roll", 0, 0, -90, -90, -20, 20, 8, 0.177087, 0.03, 0.02),
    Dh("head", "neck_yaw", -0.0509, 0.08205, -90, 90, -45, 45, 8, 1.50691, 0.075, 0.02),
)
RIGHT_ARM = (
    Dh("shoulder_1", "shoulder_pitch", 0, -0.10774, 90, -90, -95.5, 8, 40, 0.114862, 0.03, 0.05),
    Dh("shoulder_2", "shoulder_roll", 0, 0, -90, -90, 9, 160, 40, 0.238162, 0.035, 0.05),
    Dh("upper_arm", "shoulder_yaw", -0.015, -0.15228, -90, -105, -32, 80, 20, 1.104, 0.055, 0.03),
    Dh("elbow", "elbow", 0.015, 0, 90, 0, 15, 106, 20, 0.267903, 0.03, 0.03),
    Dh("forearm", "wrist_prosup", 0, -0.1413, 90, -90, -60, 60, 4, 0.6347, 0.045, 0.01),
    Dh("wrist", "wrist_pitch", 0, 0, 90, 90, -80, 25, 4, 0.0362615, 0.02, 0.005),
    Dh("hand", "wrist_yaw", 0.0625, 0.02598, 0, 180, -20, 25, 4, 0.248289, 0.035, 0.005),
)
# the left table has other signs in a, d, alpha and offset; the rest is identical
LEFT_SIGNS = (
    (0, 0.10774, -90, 90),
    (0, 0, 90, -90),
    (0.015, 0.15228, -90, 75),
    (-0.015, 0, 90, 0),
    (0, 0.1413, 90, -90),
    (0, 0, 90, 90),
    (0.0625, -0.02598, 0, 0),
)
EYE_ROW = (0.0, 0.0, 90.0, -90.0)
START = {"shoulder_pitch": -30, "shoulder_roll": 30, "shoulder_yaw": 0, "elbow": 45}


def icub_v2() -> RobotModel:
    """Torso, head with eyes, and both arms with hands as one block: 3 + 6 + 14 joints."""
    start = {f"{s}_{name}": radians(value) for s in "rl" for name, value in START.items()}
    start |= {f"{s}_shoulder_roll": radians(30) for s in "rl"}
    links = (_root(), *_trunk(), *_head(), *_arm("r"), *_arm("l"))
    return RobotModel("icub_v2", links, _neighbours(), start, height=0.6, heading=pi)


def left_arm() -> tuple[Dh, ...]:
    """The rows of the left arm."""
    return tuple(
        Dh(
            r.body,
            r.joint,
            a,
            d,
            alpha,
            offset,
            r.low,
            r.high,
            r.effort,
            r.mass,
            r.size,
            r.armature,
        )
        for r, (a, d, alpha, offset) in zip(RIGHT_ARM, LEFT_SIGNS, strict=True)
    )


def _neighbours() -> tuple[tuple[str, str], ...]:
    pairs = [("root_link", "chest"), ("chest", "head")]
    for side in "rl":
        pairs += [(f"{side}_upper_arm", f"{side}_forearm"), (f"{side}_forearm", f"{side}_hand")]
    return tuple(pairs)


def _root() -> Link:
    size, centre = (0.14, 0.16, 0.10), (0.0249, 0.0001, -0.0441)
    return Link("root_link", "", shift(0, 0, 0), solid_box(5.09143, size, centre),
                shapes=(box(size, centre),))  # fmt: skip


def _trunk() -> tuple[Link, ...]:
    """Torso bodies; the chest's shape is expressed in the root frame of the zero pose."""
    first = _link(TORSO[0], "root_link", H0)
    second = _link(TORSO[1], "torso_1", TORSO[0].fixed)
    at = H0 @ TORSO[0].fixed @ TORSO[1].fixed
    size, centre = (0.12, 0.125, 0.16), (0.0, 0.0, 0.15)
    shape = _seen_from(at, box(size, centre))
    mass = _turned_mass(solid_box(7.638, size, centre), at)
    chest = _link(YAW_TO_RIGHT, "torso_2", TORSO[1].fixed, shape, mass=mass)
    return first, second, chest


def _head() -> tuple[Link, ...]:
    links, parent, pose = [], "chest", YAW_TO_HEAD.fixed
    at = H0 @ TORSO[0].fixed @ TORSO[1].fixed @ pose
    for row in HEAD:
        face = _seen_from(at, ball(0.075, (-0.02, 0.0, 0.345))) if row.body == "head" else None
        links.append(_link(row, parent, pose, face))
        parent, pose, at = row.body, row.fixed, at @ row.fixed
    tilt = Dh("eyes", "eyes_tilt", 0, 0, -90, 0, -30, 30, 1, 0.05, 0.02, 0.002)
    links.append(_link(tilt, "head", HEAD[-1].fixed))
    for side, d in (("r", 0.034), ("l", -0.034)):
        pan = Dh(f"{side}_eye", f"{side}_eye_pan", *EYE_ROW, -50, 50, 1, 0.03, 0.015, 0.002)
        beside = transform(0, d, -pi / 2, 0)
        links.append(_link(pan, "eyes", beside, points={f"{side}_eye": pan.fixed}))
    return tuple(links)


def _arm(side: str) -> tuple[Link, ...]:
    rows, yaw = (RIGHT_ARM, YAW_TO_RIGHT) if side == "r" else (left_arm(), YAW_TO_LEFT)
    links, parent, pose = [], "chest", yaw.fixed
    for row in rows:
        points = {f"{side}_hand": row.fixed} if row.body == "hand" else {}
        shape = _arm_shape(row)
        links.append(_link(row, parent, pose, shape, points=points, side=f"{side}_"))
        parent, pose = f"{side}_{row.body}", row.fixed
    return tuple(links)


def _arm_shape(row: Dh) -> Shape | None:
    """Capsules along the limbs, a box for hand and fingers; none for the small bodies."""
    if row.body == "upper_arm":  # 0.09 long, ends at the elbow
        elbow = row.fixed[:3, 3]
        start = elbow * (1 - 0.09 / np.linalg.norm(elbow))
        return capsule(0.040, _point(start), _point(elbow))
    if row.body == "forearm":  # 0.085 long, its middle 0.07 from the elbow
        z = float(np.sign(row.d))
        return capsule(0.035, (0, 0, z * (0.07 - 0.0425)), (0, 0, z * (0.07 + 0.0425)))
    if row.body == "hand":
        return Shape("box", (0.04, 0.04, 0.025), row.fixed)
    return None


def _link(
    row: Dh,
    parent: str,
    pose: Floats,
    shape: Shape | None = None,
    *,
    points: dict[str, Floats] | None = None,
    mass: Mass | None = None,
    side: str = "",
) -> Link:
    low, high = radians(row.low), radians(row.high)
    name = f"{side}{row.joint}"
    joint = Joint(name, Z, low, high, SPEED, row.effort, row.armature, 0.02 * row.effort**0.5)
    centre = _point(shape.pose[:3, 3]) if shape else (0.0, 0.0, 0.0)
    ball_mass = solid_ball(row.mass, row.size, centre)
    shapes = (shape,) if shape else ()
    return Link(f"{side}{row.body}", parent, pose, mass or ball_mass, joint, shapes, points or {})


def _seen_from(frame: Floats, shape: Shape) -> Shape:
    """A shape of the root frame in `frame`."""
    return Shape(shape.kind, shape.size, np.linalg.inv(frame) @ shape.pose)


def _turned_mass(mass: Mass, frame: Floats) -> Mass:
    """A mass of the root frame in `frame`, whose axes are those of the root in another order."""
    inverse = np.linalg.inv(frame)
    centre = inverse @ np.array([*mass.centre, 1.0])
    inertia = np.diag(inverse[:3, :3] @ np.diag(mass.inertia) @ inverse[:3, :3].T)
    return Mass(mass.mass, _point(centre), _point(inertia))


def _point(values: Floats) -> tuple[float, float, float]:
    return float(values[0]), float(values[1]), float(values[2])
