"""The generic arm: readings in, orders out, in generic units and in space."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest

from robocomp_dsl.tactile.arm.generic_arm import PEAK, Control, GenericArm
from robocomp_dsl.tactile.description.model import GenericPart
from robocomp_dsl.tactile.description.read import read_robot
from robocomp_dsl.tactile.errors import InvalidCommand, NoChain, NoState, Unreachable

TEXT = """\
robot: five
parts:
  arm:
    servos:
      - {joint: a, gamma: -1, sigma: 90 deg, limits: [-2, 2], speed: 4}
      - {joint: b, gamma: 0.017453292519943295, sigma: 0, limits: [-20, 80], speed: 100, unit: deg}
      - {joint: c, part: other, gamma: 1, sigma: 90 deg, limits: [-2, 2], speed: 4}
      - {joint: d, gamma: -1, sigma: 0, limits: [-1.5, -0.03], start: -0.5, speed: 4}
      - {sigma: 0.2}
    chain:
      base: {position: [0, 0.1, 0.1], rpy: [-90 deg, 0, 0]}
      rows:
        - {servo: 0, alpha: 90 deg}
        - {servo: 1, a: 15 mm, alpha: 90 deg, offset: 90 deg}
        - {servo: 2, d: 105 mm, alpha: -90 deg}
        - {servo: 3, alpha: 90 deg}
        - {servo: 4, d: 114 mm, a: 12 mm, offset: -90 deg}
