"""NAO, editions H25 (25 motors) and H21 (21: no wrists, no hands), as data.

Frames: x ahead, y left, z up, all parallel to the torso's at zero, where the arms point ahead.
Sources: the published URDF of V4 and V5, the vendor's documentation 1.14 to 2.5 for limits and
lengths, and B-Human's simulated H21 for its lower arm and for the boxes. Armature and damping are
own choices. H21 is a V4, H25 a V5.
"""

from __future__ import annotations

from dataclasses import replace

from robocomp_dsl.simulation.robots.links import (
    Joint,
    Link,
    Mass,
    RobotModel,
    Vector,
    ball,
    box,
    capsule,
    mirrored,
    shift,
    solid_ball,
    solid_box,
    turned,
)

X, Y, Z = (1.0, 0.0, 0.0), (0.0, 1.0, 0.0), (0.0, 0.0, 1.0)
ROOT_HALF = 0.5**0.5
HIP_YAW = (0.0, ROOT_HALF, -ROOT_HALF)
HAND_Z = -0.01231
LIMB = 0.028
"""Radius of the arm's capsules."""

_SIDES = {"L": "R", "l_": "r_"}

# joints with mirrored limits: name of the left one, limits of the right one
_RIGHT_LIMITS = {
    "LShoulderRoll": (-1.32645, 0.314159),
    "LElbowRoll": (0.0349066, 1.54462),
    "LHipRoll": (-0.79046, 0.379435),
    "LAnklePitch": (-1.1863, 0.932006),
    "LAnkleRoll": (-0.768992, 0.397761),
}


def nao_h25() -> RobotModel:
    """The academic edition, V5: 25 motors."""
    shoulder = Mass(0.09304, (-0.00165, -0.02663, 0.00014), (1.83025e-5, 1.39005e-5, 2.01862e-5))
    hips = {"LHip": 0.14053, "LTibia": 0.30142, "l_ankle": 0.17184, "Neck": 0.07842}
    return _robot("nao_h25", (*_upper_arm(shoulder), *_h25_forearm()), hips)


def nao_h21() -> RobotModel:
    """The RoboCup edition, V4: 21 motors, with a one-piece lower arm."""
    shoulder = Mass(0.07504, (-0.00165, -0.02663, 0.00014), (1.83025e-5, 1.39005e-5, 2.01862e-5))
    hips = {"LHip": 0.13053, "LTibia": 0.29142, "l_ankle": 0.16184, "Neck": 0.06442}
    return _robot("nao_h21", (*_upper_arm(shoulder), *_h21_forearm()), hips)


def _robot(name: str, arm: tuple[Link, ...], masses: dict[str, float]) -> RobotModel:
    left = (*arm, *_leg(masses))
    links = (_torso(), *_head(masses["Neck"]), *left, *_right(left))
    start: dict[str, float] = {}
    for side, sign in (("L", 1.0), ("R", -1.0)):
        start |= {
            f"{side}ShoulderPitch": 1.2,
            f"{side}ShoulderRoll": 0.2 * sign,
            f"{side}ElbowYaw": -1.2 * sign,
            f"{side}ElbowRoll": -0.6 * sign,
        }
    return RobotModel(name, links, _neighbours(), start, height=0.33301 + 0.002)


def _neighbours() -> tuple[tuple[str, str], ...]:
    pairs = [("torso", "Head")]
    for side, foot in (("L", "l_ankle"), ("R", "r_ankle")):
        pairs += [(f"{side}Bicep", f"{side}ForeArm"), ("torso", f"{side}Thigh")]
        pairs += [(f"{side}Tibia", foot)]
    return tuple(pairs)


def _torso() -> Link:
    mass = Mass(1.04956, (-0.00413, 0.0, 0.04342), (3.08361e-3, 2.8835e-3, 1.5924e-3))
    shape = box((0.1, 0.12, 0.19), (0.0, 0.0, 0.02))
    return Link("torso", "", shift(0, 0, 0), mass, shapes=(shape,))


def _head(neck_mass: float) -> tuple[Link, ...]:
    yaw = Joint("HeadYaw", Z, -2.08567, 2.08567, 8.26797, 1.547)
    pitch = Joint("HeadPitch", Y, -0.671952, 0.514872, 7.19407, 1.532)
    neck = Mass(neck_mass, (-1e-5, 0.0, -0.02742), (1.60324e-5, 1.70394e-5, 5.53372e-6))
    head = Mass(0.60533, (-0.00112, 0.0, 0.05258), (9.57766e-4, 8.16836e-4, 9.84976e-4))
    cameras = {
        "CameraTop": turned(shift(0.05871, 0, 0.06364), 1, 0.0209435),
        "CameraBottom": turned(shift(0.05071, 0, 0.01774), 1, 0.692896),
    }
    return (
        Link("Neck", "torso", shift(0, 0, 0.1265), neck, yaw),
        Link(
            "Head",
            "Neck",
            shift(0, 0, 0),
            head,
            pitch,
            (ball(0.062, (0.0, 0.0, 0.055)),),
            cameras,
        ),
    )


