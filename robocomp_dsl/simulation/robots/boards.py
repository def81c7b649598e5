"""The control boards of the robots: the joints, motors and coupling of each.

In: a robot and a board's name. Out: `BoardSpec`, and the transmission from the board's to the
simulated joints. Shared motors follow the iCub's boards; motor and coupling figures are our own.
"""

from __future__ import annotations

from dataclasses import dataclass
from math import radians

import numpy as np
from numpy.typing import NDArray

from robocomp_dsl.hardware.control.joints import BoardSpec, JointSpec, MotorSpec
from robocomp_dsl.simulation.robots.links import Joint, RobotModel

Floats = NDArray[np.float64]

SUPPLY = 24.0
"""Supply of all motors [V]."""

GEAR = 100.0
"""Turns of a motor per turn of its joint, unless a description has its own."""

NAO_ARM = ("ShoulderPitch", "ShoulderRoll", "ElbowYaw", "ElbowRoll", "WristYaw", "Hand")
NAO_LEG = ("HipYawPitch", "HipRoll", "HipPitch", "KneePitch", "AnklePitch", "AnkleRoll")
ICUB_ARM = (
    "shoulder_pitch",
    "shoulder_roll",
    "shoulder_yaw",
    "elbow",
    "wrist_prosup",
    "wrist_pitch",
    "wrist_yaw",
)
SHOULDER = np.array([[1.0, 0, 0], [1, 1, 0], [0, -1, 1]])
DIFFERENTIAL = np.array([[1.0, 1], [1, -1]])
WAIST = np.array([[1.0, 0, 0], [0, 1, 1], [0, 1, -1]])
EYES = np.array([[1.0, 0.5], [1, -0.5]])
"""Left and right eye from version and vergence."""

RANGES = (("eyes_version", -30.0, 30.0), ("eyes_vergence", 0.0, 45.0))
"""Their limits [degrees]."""


@dataclass(frozen=True, eq=False)
class RobotBoard:
    """A board; the robot's `joints` are at `transmission` @ the board's joint angles."""

    spec: BoardSpec
    joints: tuple[str, ...]
    transmission: Floats


def shared_limits(transmission: Floats, limits: Floats) -> Floats:
    """Torques (n,) that all joints of a board may use simultaneously.

    `limits` (n,) are those of the robot's joints, which follow the board's by `transmission`.
    """
    shares = np.abs(np.linalg.inv(transmission)).T
    count = np.count_nonzero(shares > 1e-12, axis=1)
    most = np.full_like(shares, np.inf)
    np.divide((limits / count)[:, None], shares, out=most, where=shares > 1e-12)
    found: Floats = most.min(axis=0)
    return found


def board_names(robot: RobotModel) -> tuple[str, ...]:
    """The names of the boards of `robot`."""
    if robot.name.startswith("icub"):
        return ("torso", "head", "left_arm", "right_arm")
    return ("Head", "LArm", "RArm", "LLeg", "RLeg")


def robot_board(robot: RobotModel, name: str) -> RobotBoard:
    """The board `name` of `robot`; raises `KeyError` for an unknown name."""
    if name not in board_names(robot):
        raise KeyError(name)
    if robot.name.startswith("icub"):
        return _icub(robot, name)
    side = name[0]
    rows = {"Head": ("HeadYaw", "HeadPitch"), "Arm": NAO_ARM, "Leg": NAO_LEG}
    found = rows[name] if name == "Head" else tuple(side + row for row in rows[name[1:]])
    there = tuple(j for j in found if j in robot.joints and not robot.joints[j].leader)
    return _plain([robot.joints[j] for j in there])


def whole_robot(robot: RobotModel) -> RobotBoard:
    """All boards of `robot` as one: a step of 30 joints costs little more than one of 6."""
    boards = [robot_board(robot, name) for name in board_names(robot)]
    spec = BoardSpec(
        tuple(joint for board in boards for joint in board.spec.joints),
        tuple(motor for board in boards for motor in board.spec.motors),
        _diagonal([board.spec.coupling for board in boards]),
    )
    joints = tuple(joint for board in boards for joint in board.joints)
    return RobotBoard(spec, joints, _diagonal([board.transmission for board in boards]))


def _diagonal(blocks: list[Floats]) -> Floats:
    size = sum(len(block) for block in blocks)
    matrix, at = np.zeros((size, size)), 0
    for block in blocks:
        matrix[at : at + len(block), at : at + len(block)] = block
        at += len(block)
    return matrix


def _icub(robot: RobotModel, name: str) -> RobotBoard:
    joints = robot.joints
    if name == "torso":
        return _plain([joints[f"torso_{axis}"] for axis in ("yaw", "roll", "pitch")], WAIST)
    if name == "head":
        return _icub_head(robot)
    return _plain([joints[f"{name[0]}_{joint}"] for joint in ICUB_ARM], SHOULDER)


def _icub_head(robot: RobotModel) -> RobotBoard:
    """Neck unchanged; the eyes are commanded by tilt, version and vergence."""
    joints = robot.joints
    real = ("neck_pitch", "neck_roll", "neck_yaw", "eyes_tilt", "l_eye_pan", "r_eye_pan")
    specs = [_joint(joints[joint]) for joint in real[:4]]
    pan = joints["l_eye_pan"]
    torques = shared_limits(EYES, np.full(2, pan.effort)).tolist()
    for (eyes, low, high), torque in zip(RANGES, torques, strict=True):
        specs.append(JointSpec(eyes, radians(low), radians(high), pan.speed, torque))
    coupling, transmission = np.eye(6), np.eye(6)
    coupling[:2, :2] = DIFFERENTIAL
    coupling[4:, 4:] = transmission[4:, 4:] = EYES
    motors = tuple(_motor(joints[joint]) for joint in real)
    return RobotBoard(BoardSpec(tuple(specs), motors, coupling), real, transmission)


def _plain(joints: list[Joint], block: Floats | None = None) -> RobotBoard:
    """Joints unchanged; `block` couples the first of them."""
    coupling = np.eye(len(joints))
    if block is not None:
        coupling[: len(block), : len(block)] = block
    specs, motors = tuple(map(_joint, joints)), tuple(map(_motor, joints))
    names = tuple(joint.name for joint in joints)
    return RobotBoard(BoardSpec(specs, motors, coupling), names, np.eye(len(joints)))


def _joint(joint: Joint) -> JointSpec:
    return JointSpec(joint.name, joint.low, joint.high, joint.speed, joint.effort)


def _motor(joint: Joint) -> MotorSpec:
    """A motor sized for its joint.

    Without load it turns the joint at twice its maximum speed, and it stalls at three times the
    maximum torque. A fault occurs at six times the current of that torque, since a differential may
    load one motor with the torques of three joints.
    """
    per_amp = SUPPLY / (2.0 * joint.speed)  # joint torque per ampere, limited by back EMF
    current = joint.effort / per_amp
    return MotorSpec(
        joint.name,
        gear=GEAR,
        torque_constant=per_amp / GEAR,
        resistance=SUPPLY / (3.0 * current),
        supply=SUPPLY,
        max_current=6.0 * current,
    )