"""
PART = read_robot(TEXT, Path("r.yaml")).part("arm")
READING = np.array([1.2, 0.3, -1.0, -0.8])  # rad, whatever the unit of the device


@pytest.fixture
def arm() -> GenericArm:
    generic_arm = GenericArm(PART)
    generic_arm.update_state(
        1.0, READING, np.array([0.1, 0.2, 0.3, 0.4]), np.array([1.0, 2.0, 3.0, 4.0])
    )
    return generic_arm


def test_generic_arm_reads_generic_angles(arm):
    assert arm.state.position == pytest.approx([np.pi / 2 - 1.2, 0.3, np.pi / 2 - 1.0, 0.8, 0.2])
    assert arm.state.velocity == pytest.approx([-0.1, 0.2, 0.3, -0.4, 0])
    assert arm.state.torque == pytest.approx([-1, 2, 3, -4, 0])


def test_generic_arm_moves_existing_joints_in_si_units(arm):
    orders = arm.position_move(arm.state.position)
    assert orders.control is Control.POSITION
    assert orders.joints == ("a", "b", "other/c", "d")
    assert orders.values == pytest.approx(READING)
    assert orders.speeds == pytest.approx(np.array([4, np.deg2rad(100), 4, 4]) / PEAK)
    assert not orders.clipped.any()
    assert not orders.dropped.any()


def test_generic_arm_reports_clipped_slowed_and_dropped_moves(arm):
    orders = arm.position_move(np.array([9.0, 9, 0, 0.5, 1.0]), np.full(5, 0.5))
    assert orders.values[:2] == pytest.approx([-2.0, np.deg2rad(80)])
    assert orders.clipped.tolist() == [True, True, False, False, False]
    assert orders.dropped.tolist() == [False] * 4 + [True]
    assert orders.speeds == pytest.approx(np.full(4, 0.5))
    fast = arm.position_move(arm.state.position, np.full(5, 99.0))
    assert fast.speeds == pytest.approx(np.array([4, np.deg2rad(100), 4, 4]) / PEAK)


def test_generic_arm_displacements_start_at_current_position(arm):
    orders = arm.relative_move(np.array([0.1, -0.1, 0.2, 0.1, 0.0]))
    assert orders.values == pytest.approx(READING + np.array([-0.1, -0.1, 0.2, -0.1]))
    with pytest.raises(NoState):
        GenericArm(PART).relative_move(np.zeros(5))


def test_generic_arm_converts_velocities_torques_and_stiffness(arm):
    orders = arm.velocity_move(np.array([1.0, 9.0, -9.0, 1.0, 1.0]))
    assert orders.values == pytest.approx([-1, np.deg2rad(100), -4, -1])
    assert orders.clipped.tolist() == [False, True, True, False, False]
    assert orders.control is Control.VELOCITY
    assert orders.dropped.tolist() == [False] * 4 + [True]
    pushed = arm.set_torque(np.ones(5))
    assert pushed.control is Control.TORQUE
    assert pushed.values == pytest.approx([-1, 1, 1, -1])
    assert pushed.dropped.tolist() == [False] * 4 + [True]
    assert not arm.set_torque(np.array([1.0, 1, 1, 1, 0])).dropped.any()
    assert arm.set_position(np.full(5, 0.5)).dropped.tolist() == [False] * 4 + [True]
    stiffness, damping = arm.stiffness(np.full(5, 10.0), np.full(5, 1.0))
    assert stiffness == pytest.approx(np.full(4, 10.0))
    assert damping == pytest.approx(np.full(4, 1.0))
    assert arm.set_position(arm.state.position).control is Control.DIRECT


def test_generic_arm_solves_hand_poses_and_reports_unreachable_ones(arm):
    goal = arm.chain.pose(np.array([0.6, 0.4, 0.2, 1.0, 0.2]))
    orders = arm.reach(goal[:3, 3])
    generic = arm.mapping.read(orders.values / arm._to_si)
    assert arm.end_effector_pose(generic)[:3, 3] == pytest.approx(goal[:3, 3], abs=2e-4)
    with pytest.raises(Unreachable):
        arm.reach(np.array([3.0, 0, 0]))


@pytest.mark.parametrize("way", [(0.05, 0, 0), (0, 0.05, 0), (0, 0, -0.05)])
def test_generic_arm_moves_hand_along_line(arm, way):
    orders = arm.line_move(np.array(way))
    generic = np.zeros(5)
    generic[:4] = arm.mapping.read_speed(orders.values / arm._to_si)[:4]
    dt = 1e-4
    before, after = (
        arm.end_effector_pose(),
        arm.end_effector_pose(arm.state.position + generic * dt),
    )
    velocity = (after - before)[:3, 3] / dt
    assert velocity == pytest.approx(way, abs=0.006)


def test_generic_arm_line_motion_respects_limits_and_speeds(arm):
    fast = arm.line_move(np.array([50.0, 0, 0]))
    speeds = np.abs(arm.mapping.read_speed(fast.values / arm._to_si))
    assert speeds.max() <= arm.speed_limits.max() + 1e-9
    assert not fast.clipped.any()
    edge = np.array([2.0, np.deg2rad(80), 2.0, -0.03])
    arm.update_state(2.0, edge, np.zeros(4), np.zeros(4))
    for way in np.vstack((np.eye(3), -np.eye(3))):
        orders = arm.line_move(0.1 * way)
        speed = arm.mapping.read_speed(orders.values / arm._to_si)
        assert not ((arm.state.position >= arm.high - 1e-9) & (speed > 1e-9)).any()
        assert not ((arm.state.position <= arm.low + 1e-9) & (speed < -1e-9)).any()


def test_generic_arm_push_does_same_work_on_device(arm):
    """Power in generic units is power in those of the device, whatever gamma and unit are."""
    torque, velocity = np.array([0.3, -0.2, 0.5, 1.1, 0]), np.array([0.4, 0.3, -0.2, 0.1, 0])
    device = arm.set_torque(torque).values @ arm.velocity_move(velocity).values
    assert device == pytest.approx(torque @ velocity)


def test_generic_arm_refuses_invalid_stiffness(arm):
    with pytest.raises(InvalidCommand, match="must not be negative"):
        arm.stiffness(np.full(5, -1.0), np.ones(5))
    with pytest.raises(InvalidCommand, match="5 values are needed"):
        arm.stiffness(np.ones(4), np.ones(5))


def test_generic_arm_refuses_zero_speed_of_available_joints_only(arm):
    with pytest.raises(InvalidCommand, match="above 0"):
        arm.position_move(arm.state.position, np.array([1.0, 0, 1, 1, 1]))
    assert arm.position_move(arm.state.position, np.array([1.0, 1, 1, 1, 0])).speeds.shape == (4,)


@pytest.mark.parametrize(
    "rotation", [np.eye(3) * 1.1, np.diag([1.0, 1, -1]), np.full((3, 3), np.nan), np.eye(4)]
)
def test_generic_arm_refuses_invalid_rotation(arm, rotation):
    with pytest.raises(InvalidCommand, match="orthonormal"):
        arm.reach(arm.end_effector_pose()[:3, 3], rotation)


@pytest.mark.parametrize("bad", [np.full(5, np.nan), np.zeros(4), np.zeros((5, 1))])
def test_generic_arm_refuses_invalid_commands(arm, bad):
    for command in (
        arm.position_move,
        arm.relative_move,
        arm.set_position,
        arm.velocity_move,
        arm.set_torque,
    ):
        with pytest.raises(InvalidCommand):
            command(bad)
    for command in (arm.reach, arm.line_move):
        with pytest.raises(InvalidCommand):
            command(np.array([0.0, np.inf, 0.0]))


def test_generic_arm_without_chain_moves_but_has_no_poses():
    bare = GenericArm(GenericPart("arm", PART.servos))
    bare.update_state(0.0, READING, np.zeros(4), np.zeros(4))
    bare.position_move(bare.state.position)
    with pytest.raises(NoChain):
        bare.end_effector_pose()
