"""What a base serves beside its own interface, and what it and a laser publish."""

from __future__ import annotations

import math
from pathlib import Path
from types import SimpleNamespace

import numpy as np
import pytest

from robocomp_dsl.hardware.devices.errors import CommandRefused
from robocomp_dsl.hardware.devices.full_pose import FloorPose
from robocomp_dsl.hardware.kinematics.rotations import pose_rows
from tests.simulation.served_worlds import Served, served

WORLD = """\
<innerModel>
  <transform id="hill" ty="250">
    <differentialrobot id="robot" tx="400" tz="-300" ry="0.5">
      <laser id="laser" measures="11" max="4000" angle="1"/>
    </differentialrobot>
  </transform>
  <omnirobot id="platform" tx="-5000"/>
</innerModel>
"""


@pytest.fixture
def world(tmp_path: Path) -> Served:
    world_served = served(tmp_path, WORLD)
    world_served.simulation.advance(0.1)
    return world_served


@pytest.mark.parametrize("name", ["robot", "platform"])
def test_generic_base_servant_matches_base_state(world: Served, name: str) -> None:
    world.ports[name].setSpeedBase(*((300.0, 0.4) if name == "robot" else (100.0, 300.0, 0.4)))
    world.simulation.advance(1.0)
    generic, own = world.ports[f"{name}_base"], world.ports[name]
    assert generic.getBasePose() == own.getBasePose()
    received, state = generic.getBaseState(), own.getBaseState()
    assert received.isMoving
    assert all(getattr(received, name) == getattr(state, name) for name, _ in type(state)._fields_)


def test_base_servant_full_pose_and_speeds_are_true(world: Served) -> None:
    pose = world.ports["robot_pose"].getFullPoseEuler()
    assert (pose.x, pose.y, pose.z) == pytest.approx((400, 250, -300), abs=1e-3)
    assert (pose.rx, pose.ry, pose.rz) == pytest.approx((0, 0.5, 0), abs=1e-6)
    assert (pose.source, pose.confidence) == ("robot", 100)
    world.ports["robot"].setSpeedBase(500.0, 0.8)
    world.simulation.advance(2.0)
    before = world.ports["robot_pose"].getFullPoseEuler()
    world.simulation.advance(0.02)
    after = world.ports["robot_pose"].getFullPoseEuler()
    state = world.ports["robot"].getBaseState()
    assert (after.x, after.z) == pytest.approx((state.correctedX, state.correctedZ), abs=1e-3)
    assert (after.adv, after.side) == pytest.approx((500, state.advVx), abs=1.0)
    assert after.rot == pytest.approx(0.8, abs=0.01)
    # speeds and accelerations are the derivatives of what they are called after
    speed = ((after.x - before.x) / 0.02, (after.z - before.z) / 0.02)
    assert speed == pytest.approx(((after.vx + before.vx) / 2, (after.vz + before.vz) / 2), abs=1)
    gain = ((after.vx - before.vx) / 0.02, (after.vz - before.vz) / 0.02)
    assert gain == pytest.approx(((after.ax + before.ax) / 2, (after.az + before.az) / 2), abs=5)
    assert math.hypot(after.ax, after.az) == pytest.approx(400, abs=5)  # v · ω
    assert (after.vy, after.ay, after.vry) == pytest.approx((0, 0, 0.8), abs=0.01)


def test_base_servant_matrix_is_pose(world: Served) -> None:
    port = world.ports["robot_pose"]
    euler, it = port.getFullPoseEuler(), port.getFullPoseMatrix()
    rows = pose_rows((euler.x, euler.y, euler.z, euler.rx, euler.ry, euler.rz))
    received = [[getattr(it, f"m{i}{j}") for j in range(4)] for i in range(4)]
    assert np.allclose(received, [*rows, (0, 0, 0, 1)], atol=1e-3)


def test_base_servant_initial_pose_turns_reported_frame(world: Served) -> None:
    port = world.ports["robot_pose"]
    port.setInitialPose(10, 20, 30, 0, 0, 0)
    pose = port.getFullPoseEuler()
    assert (pose.x, pose.y, pose.z, pose.ry) == pytest.approx((10, 20, 30, 0), abs=1e-3)
    world.ports["robot"].setSpeedBase(500.0, 0.0)
    world.simulation.advance(1.0)
    pose = port.getFullPoseEuler()
    assert (pose.x, pose.vx) == pytest.approx((10, 0), abs=1.0)  # ahead is z again
    assert pose.vz == pytest.approx(500, abs=1.0)
    assert pose.z > 300
    with pytest.raises(CommandRefused):
        port.setInitialPose(math.nan, 0, 0, 0, 0, 0)


def test_laser_scan_is_published_once(world: Served) -> None:
    port = world.ports["laser"]
    ((scan,),) = port.poll()
    assert len(scan) == 11
    assert port.poll() == []
    world.simulation.advance(0.06)  # it scans 20 times a second
    assert len(port.poll()) == 1


def test_base_servant_state_contains_time(world: Served) -> None:
    ((state, time),) = world.ports["robot"].poll()
    assert time == pytest.approx(0.1)
    assert state.correctedX == pytest.approx(400, abs=1)


def test_laser_servant_reports_configuration(world: Served) -> None:
    it = world.ports["laser"].getLaserConfData()
    assert (it.device, it.maxMeasures, it.minRange, it.maxRange) == ("laser", 11, 0, 4000)
    assert (it.maxDegrees, it.iniRange, it.endRange, it.sampleRate) == (58, -29, 29, 50)
    assert (it.angleRes, it.angleIni) == pytest.approx((5.7296, -28.648), abs=1e-3)


def test_base_servant_of_planar_base_has_full_pose(world: Served) -> None:
    base = world.simulation.devices["platform"]
    base.set_speed(100.0, 300.0, 0.4)
    world.simulation.advance(1.5)
    flat, full = FloorPose(base).full_pose(), base.full_pose()
    world.simulation.devices["platform"] = SimpleNamespace(state=base.state)  # as drivers are
    received = world.ports["platform_pose"].getFullPoseEuler()
    assert (received.x, received.ry) == pytest.approx(
        (flat.matrix[0, 3], base.state().corrected.alpha)
    )
    assert np.allclose(flat.matrix, full.matrix, atol=1e-6)
    assert flat.velocity == pytest.approx(full.velocity, abs=1.0)
    assert flat.angular_velocity == pytest.approx(full.angular_velocity, abs=1e-3)
    moved = np.eye(4)
    moved[:3] = pose_rows((1.0, 0.0, 2.0, 0.0, 0.3, 0.0))
    FloorPose(base).set_full_pose(moved)
    corrected = base.state().corrected
    assert (corrected.x, corrected.z, corrected.alpha) == pytest.approx((1, 2, 0.3), abs=1e-6)
