"""Hands of model files behind `CartesianController`: goals in, poses out, refusals with reasons."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import numpy as np
import pytest

from robocomp_dsl.hardware.kinematics.cartesian_line import rotation_about
from robocomp_dsl.resources import INTERFACES
from robocomp_dsl.simulation.models.model_scene import describe
from tests.simulation.model_worlds import ARM
from tests.simulation.served_worlds import Served, served_model

COMPONENTS = Path(INTERFACES).parent / "components"
ROBOTS = {
    "nao": ("LArm", "l_hand", "torso", 5),
    "icub": ("right_arm", "r_hand", "root_link", 7),
}
BOTH = pytest.mark.parametrize("robot", ROBOTS)


def robot_of(folder: Path, robot: str) -> tuple[Served, Any, Any]:
    """The robot's world, its hand and the board of its arm."""
    text = (COMPONENTS / f"{robot}_simulator" / f"{robot}.xml").read_text("utf-8")
    result = served_model(folder, text)
    board = ROBOTS[robot][0]
    return result, result.ports[f"cartesian_{board}"], result.ports[board]


def true_pose(served: Served, robot: str) -> np.ndarray:
    """The hand in its base as MuJoCo tells it, (4, 4) in m."""
    _, tip, base, _ = ROBOTS[robot]
    data, found = served.simulation.world.data, []
    for frame in (data.body(base), data.site(tip)):
        pose = np.eye(4)
        pose[:3, :3], pose[:3, 3] = frame.xmat.reshape(3, 3), frame.xpos
        found.append(pose)
    return np.linalg.inv(found[0]) @ found[1]


def matrix(pose: Any) -> np.ndarray:
    result = np.eye(4)
    result[:3, :3] = rotation_about(pose.angle * np.array([pose.axisX, pose.axisY, pose.axisZ]))
    result[:3, 3] = pose.place.x, pose.place.y, pose.place.z
    return result


@BOTH
def test_cartesian_servant_poses_match_model(robot: str, tmp_path: Path) -> None:
    result, hand, _ = robot_of(tmp_path, robot)
    result.simulation.advance(0.2)
    assert len(hand.getJoints()) == ROBOTS[robot][3]
    assert matrix(hand.getPose()) == pytest.approx(true_pose(result, robot), abs=1e-5)
    state = hand.getState()
    assert (state.motion.name, state.time) == ("Idle", pytest.approx(0.2))


@BOTH
def test_cartesian_servant_reaches_solved_pose(robot: str, tmp_path: Path) -> None:
    result, hand, board = robot_of(tmp_path, robot)
    result.simulation.advance(0.2)
    i, start = result.types, hand.getPose()
    reachable = i.HandPlace(start.place.x - 0.02, start.place.y, start.place.z + 0.03)
    solved = hand.askForPosition(reachable)
    result.simulation.advance(0.2)
    assert matrix(hand.getPose()) == pytest.approx(matrix(start), abs=1e-3)  # nothing has moved
    assert solved.pose.place.z == pytest.approx(reachable.z, abs=1e-3)
    received = hand.goToPose(solved.pose, 0.8)
    assert received.joints == pytest.approx(hand.getDesired().joints)
    began = result.simulation.time
    assert not hand.checkMotionDone()
    result.advance_until(hand.checkMotionDone)
    assert result.simulation.time - began == pytest.approx(0.8, abs=0.15)
    result.simulation.advance(0.5)
    assert hand.getState().motion.name == "Reached"
    assert matrix(hand.getPose()) == pytest.approx(matrix(solved.pose), abs=5e-3)
    assert matrix(hand.getPose()) == pytest.approx(true_pose(result, robot), abs=1e-5)
    names = [getJoint.name for getJoint in board.getJoints()]
    at = [names.index(getJoint) for getJoint in hand.getJoints()]
    assert board.getState().position[at] == pytest.approx(received.joints, abs=0.02)


def test_unreachable_goal_reports_distance(tmp_path: Path) -> None:
    result, hand, _ = robot_of(tmp_path, "nao")
    i = result.types
    for ask in (hand.askForPosition, lambda place: hand.goToPosition(place, 0.0)):
        with pytest.raises(i.Unreachable, match="the nearest that it gets is") as received:
            ask(i.HandPlace(2.0, 0.0, 0.0))
        assert received.value.distance == pytest.approx(2.0 - 0.22, abs=0.1)
    assert hand.checkMotionDone()
    with pytest.raises(i.CartesianRefused, match="no goal has been set"):
        hand.getDesired()


@pytest.mark.parametrize(
    ("call", "values", "message"),
    [
        ("goToPosition", ("place", (np.nan, 0, 0), 0.0), "NaN"),
        ("goToPosition", ("place", (0.1, 0, 0), -1.0), "more than -1 s"),
        ("goToPose", ("pose", (0, 0, 0, 1.0), 0.0), "an axis that has a length"),
        ("goToPose", ("pose", (np.inf, 0, 0, 1.0), 0.0), "NaN or infinity"),
        ("setTrajTime", (0.0,), "must be above 0"),
        ("setInTargetTol", (0.001, -1.0), "must be above 0"),
        ("setDOF", ([True],), "5 joints need as many flags"),
        ("setDOF", ([False] * 5,), "one of them set"),
    ],
)
def test_cartesian_servant_refuses_invalid_arguments(
    call: str, values: Any, message: str, tmp_path: Path
) -> None:
    result, hand, _ = robot_of(tmp_path, "nao")
    i = result.types
    if values[0] == "place":
        values = (i.HandPlace(*values[1]), values[2])
    elif values[0] == "pose":
        values = (i.HandPose(i.HandPlace(0.1, 0.1, 0.1), *values[1]), values[2])
    with pytest.raises(i.CartesianRefused, match=message):
        getattr(hand, call)(*values)
    assert hand.getTrajTime() == 2.0
    assert hand.getInTargetTol() == pytest.approx((0.001, 0.01))


