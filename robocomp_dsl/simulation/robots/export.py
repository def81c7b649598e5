"""The robots as worlds in MuJoCo's own format, for `rcgen simulator`: `python -m …robots.export`.

In: the shipped robots. Out: for each an MJCF file beside its simulator in `components/`, and its
tactile description for `--tactile`; the robot alone beside its description in `descriptions/`,
under the name that the description has in `model`. A world has a floor, the robot with its root
fixed above it, its control boards as tuples, its speed limits as numbers, and two fingers that can
touch it: balls on three prismatic joints with at most 20 N, whose joint positions are world
coordinates in m. The initial state is the key frame `start`.
"""

from __future__ import annotations

import shutil
import sys
from collections.abc import Iterable
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import mujoco
import numpy as np

from robocomp_dsl.simulation.robots.boards import board_names, robot_board
from robocomp_dsl.simulation.robots.build import add_robot, new_world, quaternion
from robocomp_dsl.simulation.robots.catalog import ROBOTS, description, description_file
from robocomp_dsl.simulation.robots.links import Floats, RobotModel, Vector

FINGERS = ("finger", "finger2")
"""Their bodies, balls and control boards; the joints are these and `_x`, `_y`, `_z`."""
TACTILE = "tactile.yaml"
RADIUS = 0.008
FORCE = 20.0
_MASS = 0.1
_SPEED = 0.5
_RANGE = {"x": (-1.2, 1.2), "y": (-1.2, 1.2), "z": (RADIUS, 2.0)}
_AHEAD = np.array([[0.0, 0, -1, 0], [-1, 0, 0, 0], [0, 1, 0, 0], [0, 0, 0, 1]])
"""A camera of MuJoCo, which looks along -z with y up, in a frame that looks along x with z up."""

_NOTE = "<!-- Written by `python -m robocomp_dsl.simulation.robots.export`; do not edit. -->\n"


@dataclass(frozen=True, slots=True)
class RobotWorld:
    """A robot in its world: initial positions of the fingers [m], cameras, a body with an IMU.

    `cameras` has name, point of the robot and vertical angle [degrees]; `hands` has a board, and
    for a Cartesian controller the tip, the base body, and the joints that are not moved.
    """

    file: str
    robot: str
    parked: tuple[Vector, ...]
    imu: str
    imu_at: Vector = (0.0, 0.0, 0.0)
    cameras: tuple[tuple[str, str, float], ...] = ()
    hands: tuple[tuple[str, str], ...] = ()


WORLDS = (
    RobotWorld(
        "nao_simulator/nao.xml",
        "nao_h25",
        parked=((0.4, 0.0, 0.55), (0.4, -0.3, 0.55)),
        imu="torso",
        imu_at=(-0.008, 0.006, 0.029),
        cameras=(("camera_top", "CameraTop", 47.6), ("camera_bottom", "CameraBottom", 47.6)),
        hands=(("LArm", "l_hand torso LHand"), ("RArm", "r_hand torso RHand")),
    ),
    RobotWorld(
        "icub_simulator/icub.xml",
        "icub_v2",
        parked=((0.7, 0.0, 0.9), (0.7, -0.4, 0.9)),
        imu="head",
        hands=(("left_arm", "l_hand root_link"), ("right_arm", "r_hand root_link")),
    ),
)


def text(world: RobotWorld) -> str:
    """The world as a file in MJCF."""
    robot = ROBOTS[world.robot]()
    spec = new_world()
    spec.modelname = world.robot
    _add_floor(spec)
    add_robot(spec, robot)
    _add_boards(spec, robot)
    for finger, parked in zip(FINGERS, world.parked, strict=True):
        _add_finger(spec, finger, parked)
    _add_sensors(spec, robot, world)
    for board, output in world.hands:
        spec.add_text(name=f"cartesian_{board}", data=output)
    return _compiled_text(spec, robot)


def robot_text(name: str) -> str:
    """The robot `name` alone as a file in MJCF: the model of its tactile description."""
    robot = ROBOTS[name]()
    spec = new_world()
    spec.modelname = name
    add_robot(spec, robot)
    return _compiled_text(spec, robot)


def _compiled_text(spec: Any, robot: RobotModel) -> str:
    key = spec.add_key(name="start")
    key.qpos = _start(spec.compile(), robot)
    spec.compile()
    return _NOTE + str(spec.to_xml())


def main(folder: Path = Path("components")) -> None:
    """Write all of them."""
    for name in ROBOTS:
        path = description_file(name).with_name(description(name).model)
        path.write_text(robot_text(name), "utf-8")
        sys.stdout.write(f"{path}\n")
    for world in WORLDS:
        path = folder / world.file
        path.parent.mkdir(parents=True, exist_ok=True)
        path.write_text(text(world), "utf-8")
        shutil.copyfile(description_file(world.robot), path.with_name(TACTILE))
        sys.stdout.write(f"{path}\n")


