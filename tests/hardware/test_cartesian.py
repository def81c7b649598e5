"""Inverse kinematics of the robots' arms, and the controller that takes their hands to poses."""

from __future__ import annotations

import math

import mujoco
import numpy as np
import pytest

from robocomp_dsl.hardware.control.errors import ModeRefused
from robocomp_dsl.hardware.control.modes import Mode
from robocomp_dsl.hardware.control.protection.faults import FaultCode
from robocomp_dsl.hardware.devices.errors import CommandRefused, SceneError
from robocomp_dsl.hardware.kinematics.cartesian import goal_of, solve, step
from robocomp_dsl.hardware.kinematics.cartesian_controller import (
    CartesianController,
    CartesianState,
    UnreachableGoal,
)
from robocomp_dsl.simulation.devices.control_board_chain import extract_chain
from robocomp_dsl.simulation.scene import axes
from robocomp_dsl.tactile.arm.inverse import Goal, rotation_vector
from tests.support.simulated_arm import Arm

ARMS = {"nao": (5, "l_hand"), "icub": (7, "r_hand")}


class Hand:
    """An arm, its chain and its controller.

    The NAO's hand opens about an axis that turns the site in it: a joint beside the chain.
    """

    def __init__(self, name: str) -> None:
        self.arm = Arm(name)
        count, self.tip = ARMS[name]
        self.joints = self.arm.spec.names[:count]
        self.chain = extract_chain(self.arm.world.model, self.joints, self.tip)
        self.controller = CartesianController(self.arm.board, self.chain, self.joints)
        self.arm.command.set_mode(None, Mode.POSITION)
        self.arm.settings.set_reference_speed(None, 1.0)
        self.arm.go(None, self.arm.inside)
        self.controller.pose()  # tells the chain where joints beside it are

    def some_pose(self, random: np.random.Generator) -> np.ndarray:
        span = self.chain.high - self.chain.low
        share = 0.1 + 0.8 * random.random(len(span))
        return self.chain.pose(self.chain.low + span * share)

    def true_pose(self) -> np.ndarray:
        """As MuJoCo tells it."""
        site = self.arm.world.data.site(self.tip)
        return axes.matrix(site.xpos, site.xmat)

    def wait(self, seconds: float = 20.0) -> None:
        assert self.arm.wait(lambda: self.controller.state is not CartesianState.MOVING, seconds), (
            self.controller.state
        )


@pytest.fixture(params=ARMS)
def hand(request) -> Hand:
    return Hand(request.param)


def test_cartesian_chain_poses_match_mujoco(hand):
    random = np.random.default_rng(1)
    world = hand.arm.world
    for k in range(10):
        for joint in hand.chain.held:
            hand.chain.fix_joint(joint, 0.05 * k)
            world.data.joint(joint).qpos[0] = 0.05 * k
        pose = hand.some_pose(random)
        for joint, frame in zip(hand.joints, hand.chain.joints, strict=True):
            world.data.joint(joint).qpos[0] = hand.chain.tree.joint(frame)
        mujoco.mj_forward(world.model, world.data)
        assert pose == pytest.approx(hand.true_pose(), abs=1e-9)


def test_inverse_kinematics_solves_every_pose_of_arm(hand):
    random = np.random.default_rng(3)
    chain = hand.chain
    for _ in range(25):
        pose = hand.some_pose(random)
        for goal in (pose, pose[:3, 3]):
            found = solve(chain, goal_of(goal), chain.rest)
            assert found.within(0.1, 0.002)
            assert (found.q >= chain.low).all()
            assert (found.q <= chain.high).all()
            back = chain.pose(found.q)
            assert np.linalg.norm(back[:3, 3] - pose[:3, 3]) <= 0.1
            again = solve(chain, goal_of(goal), chain.rest)
            assert (again.q == found.q).all()


def test_cartesian_controller_reaches_poses_within_tolerance(hand):
    """Simple-p2p and reaching-tolerance of icub-tests: there and back, by what MuJoCo says."""
    random = np.random.default_rng(5)
    goals = [hand.some_pose(random) for _ in range(3)]
    for goal in (*goals, *reversed(goals)):
        hand.controller.go_to(goal, 1.5)
        hand.wait()
        assert hand.controller.state is CartesianState.REACHED
        hand.arm.world.advance(1.0)
        there = hand.true_pose()
        assert np.linalg.norm(there[:3, 3] - goal[:3, 3]) < 2.0  # mm
        assert np.linalg.norm(rotation_vector(goal[:3, :3] @ there[:3, :3].T)) < 0.02
        assert hand.controller.pose() == pytest.approx(there, abs=1e-6)


def test_cartesian_controller_moves_hand_on_straight_line(hand):
    start = hand.controller.pose()[:3, 3]
    low, rest = hand.chain.low, hand.chain.rest
    away = next(  # the first posture on the way to the lower limits that is 40 mm from here
        place
        for share in np.linspace(0.0, 1.0, 101)
        if np.linalg.norm((place := hand.chain.pose(rest + share * (low - rest))[:3, 3]) - start)
        > 40.0
    )
    along = (away - start) / np.linalg.norm(away - start)
    hand.controller.go_to(away, 2.0)
    off, last = 0.0, 0.0
    while hand.controller.state is CartesianState.MOVING:
        hand.arm.world.advance(0.02)
        way = hand.true_pose()[:3, 3] - start
        off = max(off, float(np.linalg.norm(way - (way @ along) * along)))
        assert way @ along > last - 0.5  # never back
        last = way @ along
    assert last == pytest.approx(np.linalg.norm(away - start), abs=3.0)
    assert off < 4.0  # a tenth of the way