def _upper_arm(shoulder: Mass) -> tuple[Link, ...]:
    pitch = Joint("LShoulderPitch", Y, -2.08567, 2.08567, 8.26797, 1.329)
    roll = Joint("LShoulderRoll", Z, -0.314159, 1.32645, 7.19407, 1.7835)
    yaw = Joint("LElbowYaw", X, -2.08567, 2.08567, 8.26797, 1.547)
    bicep = Mass(0.15777, (0.02455, 0.00563, 0.0033), (8.7181e-5, 2.74712e-4, 2.41812e-4))
    elbow = Mass(0.06483, (-0.02744, 0.0, -0.00014), (5.59588e-6, 2.66179e-5, 2.76294e-5))
    shape = capsule(LIMB, (0, 0, 0), (0.067, 0, 0))
    return (
        Link("LShoulder", "torso", shift(0, 0.098, 0.1), shoulder, pitch),
        Link("LBicep", "LShoulder", shift(0, 0, 0), bicep, roll, (shape,)),
        Link("LElbow", "LBicep", shift(0.105, 0.015, 0), elbow, yaw),
    )


def _elbow_roll() -> Joint:
    return Joint("LElbowRoll", Z, -1.54462, -0.0349066, 7.19407, 1.532)


def _h21_forearm() -> tuple[Link, ...]:
    # moments printed about the link's origin, moved to the centre of mass
    mass, (x, y, z) = 0.18405, (0.0653, -0.00114, 0.00051)
    moved: Vector = (
        7.81042e-5 - mass * (y * y + z * z),
        1.12084e-3 - mass * (x * x + z * z),
        1.12214e-3 - mass * (x * x + y * y),
    )
    shape = capsule(LIMB, (0.026, 0, 0), (0.114, 0, 0))
    hand = {"l_hand": shift(0.1137, 0, 0)}
    body = Mass(mass, (x, y, z), moved)
    return (Link("LForeArm", "LElbow", shift(0, 0, 0), body, _elbow_roll(), (shape,), hand),)


def _h25_forearm() -> tuple[Link, ...]:
    wrist = Joint("LWristYaw", X, -1.82387, 1.82387, 24.6229, 0.4075, 0.001, 0.01)
    hand = Joint("LHand", X, 0.0, 1.0, 8.33, 0.292, 0.001, 0.01)
    forearm = Mass(0.07761, (0.02556, 0.00281, 0.00076), (2.46746e-5, 3.83837e-5, 3.59708e-5))
    palm = Mass(0.18533, (0.03434, -0.00088, 0.00308), (6.86477e-5, 1.35756e-4, 1.33228e-4))
    finger = Mass(2e-6, (0.0, 0.0, 0.0), (1e-9, 1e-9, 1e-9))
    # own choice: no gap or step under the skin; the published boxes are 47 and 50 mm wide
    elbow_end = capsule(LIMB, (0.026, 0, 0), (0.084, 0, 0))
    wrist_end = capsule(LIMB, (0.028, 0, 0), (0.052, 0, 0))
    point = {"l_hand": shift(0, 0, 0)}
    return (
        Link("LForeArm", "LElbow", shift(0, 0, 0), forearm, _elbow_roll(), (elbow_end,)),
        Link("l_wrist", "LForeArm", shift(0.05595, 0, 0), palm, wrist, (wrist_end,)),
        Link("l_gripper", "l_wrist", shift(0.05775, 0, HAND_Z), finger, hand, (), point),
    )


def _leg(masses: dict[str, float]) -> tuple[Link, ...]:
    def joint(name: str, axis: Vector, low: float, high: float, *, slow: bool) -> Joint:
        speed, effort = (4.16174, 3.348) if slow else (6.40239, 3.023)
        return Joint(name, axis, low, high, speed, effort, 0.01, 0.1)

    bone = (0.07, 0.07, 0.09)
    foot, ground = (0.15, 0.075, 0.03), (0.02, 0.003, -0.03011)
    thigh, shin = (0.0, 0.0, -0.05), (0.0, 0.0, -0.051375)
    here = shift(0, 0, 0)
    return (
        Link("LPelvis", "torso", shift(0, 0.05, -0.085), solid_ball(0.06981, 0.025),
             joint("LHipYawPitch", HIP_YAW, -1.14529, 0.740718, slow=True)),
        Link("LHip", "LPelvis", here, solid_ball(masses["LHip"], 0.03),
             joint("LHipRoll", X, -0.379435, 0.79046, slow=True)),
        Link("LThigh", "LHip", here, solid_box(0.38968, bone, thigh),
             joint("LHipPitch", Y, -1.53589, 0.48398, slow=False), (box(bone, thigh),)),
        Link("LTibia", "LThigh", shift(0, 0, -0.1), solid_box(masses["LTibia"], bone, shin),
             joint("LKneePitch", Y, -0.0923279, 2.11255, slow=False), (box(bone, shin),)),
        Link("LAnklePitch", "LTibia", shift(0, 0, -0.1029), solid_ball(0.13416, 0.03),
             joint("LAnklePitch", Y, -1.18944, 0.922581, slow=False)),
        Link("l_ankle", "LAnklePitch", here, solid_box(masses["l_ankle"], foot, ground),
             joint("LAnkleRoll", X, -0.397761, 0.768992, slow=True), (box(foot, ground),),
             {"l_sole": shift(0, 0, -0.04511)}),
    )  # fmt: skip


def _right(left: tuple[Link, ...]) -> tuple[Link, ...]:
    """The other side: the maker keeps the axes and swaps the mirrored limits."""
    links = []
    for left_link, link in zip(left, mirrored(left, _SIDES), strict=True):
        joint = left_link.joint
        assert joint is not None  # noqa: S101 - every link of a side hangs on a joint
        low, high = _RIGHT_LIMITS.get(joint.name, (joint.low, joint.high))
        right = replace(joint, name="R" + joint.name[1:], low=low, high=high)
        if joint.name == "LHipYawPitch":
            right = replace(right, axis=(0.0, ROOT_HALF, ROOT_HALF), leader="LHipYawPitch")
        links.append(replace(link, joint=right))
    return tuple(links)
