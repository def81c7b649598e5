"""Inertial units: what they feel at rest, in turns and when they are accelerated."""

from __future__ import annotations

import math
from pathlib import Path

import numpy as np
import pytest

from tests.simulation.served_worlds import Served, served

ROBOT = """\
<innerModel>
  <differentialrobot id="robot" ry="0.5">
    <transform id="deck" ty="300"><imu id="imu"/></transform>
    <rotation id="slope" rx="0.3"><imu id="tilted"/></rotation>
  </differentialrobot>
</innerModel>
"""
G = 9.81


NOISY = """\
<innerModel>
  <imu id="quiet"/>
  <imu id="rough" noise="0.5" gyronoise="0.02"/>
</innerModel>
"""


def readings(world: Served, port: str) -> np.ndarray:
    """200 measurements at 200 Hz: accelerations and rates of turning, shape (200, 6)."""
    result = []
    for _ in range(200):
        world.simulation.advance(0.005)
        received = world.ports[port].getDataImu()
        acc, gyro = received.acc, received.gyro
        result.append([acc.XAcc, acc.YAcc, acc.ZAcc, gyro.XGyr, gyro.YGyr, gyro.ZGyr])
    return np.array(result)


def test_imu_noise_is_as_declared(tmp_path: Path) -> None:
    world = served(tmp_path, NOISY)
    seen = readings(world, "rough")
    assert seen[:, :3].std(axis=0) == pytest.approx(0.5, rel=0.2)
    assert seen[:, 3:].std(axis=0) == pytest.approx(0.02, rel=0.2)
    assert seen.mean(axis=0) == pytest.approx([0, G, 0, 0, 0, 0], abs=0.15)
    assert readings(world, "quiet").std(axis=0) == pytest.approx(0, abs=1e-6)
    world.ports["Simulation"].setNoise(0.0)
    assert readings(world, "rough").std(axis=0) == pytest.approx(0, abs=1e-6)


def test_imu_noise_is_independent_of_readers(tmp_path: Path) -> None:
    reference, other = served(tmp_path, NOISY), served(tmp_path, NOISY)
    for world, asked in ((reference, 50), (other, 1)):
        for _ in range(asked):
            world.ports["rough"].getDataImu()
    assert (readings(reference, "rough") == readings(other, "rough")).all()


@pytest.fixture
def robot(tmp_path: Path) -> Served:
    result = served(tmp_path, ROBOT)
    result.simulation.advance(0.1)
    return result


def test_imu_at_rest_measures_gravity(robot: Served) -> None:
    acc = robot.ports["imu"].getAcceleration()
    assert (acc.XAcc, acc.YAcc, acc.ZAcc) == pytest.approx((0, G, 0), abs=1e-3)
    # its z axis points down by 0.3 rad or up: Rx(0.3) takes (0, 0, 1) to (0, -sin, cos)
    tilted = robot.ports["tilted"].getAcceleration()
    expected = (0, G * math.cos(0.3), -G * math.sin(0.3))
    assert (tilted.XAcc, tilted.YAcc, tilted.ZAcc) == pytest.approx(expected, abs=1e-3)


def test_imu_orientation_starts_at_reset(robot: Served) -> None:
    imu = robot.ports["imu"]
    assert imu.getOrientation().Yaw == pytest.approx(0.5, abs=1e-3)
    imu.resetImu()
    assert imu.getOrientation().Yaw == pytest.approx(0.0, abs=1e-6)
    robot.ports["robot"].setSpeedBase(0.0, 1.0)
    robot.simulation.advance(1.0)
    assert imu.getAngularVel().YGyr == pytest.approx(1.0, abs=0.01)
    turned = robot.ports["robot"].getBaseState().correctedAlpha - 0.5
    assert imu.getOrientation().Yaw == pytest.approx(turned, abs=1e-3)


def test_imu_measures_acceleration_and_turn_of_base(robot: Served) -> None:
    base, imu = robot.ports["robot"], robot.ports["imu"]
    base.setSpeedBase(800.0, 0.0)
    robot.simulation.advance(0.2)
    assert imu.getAcceleration().ZAcc == pytest.approx(2.0, abs=0.05)  # its ramp, in m/s²
    robot.simulation.advance(1.0)
    base.setSpeedBase(800.0, 1.0)
    robot.simulation.advance(1.0)
    # to the right at 0.8 m/s and 1 rad/s: the centre lies to the right
    assert imu.getAcceleration().XAcc == pytest.approx(0.8, abs=0.05)


def test_imu_magnetic_field_turns_against_base(robot: Served) -> None:
    before = robot.ports["imu"].getMagneticFields()
    assert math.hypot(before.XMag, before.YMag, before.ZMag) == pytest.approx(1.0, abs=1e-5)
    robot.ports["robot"].setSpeedBase(0.0, 1.0)
    robot.simulation.advance(1.0)
    after = robot.ports["imu"].getMagneticFields()
    turned = math.atan2(before.XMag, before.ZMag) - math.atan2(after.XMag, after.ZMag)
    yaw = robot.ports["imu"].getOrientation().Yaw - 0.5
    assert math.remainder(turned - yaw, math.tau) == pytest.approx(0.0, abs=0.01)