def test_inverse_kinematics_draws_free_joints_to_rest(hand):
    """A place takes three of the joints' freedoms; the others bring the arm near its rest."""
    chain = hand.chain
    place = chain.pose(chain.rest)[:3, 3] + 5.0
    far = chain.low + 0.8 * (chain.high - chain.low)
    found = solve(chain, goal_of(place), far)
    assert found.within(0.1, 0.002)
    assert np.linalg.norm(found.q - chain.rest) < 0.9 * np.linalg.norm(far - chain.rest)


def test_inverse_kinematics_steps_respect_limits_and_are_bounded_near_singularity(hand):
    chain = hand.chain
    for q in (chain.low, chain.high, np.clip(np.zeros(len(chain.low)), chain.low, chain.high)):
        pose = chain.pose(q)
        for way in (*np.eye(3), *-np.eye(3)):
            goal = Goal(pose[:3, 3] + 300.0 * way, pose[:3, :3])
            result = step(chain, q, goal, np.zeros(len(q)), 1e-2)
            assert (q + result >= chain.low - 1e-12).all()
            assert (q + result <= chain.high + 1e-12).all()
            assert np.abs(result).max() < 31.0  # |error| over twice the root of the damping


def test_cartesian_controller_refuses_unreachable_goal_with_nearest_pose(hand):
    before = hand.arm.board.table.modes[:]
    with pytest.raises(UnreachableGoal, match=r"nearest that it gets is \d+\.\d mm"):
        hand.controller.go_to([2000.0, 0.0, 0.0])
    assert hand.arm.board.table.modes == before
    assert hand.controller.state is CartesianState.IDLE
    nearest = hand.controller.nearest([2000.0, 0.0, 0.0])
    assert nearest.distance > 1000.0


HALF_TURNED = np.diag([1.0, 1.0, -1.0, 1.0])


@pytest.mark.parametrize(
    ("goal", "message"),
    [
        ([np.nan, 0, 0], "NaN"),
        ([0, 0], "shape"),
        ("here", "numbers"),
        (np.zeros((4, 4)), "rotation"),
        (HALF_TURNED, "rotation"),
    ],
)
def test_cartesian_controller_refuses_invalid_goals(goal, message):
    hand = Hand("nao")
    with pytest.raises(CommandRefused, match=message):
        hand.controller.go_to(goal)
    for seconds in (0.0, -1.0, math.nan):
        with pytest.raises(CommandRefused):
            hand.controller.go_to(hand.true_pose(), seconds)


def test_cartesian_controller_is_interrupted_by_mode_change(hand):
    goal = hand.some_pose(np.random.default_rng(8))
    hand.controller.go_to(goal, 3.0)
    hand.arm.world.advance(0.5)
    hand.arm.command.set_mode([3], Mode.POSITION)
    hand.arm.world.advance(0.1)
    assert hand.controller.state is CartesianState.INTERRUPTED
    hand.controller.go_to(goal, 1.0)
    hand.arm.board.fault(np.array([0]), FaultCode.EXTERNAL, "test")
    hand.arm.world.advance(0.1)
    assert hand.controller.state is CartesianState.INTERRUPTED
    with pytest.raises(ModeRefused):
        hand.controller.go_to(goal, 1.0)


def test_cartesian_controller_stop_holds_hand(hand):
    hand.controller.go_to(hand.some_pose(np.random.default_rng(9)), 3.0)
    hand.arm.world.advance(1.0)
    hand.controller.stop()
    assert hand.controller.state is CartesianState.IDLE
    hand.arm.world.advance(0.5)
    here = hand.true_pose()
    hand.arm.world.advance(0.5)
    assert hand.true_pose() == pytest.approx(here, abs=0.5)


@pytest.mark.parametrize("angle", [0.0, 1e-12, 0.3, 3.0, math.pi - 1e-10, math.pi])
@pytest.mark.parametrize("axis", [(1, 0, 0), (0, 1, 0), (0.6, 0, -0.8)])
def test_rotation_vectors_have_axis_and_angle(axis, angle):
    x, y, z = axis
    cross = np.array([[0, -z, y], [z, 0, -x], [-y, x, 0]])
    turn = np.eye(3) + math.sin(angle) * cross + (1 - math.cos(angle)) * cross @ cross
    found = rotation_vector(turn)
    if angle < 3.1:
        assert found == pytest.approx(angle * np.array(axis), abs=1e-9)
    else:  # both ways round are a half turn
        assert np.linalg.norm(found) == pytest.approx(math.pi, abs=1e-7)
        assert abs(found @ axis) == pytest.approx(math.pi, abs=1e-6)


def test_cartesian_chain_refuses_invalid_joints():
    model = Arm("nao").world.model
    for joints, tip, message in (
        (("LElbowRoll",), "tail", "no body or site `tail`"),
        (("Tail",), "l_hand", "no joint `Tail`"),
        (("LHand",), "LBicep", "does not move"),
    ):
        with pytest.raises(SceneError, match=message):
            extract_chain(model, joints, tip)