def test_cartesian_servant_keeps_fixed_joints(tmp_path: Path) -> None:
    result, hand, board = robot_of(tmp_path, "icub")
    result.simulation.advance(0.2)
    i = result.types
    free = [True] * 4 + [False] * 3
    hand.setDOF(free)
    assert hand.getDOF().tolist() == free
    hand.setTrajTime(0.6)
    hand.setInTargetTol(0.002, 0.02)
    before, at = board.getState().position.copy(), hand.getPose().place
    solved = hand.goToPosition(i.HandPlace(at.x, at.y + 0.02, at.z + 0.02), 0.0)
    with pytest.raises(i.CartesianRefused, match="on its way"):
        hand.setDOF([True] * 7)
    result.advance_until(hand.checkMotionDone)
    result.simulation.advance(0.3)
    after = board.getState().position
    assert np.abs(after - before)[4:].max() < 1e-3
    assert np.abs(after - before)[:4].max() > 0.02
    assert solved.joints[4:] == pytest.approx(before[4:], abs=1e-3)
    place = hand.getPose().place
    assert (place.y, place.z) == pytest.approx((at.y + 0.02, at.z + 0.02), abs=4e-3)


def test_cartesian_servant_motion_ends_on_stop_and_on_mode_change(tmp_path: Path) -> None:
    result, hand, board = robot_of(tmp_path, "nao")
    result.simulation.advance(0.2)
    i, at = result.types, hand.getPose().place
    goal = i.HandPlace(at.x - 0.03, at.y, at.z + 0.03)
    hand.goToPosition(goal, 2.0)
    result.simulation.advance(0.5)
    hand.stopControl()
    assert hand.checkMotionDone()
    assert hand.getState().motion.name == "Idle"
    hand.goToPosition(goal, 2.0)
    result.simulation.advance(0.3)
    board.setControlMode([], i.ControlMode.Position)
    result.simulation.advance(0.1)
    assert hand.getState().motion.name == "Interrupted"


LINKS = """\
<mujoco model="two">
  <worldbody>
    <body name="turret">
      <joint name="turn" axis="0 0 1" range="-90 90" damping="0.5" armature="0.2"/>
      <geom type="box" size="0.05 0.05 0.05" mass="1"/>
      <body name="a" pos="0 0 0.1">
        <joint name="q1" axis="0 0 1" range="-150 150" damping="0.2" armature="0.2"/>
        <geom type="capsule" fromto="0 0 0 0.3 0 0" size="0.02" mass="0.2"/>
        <body name="b" pos="0.3 0 0">
          <joint name="q2" axis="0 0 1" range="5 150" damping="0.2" armature="0.2"/>
          <geom type="capsule" fromto="0 0 0 0.3 0 0" size="0.02" mass="0.2"/>
          <site name="tip" pos="0.3 0 0"/>
        </body>
      </body>
    </body>
  </worldbody>
  <custom>
    <tuple name="arm">
      <element objtype="joint" objname="q2"/> <element objtype="joint" objname="q1"/>
    </tuple>
    <text name="cartesian_arm" data="TIP"/>
  </custom>
</mujoco>
"""


@pytest.mark.parametrize("tracking", [True, False])
def test_cartesian_servant_tracks_hand_while_other_joints_move(
    tracking: bool, tmp_path: Path
) -> None:
    result = served_model(tmp_path, LINKS.replace("TIP", "tip"))
    hand, rest, i = result.ports["cartesian_arm"], result.ports["ControlBoard"], result.types
    assert hand.getJoints() == ["q1", "q2"]
    hand.setTrackingMode(tracking)
    assert hand.getTrackingMode() is tracking
    hand.goToPosition(i.HandPlace(0.35, 0.1, 0.1), 0.5)
    result.advance_until(hand.checkMotionDone)
    rest.setReferenceSpeed(["turn"], np.array([0.3]))
    rest.positionMove(["turn"], np.array([0.4]))
    result.simulation.advance(0.1)
    result.advance_until(lambda: rest.motionDone(["turn"]).all())
    result.simulation.advance(1.0)
    place = hand.getPose().place
    away = np.hypot(place.x - 0.35, place.y - 0.1)
    assert (away < 5e-3) if tracking else (away > 0.1)


@pytest.mark.parametrize(
    ("message", "text"),
    [
        ("nowhere", "`cartesian_arm` names no body or site `nowhere`: it is left out"),
        ("tip world2", "names no body `world2`"),
        ("tip world q9", "names no joint `q9` of `arm`"),
        ("turret", "has no joints with limits that move `turret`"),
        (" ", "names no tip"),
    ],
)
def test_invalid_end_effector_is_reported(message: str, text: str, tmp_path: Path) -> None:
    path = tmp_path / "two.xml"
    path.write_text(LINKS.replace("TIP", message))
    (found,) = [
        finding
        for finding in describe(path, "model.xml").findings
        if "cartesian_" in finding.message
    ]
    assert text in found.message


def test_end_effector_without_board_is_reported(tmp_path: Path) -> None:
    text = ARM.replace("<custom>", '<custom><text name="cartesian_leg" data="wrist"/>')
    path = tmp_path / "arm.xml"
    path.write_text(text)
    received = [finding.message for finding in describe(path, "model.xml").findings]
    assert "`cartesian_leg` names no control board `leg`: it is left out" in received
