"""Denavit-Hartenberg chains, their generic form, Jacobians and inverse kinematics."""

from __future__ import annotations

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from robocomp_dsl.simulation.robots.catalog import description
from robocomp_dsl.tactile.arm.chain import Chain, DhLink, generic_chain, link
from robocomp_dsl.tactile.arm.generic_arm import GenericArm
from robocomp_dsl.tactile.arm.inverse import Solver, Tolerance, rotation_vector
from robocomp_dsl.tactile.errors import Unreachable

Q = np.pi / 2
ARM = Chain(  # five joints: shoulder with three crossing axes, elbow, forearm
    (
        DhLink(0, 0, Q, 0, 0),
        DhLink(0.015, 0, Q, Q, 1),
        DhLink(0, 0.105, -Q, 0, 2),
        DhLink(0, 0, Q, 0, 3),
        DhLink(0.012, 0.114, 0, -Q, 4),
    ),
    5,
    base=link(0, 0.1, -Q, 0),
)
LOW, HIGH = np.array([-2.0, -0.3, -2.0, -1.5, -1.8]), np.array([2.0, 1.3, 2.0, 0.0, 1.8])
angles = st.tuples(*(st.floats(a, b) for a, b in zip(LOW, HIGH, strict=True))).map(np.array)


def test_chain_of_planar_arm_matches_trigonometry():
    planar = Chain((DhLink(0.3, 0, 0, 0, 0), DhLink(0.2, 0, 0, 0, 1)), 2)
    angle, two = 0.4, -1.1
    expected = [
        0.3 * np.cos(angle) + 0.2 * np.cos(angle + two),
        0.3 * np.sin(angle) + 0.2 * np.sin(angle + two),
        0,
    ]
    assert planar.pose(np.array([angle, two]))[:3, 3] == pytest.approx(expected)


@given(angles)
def test_chain_jacobian_is_derivative(q):
    jacobian, step = ARM.jacobian(q), 1e-6
    for joint in range(5):
        move = np.eye(5)[joint] * step
        before, after = ARM.pose(q - move), ARM.pose(q + move)
        velocity = (after[:3, 3] - before[:3, 3]) / (2 * step)
        turned = rotation_vector(after[:3, :3] @ before[:3, :3].T) / (2 * step)
        assert jacobian[:3, joint] == pytest.approx(velocity, abs=1e-8)
        assert jacobian[3:, joint] == pytest.approx(turned, abs=1e-8)


@given(angles)
def test_chain_poses_are_within_reach(q):
    assert not ARM.is_out_of_reach(ARM.pose(q)[:3, 3])
    assert ARM.is_out_of_reach(ARM.base[:3, 3] + [0.0, 0.0, 0.25])  # 15 + 105 + 114.6 mm


@given(angles, st.integers(0, 31), st.integers(0, 31))
def test_generic_chain_matches_chain_of_arm(generic, signs, missing):
    gamma = np.array([1.0 if signs >> i & 1 else -1.0 for i in range(5)])
    available = np.array([not missing >> i & 1 for i in range(5)])
    sigma = np.array([Q, 0.1, -0.4, 0.0, 0.3])
    device = np.where(available, (generic - sigma) / gamma, 0.0)
    chain = generic_chain(ARM, gamma, sigma, available)
    assert chain.pose(generic) == pytest.approx(ARM.pose(device), abs=1e-12)
    dead = chain.jacobian(generic)[:, ~available]
    assert not dead.any()


def test_generic_chain_requires_radians():
    with pytest.raises(ValueError, match="gamma"):
        generic_chain(ARM, np.full(5, 0.0175), np.zeros(5), np.ones(5, bool))


@pytest.mark.parametrize("joints", [(0, 0), (0, 2), (-1, 0)])
def test_chain_refuses_invalid_joints(joints):
    with pytest.raises(ValueError, match="joint index"):
        Chain(tuple(DhLink(0, 0, 0, 0, joint) for joint in joints), 2)


@settings(max_examples=60)
@given(angles, angles)
def test_solver_finds_every_reachable_point_within_limits(goal, start):
    solution = Solver(ARM, LOW, HIGH).solve(ARM.pose(goal)[:3, 3], start)
    assert ARM.pose(solution)[:3, 3] == pytest.approx(ARM.pose(goal)[:3, 3], abs=1.1e-4)
    assert (solution >= LOW).all()
    assert (solution <= HIGH).all()


@settings(max_examples=40)
@given(angles)
def test_solver_finds_pose_from_nearby_start(goal):
    pose = ARM.pose(goal)
    start = np.clip(goal + 0.1, LOW, HIGH)
    solution = Solver(ARM, LOW, HIGH).solve(pose[:3, 3], start, pose[:3, :3])
    assert rotation_vector(ARM.pose(solution)[:3, :3] @ pose[:3, :3].T) == pytest.approx(
        np.zeros(3), abs=1.1e-3
    )


def test_solver_reports_distance_of_unreachable_goal():
    with pytest.raises(Unreachable) as caught:
        Solver(ARM, LOW, HIGH, Tolerance(iterations=60)).solve(np.array([1.0, 0, 0]), np.zeros(5))
    reach = 0.22
    assert caught.value.distance == pytest.approx(1.0 - reach, abs=0.02)


def test_solver_is_deterministic():
    goal = ARM.pose(np.full(5, -0.2))[:3, 3]
    solver = Solver(ARM, LOW, HIGH)
    assert (solver.solve(goal, np.zeros(5)) == solver.solve(goal, np.zeros(5))).all()


def rotation_about(axis, angle):
    axis = np.asarray(axis, float) / np.linalg.norm(axis)
    cross = np.cross(np.eye(3), axis)
    return np.eye(3) + np.sin(angle) * cross + (1 - np.cos(angle)) * cross @ cross


@pytest.mark.parametrize("axis", [(1, 0, 0), (0, -1, 0), (1, 2, 3), (-1, 1, 0.2)])
@pytest.mark.parametrize("angle", [0.0, 1e-9, 0.5, 3.0, np.pi - 1e-9])
def test_rotation_vector_round_trips(axis, angle):
    expected = angle * np.asarray(axis) / np.linalg.norm(axis)
    assert rotation_vector(rotation_about(axis, angle)) == pytest.approx(expected, abs=1e-6) or (
        angle > 3.1
        and rotation_vector(rotation_about(axis, angle)) == pytest.approx(-expected, abs=1e-6)
    )


@pytest.mark.parametrize("side", ["left_arm", "right_arm"])
@pytest.mark.parametrize("robot", ["nao_h21", "nao_h25", "icub_v2"])
def test_solver_finds_goals_with_joints_at_limits(robot, side):
    """Half of the joints stand at one of their limits: the others have to make up for them."""
    arm = GenericArm(description(robot).part(side))
    solver, random = Solver(arm.chain, arm.low, arm.high), np.random.default_rng(3)
    missed = 0
    for _ in range(50):
        share, at_limit = random.uniform(size=5), random.uniform(size=5) < 0.5
        angles = arm.low + np.where(at_limit, share.round(), share) * (arm.high - arm.low)
        target = arm.chain.pose(angles)
        for rotation in (None, target[:3, :3]):
            try:
                solution = solver.solve(target[:3, 3], arm.part.start, rotation)
            except Unreachable:
                missed += 1
                continue
            assert (solution >= arm.low).all()
            assert (solution <= arm.high).all()
            assert arm.chain.pose(solution)[:3, 3] == pytest.approx(target[:3, 3], abs=1e-4)
    assert missed <= 1
