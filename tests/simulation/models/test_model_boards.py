"""Control boards of a model file."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest

from robocomp_dsl.cli.rcgen.simulation.view_subject import read_subject
from robocomp_dsl.diagnostics import Report
from tests.simulation.model_worlds import ARM, BOT, goal
from tests.simulation.served_worlds import Served, served_model


def test_model_starts_at_first_key_frame_and_holds_it(arm: Served) -> None:
    """Against gravity, with the file's own masses."""
    assert arm.ports["arm"].getState().position.tolist() == [-1.0, 0.5]
    arm.simulation.advance(2.0)
    assert np.abs(arm.ports["arm"].getState().position - (-1.0, 0.5)).max() < 0.01


def test_model_board_has_joints_of_tuple_in_order(arm: Served) -> None:
    assert [getJoint.name for getJoint in arm.ports["arm"].getJoints()] == ["elbow", "shoulder"]
    assert [getJoint.name for getJoint in arm.ports["ControlBoard"].getJoints()] == ["grip"]
    torque = [getJoint.torqueLimit for getJoint in arm.ports["arm"].getJoints()]
    assert torque == [12.0, 20.0]


def test_model_board_command_without_names_means_all_joints(arm: Served) -> None:
    board = arm.ports["arm"]
    board.setReferenceSpeed([], [2.0, 2.0])
    board.positionMove([], [-0.4, 0.1])
    assert not board.motionDone([]).any()
    assert arm.ports["ControlBoard"].motionDone([]).tolist() == [True]
    arm.advance_until(lambda: board.motionDone([]).all())
    arm.simulation.advance(0.3)
    assert np.abs(board.getState().position - (-0.4, 0.1)).max() < 0.01
    assert abs(arm.ports["ControlBoard"].getState().position[0] - 0.01) < 1e-3


def test_model_board_refuses_joints_of_another_board(arm: Served) -> None:
    board = arm.ports["arm"]
    with pytest.raises(arm.types.UnknownJoint, match="`grip` is not on `arm`: elbow, shoulder"):
        board.positionMove(["grip"], [0.02])
    with pytest.raises(arm.types.UnknownJoint):
        board.getPid(0, "grip")
    keys = board.getVariables()
    assert "pid.elbow" in keys
    assert "pid.grip" not in keys
    assert len(board.getVariable("speed_limits")) == 2
    board.setVariable("speed_limits", [1.0, 0.5])
    assert arm.ports["ControlBoard"].getVariable("speed_limits").tolist() == [1.0]


def test_model_joints_with_shared_motors_change_mode_together(tmp_path: Path) -> None:
    """And their motors turn as the file says."""
    text = ARM.replace("<custom>", '<custom><numeric name="coupling_arm" data="1 1 1 -1"/>')
    arm = served_model(tmp_path, text)
    board = arm.ports["arm"]
    assert [getJoint.coupledSet for getJoint in board.getJoints()] == [0, 0]
    before = board.getState().motorCounts
    board.setReferenceSpeed([], [2.0, 2.0])
    board.positionMove(["shoulder"], [0.9])
    arm.advance_until(lambda: board.motionDone([]).all())
    arm.simulation.advance(0.3)
    first, other = board.getState().motorCounts - before
    assert first == pytest.approx(-other, rel=0.01)
    assert abs(first) > 1000
    board.setControlMode(["shoulder"], arm.types.ControlMode.Velocity)
    assert set(board.getState().modes) == {arm.types.ControlMode.Velocity}
    assert arm.ports["ControlBoard"].getState().modes == [arm.types.ControlMode.Position]


def test_model_board_parks_without_moving_another_board(arm: Served) -> None:
    arm.ports["arm"].park([])
    assert arm.ports["arm"].isBusy()
    assert not arm.ports["ControlBoard"].isBusy()
    arm.ports["ControlBoard"].quit()
    assert arm.ports["arm"].isBusy()
    arm.ports["arm"].quit()
    assert not arm.ports["arm"].isBusy()


def test_model_joint_servant_has_all_joints_in_their_units(arm: Served) -> None:
    motors = arm.ports["JointMotor"]
    motors.setSyncPosition([goal(arm, "shoulder", 0.2, 2.0), goal(arm, "grip", 40.0)])
    arm.advance_until(
        lambda: not any(motor.isMoving for motor in motors.getAllMotorState().values())
    )
    state = motors.getAllMotorState()
    assert state["shoulder"].pos == pytest.approx(0.2, abs=0.01)
    assert state["grip"].pos == pytest.approx(40.0, abs=0.5)
    assert set(state) == {"elbow", "shoulder", "grip"}


def test_model_follower_joint_follows_and_free_joint_swings(arm: Served) -> None:
    data = arm.simulation.world.data
    data.joint("hinge").qvel = 1.0
    arm.ports["JointMotor"].setPosition(goal(arm, "grip", 40.0))
    arm.simulation.advance(2.0)
    data = arm.simulation.world.data
    assert data.joint("follower").qpos[0] == pytest.approx(0.04, abs=2e-3)
    assert data.joint("hinge").qpos[0] > 1.5


def test_model_board_torque_is_limited_by_file(arm: Served) -> None:
    """And the motor of the file, whatever it was, gives what the board asks for."""
    board = arm.ports["arm"]
    board.setControlMode(["elbow"], arm.types.ControlMode.Torque)
    assert board.setTorque(["elbow"], [99.0]).tolist() == [True]
    arm.simulation.advance(0.002)
    assert arm.simulation.world.data.joint("elbow").qfrc_actuator[0] == pytest.approx(12.0)


def test_model_from_urdf_moves(tmp_path: Path) -> None:
    bot = served_model(tmp_path, BOT, "bot.urdf")
    motors = bot.ports["JointMotor"]
    motors.setSyncPosition([goal(bot, "lift", 300.0), goal(bot, "turn", -1.0)])
    bot.advance_until(lambda: abs(motors.getMotorState("lift").pos - 300) < 1)
    bot.advance_until(lambda: abs(motors.getMotorState("turn").pos + 1) < 0.01)
    assert motors.getMotorParams("lift").maxVelocity == 250.0


def test_model_start_pose_matches_rcgen_view(tmp_path: Path) -> None:
    """And judges there what is in each other: at zero this file would be."""
    path, report = tmp_path / "arm.xml", Report()
    path.write_text(ARM.replace("-1 1 0 0 0", "1 1 0 0 0", 1).replace('pos="1 1 0"', 'pos="0 0 1"'))
    subject = read_subject(path, (), report)
    assert [finding.message for finding in report] == []
    assert subject is not None
    assert subject.data().joint("shoulder").qpos[0] == 0.5