def _add_floor(spec: Any) -> None:
    spec.worldbody.add_light(pos=[0.5, 1.0, 3.0], dir=[-0.15, -0.3, -1.0])
    spec.worldbody.add_geom(
        name="floor",
        type=mujoco.mjtGeom.mjGEOM_PLANE,
        size=[3.0, 3.0, 0.1],
        rgba=[0.55, 0.6, 0.65, 1.0],
    )


def _add_finger(spec: Any, finger: str, parked: Vector) -> None:
    """Three slides in one body; the origin of each is the middle of the world."""
    body = spec.worldbody.add_body(name=finger, pos=parked, gravcomp=1.0)
    for i, axis in enumerate("xyz"):
        name = f"{finger}_{axis}"
        body.add_joint(
            name=name,
            type=mujoco.mjtJoint.mjJNT_SLIDE,
            axis=np.eye(3)[i],
            ref=parked[i],
            range=_RANGE[axis],
            limited=True,
            damping=[2.0, 0.0, 0.0],
        )
        spec.add_actuator(
            name=name,
            target=name,
            trntype=mujoco.mjtTrn.mjTRN_JOINT,
            ctrlrange=[-FORCE, FORCE],
            ctrllimited=True,
        )
        spec.add_numeric(name=f"speed_{name}", data=[_SPEED], size=1)
    body.add_geom(
        name=finger,
        type=mujoco.mjtGeom.mjGEOM_SPHERE,
        size=[RADIUS, 0.0, 0.0],
        mass=_MASS,
        rgba=[0.9, 0.3, 0.1, 1.0],
    )
    _add_board(spec, finger, [f"{finger}_{axis}" for axis in "xyz"])


def _add_boards(spec: Any, robot: RobotModel) -> None:
    for name in board_names(robot):
        board = robot_board(robot, name)
        _add_board(spec, name, board.joints)
        _add_matrix(spec, f"coupling_{name}", board.spec.coupling)
        if _add_matrix(spec, f"transmission_{name}", board.transmission):
            spec.add_text(name=f"joints_{name}", data=" ".join(board.spec.names))
            for actuated in board.spec.joints:
                if actuated.name not in board.joints:
                    numbers = np.round([actuated.low, actuated.high], 12)
                    spec.add_numeric(name=f"range_{actuated.name}", data=numbers, size=2)
    for joint in robot.motors:
        spec.add_numeric(name=f"speed_{joint.name}", data=[joint.speed], size=1)


def _add_matrix(spec: Any, name: str, matrix: Floats) -> bool:
    """Add the matrix row by row, unless it is the identity; returns whether it was added."""
    if np.allclose(matrix, np.eye(len(matrix))):
        return False
    numbers = np.round(matrix.ravel(), 12) + 0.0
    spec.add_numeric(name=name, data=numbers, size=len(numbers))
    return True


def _add_board(spec: Any, name: str, joints: Iterable[str]) -> None:
    names = list(joints)
    kinds = [mujoco.mjtObj.mjOBJ_JOINT] * len(names)
    spec.add_tuple(name=name, objtype=kinds, objname=names, objprm=[0.0] * len(names))


def _add_sensors(spec: Any, robot: RobotModel, world: RobotWorld) -> None:
    spec.body(world.imu).add_site(name="imu", pos=world.imu_at)
    for kind, name in (
        (mujoco.mjtSensor.mjSENS_GYRO, "imu_gyro"),
        (mujoco.mjtSensor.mjSENS_ACCELEROMETER, "imu_accelerometer"),
    ):
        site = mujoco.mjtObj.mjOBJ_SITE
        spec.add_sensor(name=name, type=kind, objtype=site, objname="imu")
    points = {name: (link, at) for link in robot.links for name, at in link.points.items()}
    for name, point, angle in world.cameras:
        link, at = points[point]
        pose = at @ _AHEAD
        spec.body(link.name).add_camera(
            name=name, pos=pose[:3, 3], quat=quaternion(pose), fovy=angle, resolution=[640, 480]
        )


def _start(model: Any, robot: RobotModel) -> Floats:
    """Positions of all joints, (nq,): the start pose, and the initial fingers."""
    qpos: Floats = model.qpos0.copy()
    for name, joint in robot.joints.items():
        qpos[model.joint(name).qposadr[0]] = robot.start.get(joint.leader or name, 0.0)
    return qpos


if __name__ == "__main__":
    main()
