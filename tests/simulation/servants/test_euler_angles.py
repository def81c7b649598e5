"""A robot that turns on the spot reads one angle from -π to π; the other two stay at 0."""

from __future__ import annotations

import math
from collections.abc import Sequence
from pathlib import Path
from typing import Any

import mujoco
import numpy as np
import pytest

from robocomp_dsl.hardware.devices.full_pose import FloorPose
from robocomp_dsl.hardware.kinematics.rotations import pose_rows
from robocomp_dsl.simulation.view.nodes import quaternion, roll_pitch_yaw
from tests.simulation.served_worlds import Served, served

WORLD = """\
<innerModel>
  <transform id="world">
    <differentialrobot id="robot"><imu id="robot_imu"/></differentialrobot>
    <transform id="gimbal" tx="3000">
      <imu id="gimbal_imu"/>
      <transform id="tool" ty="50"/>
    </transform>
    <joint id="disc" axis="y" tx="6000" min="-10" max="10"/>
  </transform>
</innerModel>
"""
DEGREES = range(-175, 180, 5)
NAMES = ("rx", "ry", "rz")


@pytest.fixture
def world(tmp_path: Path) -> Served:
    return served(tmp_path, WORLD)


def turn_about(axis: int, degrees: float) -> list[float]:
    turn = [0.0, 0.0, 0.0]
    turn[axis] = math.radians(degrees)
    return turn


def euler(pose: Any) -> list[float]:
    return [getattr(pose, name) for name in NAMES]


def of_imu(orientation: Any) -> list[float]:
    """In the order of the axes: pitch is about x, yaw about y, roll about z."""
    return [orientation.Pitch, orientation.Yaw, orientation.Roll]


@pytest.mark.parametrize("axis", range(3), ids="xyz")
def test_imu_and_nodes_read_turn_about_one_axis(world: Served, axis: int) -> None:
    nodes, imu = world.ports["InnerModelManager"], world.ports["gimbal_imu"]
    for degrees in DEGREES:
        turn = turn_about(axis, degrees)
        nodes.setPose("root", "gimbal", world.types.Pose3D(3000, 0, 0, *turn))
        assert of_imu(imu.getOrientation()) == pytest.approx(turn, abs=1e-9), degrees
        assert euler(nodes.getPose("world", "tool")[1]) == pytest.approx(turn, abs=1e-9), degrees
        assert euler(nodes.getPoseFromParent("gimbal")[1]) == pytest.approx(turn, abs=1e-9)
        poses = world.ports["Simulation"].getPoses(0, ["tool"])
        assert euler(poses[0]) == pytest.approx(turn, abs=1e-9)


@pytest.mark.parametrize("axis", range(3), ids="xyz")
def test_full_pose_estimation_reads_turn_about_one_axis(world: Served, axis: int) -> None:
    nodes, port = world.ports["InnerModelManager"], world.ports["robot_pose"]
    for degrees in DEGREES:
        turn = turn_about(axis, degrees)
        nodes.setPose("world", "robot", world.types.Pose3D(0, 0, 0, *turn))
        assert euler(port.getFullPoseEuler()) == pytest.approx(turn, abs=1e-9), degrees


def test_robot_that_drives_full_circle_reads_one_angle(world: Served) -> None:
    """What the wheels do, as a robot's user sees it: the angle wraps once and never jumps."""
    imu, pose = world.ports["robot_imu"], world.ports["robot_pose"]
    world.ports["robot"].setSpeedBase(0.0, 1.0)
    read: list[float] = []
    while world.simulation.world.time < math.tau + 1:
        world.simulation.advance(0.05)
        rx, ry, rz = euler(pose.getFullPoseEuler())
        assert (rx, rz) == pytest.approx((0, 0), abs=1e-6)
        assert of_imu(imu.getOrientation()) == pytest.approx([rx, ry, rz], abs=1e-6)
        base = world.ports["robot"].getBaseState()
        assert ry == pytest.approx(base.correctedAlpha, abs=1e-6)
        read.append(ry)
    steps = np.diff(np.unwrap(read))
    assert (steps >= 0).all()
    assert steps.max() < 0.06
    assert (min(read), max(read)) == pytest.approx((-math.pi, math.pi), abs=0.06)


def test_set_pose_turns_joint_beyond_right_angle(world: Served) -> None:
    nodes, motors = world.ports["InnerModelManager"], world.ports["JointMotor"]
    for angle in (1.0, 2.0, -2.5, 4.0):
        pose = world.types.Pose3D(6000, 0, 0, 0, angle, 0)
        nodes.setPoseFromParent("disc", pose)
        assert motors.getMotorState("disc").pos == pytest.approx(angle, abs=1e-9)
    nodes.setPose("root", "disc", world.types.Pose3D(6000, 0, 0, 0, 2.0, 0))
    assert motors.getMotorState("disc").pos == pytest.approx(2.0, abs=1e-9)


def test_floor_pose_takes_heading_of_whole_circle() -> None:
    class Base:
        alpha = 0.0

        def correct(self, pose: Any) -> None:
            self.alpha = pose.alpha

    base = Base()
    for degrees in DEGREES:
        matrix = np.eye(4)
        matrix[:3] = pose_rows((0, 0, 0, 0, math.radians(degrees), 0))
        FloorPose(base).set_full_pose(matrix)  # type: ignore[arg-type]
        assert base.alpha == pytest.approx(math.radians(degrees))


@pytest.mark.parametrize("axis", range(3), ids="xyz")
def test_roll_pitch_yaw_of_turn_about_one_axis(axis: int) -> None:
    for degrees in DEGREES:
        turn = turn_about(axis, degrees)
        assert roll_pitch_yaw(quaternion(turn)) == pytest.approx(turn, abs=1e-9), degrees


def test_roll_pitch_yaw_reproduces_random_rotations() -> None:
    random = np.random.default_rng(4)
    for _ in range(500):
        quat = random.standard_normal(4)
        quat /= np.linalg.norm(quat)
        again = quaternion(roll_pitch_yaw(quat))
        assert abs(np.dot(quat, again)) == pytest.approx(1, abs=1e-12)


def test_roll_pitch_yaw_is_about_fixed_axes() -> None:
    """As of URDF: Rz(yaw) · Ry(pitch) · Rx(roll)."""
    parts = [quaternion(turn) for turn in ((0.3, 0, 0), (0, 0.4, 0), (0, 0, 0.5))]
    product = _times(parts[2], _times(parts[1], parts[0]))
    assert roll_pitch_yaw(product) == pytest.approx((0.3, 0.4, 0.5))


def _times(first: Sequence[float], second: Sequence[float]) -> Any:
    product = np.zeros(4)
    mujoco.mju_mulQuat(product, np.array(first), np.array(second))
    return product
