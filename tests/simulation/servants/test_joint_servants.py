"""Joints of a world behind `JointMotor` and `ControlBoard`: motions are those of the physics."""

from __future__ import annotations

import math
from pathlib import Path

import numpy as np
import pytest

from robocomp_dsl.simulation.scene import axes
from tests.simulation.served_worlds import Served, served

ARM = """\
<innerModel>
  <transform id="stand" ty="1000">
    <joint id="shoulder" axis="z" min="-1.5" max="1.5" home="0.2">
      <motor id="m1" force="30" velocity="3"/>
      <translation id="upper" tx="300" mass="1.5">
        <joint id="elbow" axis="z" min="-2" max="2">
          <translation id="hand" tx="200" mass="0.5"/>
        </joint>
      </translation>
    </joint>
    <prismaticjoint id="lift" axis="y" min="0" max="400" position="50" home="100"/>
  </transform>
</innerModel>
"""


@pytest.fixture
def arm(tmp_path: Path) -> Served:
    return served(tmp_path, ARM)


def test_joint_holds_its_place_from_the_start(arm: Served) -> None:
    arm.simulation.advance(1.0)
    state = arm.ports["ControlBoard"].getState()
    assert np.abs(state.position - [0.2, 0, 0.05]).max() < 1e-6
    assert {mode.name for mode in state.modes} == {"Position"}


def test_joint_servant_reaches_position_at_commanded_speed(arm: Served) -> None:
    motors, i = arm.ports["JointMotor"], arm.types
    motors.setPosition(i.MotorGoalPosition("shoulder", 0.8, 0.5))
    fastest = 0.0

    def done() -> bool:
        nonlocal fastest
        state = motors.getMotorState("shoulder")
        fastest = max(fastest, state.vel)
        return not state.isMoving

    arm.simulation.advance(0.1)
    arm.advance_until(done)
    assert 0.45 < fastest < 0.52
    assert motors.getMotorState("shoulder").pos == pytest.approx(0.8, abs=2e-3)
    hand = where(arm, "hand")  # x to the right, y up: the arm of 300 and 200 mm has turned by 0.8
    assert hand == pytest.approx([500 * math.cos(0.8), 1000 + 500 * math.sin(0.8), 0], abs=2)


def test_joint_servant_of_slide_uses_millimetres(arm: Served) -> None:
    motors, i = arm.ports["JointMotor"], arm.types
    motors.setSyncPosition([i.MotorGoalPosition("lift", 300, 0)])
    arm.simulation.advance(0.05)
    arm.advance_until(lambda: not motors.getMotorState("lift").isMoving)
    assert where(arm, "lift") == pytest.approx([0, 1300, 0], abs=1)
    assert motors.getMotorState("lift").pos == pytest.approx(300, abs=1)
    params = motors.getMotorParams("lift")
    assert (params.minPos, params.maxPos, params.zeroPos) == pytest.approx((0, 400, 100))


def test_joint_servant_home_is_zero_position(arm: Served) -> None:
    motors = arm.ports["JointMotor"]
    motors.setSyncZeroPos()
    arm.simulation.advance(0.05)
    arm.advance_until(
        lambda: not any(motor.isMoving for motor in motors.getAllMotorState().values())
    )
    found = {name: motor.pos for name, motor in motors.getAllMotorState().items()}
    assert found == pytest.approx({"shoulder": 0.2, "elbow": 0.0, "lift": 100.0}, abs=0.5)


def test_joint_servant_holds_velocity(arm: Served) -> None:
    motors, i = arm.ports["JointMotor"], arm.types
    motors.setVelocity(i.MotorGoalVelocity("elbow", -0.6, 0))
    arm.simulation.advance(1.0)
    assert motors.getMotorState("elbow").vel == pytest.approx(-0.6, abs=0.02)
    motors.setVelocity(i.MotorGoalVelocity("elbow", 0.0, 0))
    arm.simulation.advance(1.0)
    assert abs(motors.getMotorState("elbow").vel) < 1e-3


NONSENSE = [
    ("setPosition", "MotorGoalPosition", ("nobody", 0.0, 0.0), "UnknownMotorException", "nobody"),
    ("setPosition", "MotorGoalPosition", ("elbow", math.nan, 0.0), "HardwareFailed", "NaN"),
    ("setPosition", "MotorGoalPosition", ("elbow", 2.5, 0.0), "HardwareFailed", "-2 … 2"),
    ("setPosition", "MotorGoalPosition", ("elbow", 1.0, -1.0), "HardwareFailed", "negative"),
    ("setVelocity", "MotorGoalVelocity", ("shoulder", 9.0, 0.0), "HardwareFailed", "-3 … 3"),
    ("setVelocity", "MotorGoalVelocity", ("shoulder", math.inf, 0.0), "HardwareFailed", "inf"),
]


@pytest.mark.parametrize(("operation", "type_", "goal", "error", "message"), NONSENSE)
def test_joint_servant_refuses_invalid_commands(
    arm: Served, operation: str, type_: str, goal: tuple[object, ...], error: str, message: str
) -> None:
    with pytest.raises(Exception, match=message) as raised:
        getattr(arm.ports["JointMotor"], operation)(getattr(arm.types, type_)(*goal))
    assert type(raised.value).__name__.startswith(error)
    arm.simulation.advance(0.5)
    assert np.abs(arm.ports["ControlBoard"].getState().position - [0.2, 0, 0.05]).max() < 1e-6


def test_joint_servant_moves_all_motors_or_none(arm: Served) -> None:
    motors, i = arm.ports["JointMotor"], arm.types
    goals = [i.MotorGoalPosition("elbow", 1.0, 0), i.MotorGoalPosition("nobody", 1.0, 0)]
    with pytest.raises(i.UnknownMotorException):
        motors.setSyncPosition(goals)
    arm.simulation.advance(0.5)
    assert abs(motors.getMotorState("elbow").pos) < 1e-6


def test_board_servant_separates_control_modes(arm: Served) -> None:
    board, i = arm.ports["ControlBoard"], arm.types
    with pytest.raises(i.WrongMode):
        board.velocityMove(["elbow"], np.array([1.0]), 0.0)
    board.setControlMode(["elbow"], i.ControlMode.Velocity)
    board.velocityMove(["elbow"], np.array([0.5]), 0.0)
    arm.simulation.advance(1.0)
    state = board.getState()
    assert state.velocity[1] == pytest.approx(0.5, abs=0.02)
    assert [mode.name for mode in state.modes] == ["Position", "Velocity", "Position"]
    assert state.time == pytest.approx(1.0, abs=0.01)
    with pytest.raises(i.UnknownJoint):
        board.motionDone(["nobody"])


PENDULUM = """\
<innerModel>
  <joint id="elbow" axis="z">
    <translation id="hand" tx="200" mass="0.5"/>
  </joint>
</innerModel>
"""


def test_board_servant_torque_accelerates_joint_by_inertia(tmp_path: Path) -> None:
    arm = served(tmp_path, PENDULUM)
    board, i = arm.ports["ControlBoard"], arm.types
    board.setControlMode(["elbow"], i.ControlMode.Torque)
    board.setTorque(["elbow"], np.array([1.0]))
    arm.simulation.advance(0.1)
    # 0.5 kg at 0.2 m, its own ball, and the motor's 0.005 · 50
    inertia = 0.5 * 0.2**2 + 0.4 * 0.5 * 0.05**2 + 0.25
    assert board.getState().velocity[0] == pytest.approx(0.1 / inertia, rel=0.04)


def test_board_servant_answers_every_operation(arm: Served) -> None:
    board, i = arm.ports["ControlBoard"], arm.types
    assert [getJoint.name for getJoint in board.getJoints()] == ["shoulder", "elbow", "lift"]
    assert board.getJoints()[2].prismatic
    for loop in i.Loop:
        board.setPid(loop, "elbow", i.Pid(200.0 + loop, 1.0, 5.0, 0.0, 40.0, 20.0, 0.5))
        board.resetPid(loop, ["elbow"])
        board.enablePid(loop, ["lift"], False)
        assert board.isPidEnabled(loop, []).tolist() == [True, True, False]
        board.enablePid(loop, [], True)
        for asked in (board.getPidReferences, board.getPidErrors, board.getPidOutputs):
            assert asked(loop, ["elbow", "lift"]).shape == (2,)
    assert [board.getPid(loop, "elbow").kp for loop in i.Loop] == [200.0, 201.0, 202.0, 203.0]
    assert board.getPid(i.Loop.TorqueLoop, "elbow").feedforward == 0.5
    board.setImpedance("elbow", i.Impedance(10.0, 1.0, 0.5))
    assert board.getImpedance("elbow").offset == 0.5
    assert board.getLastFault("elbow").code == 0
    assert "gears" in board.getVariables()
    board.setVariable("speed_limits", np.array([1.0, 2.0, 0.5]))
    assert board.getVariable("speed_limits").tolist() == [1.0, 2.0, 0.5]
    with pytest.raises(i.RoboCompControlBoard_Refused, match="no variable"):
        board.getVariable("colour")
    board.setControlModes(["shoulder", "elbow"], [i.ControlMode.Position, i.ControlMode.Torque])
    board.setTorque(["elbow"], np.array([0.25]))
    assert board.getTargets(["elbow"]).torque.tolist() == [0.25]
    board.setReferenceSpeed(["elbow"], np.array([0.3]))
    assert board.getReferenceSpeed(["elbow"]).tolist() == [0.3]
    assert board.getAcceleration([]).shape == (3,)
    assert not board.isBusy()
    board.park(["shoulder"])
    assert board.isBusy()
    arm.advance_until(lambda: board.getState().modes[0].name == "Idle")
    assert board.getState().position[0] == pytest.approx(0.2, abs=0.05)


def where(arm: Served, frame: str) -> list[float]:
    """The place of a frame in the world in mm."""
    data = arm.simulation.world.data
    body = data.body(frame)
    found: list[float] = axes.matrix(body.xpos, body.xmat)[:3, 3].tolist()
    return found


def test_joint_holds_position_after_reference_timeout(arm: Served) -> None:
    board, i = arm.ports["ControlBoard"], arm.types
    arm.simulation.set_reference_timeout(0.2)
    board.setControlMode(["elbow"], i.ControlMode.Torque)
    for _ in range(5):
        board.setTorque(["elbow"], np.array([0.05]))
        arm.simulation.advance(0.1)
    assert board.getState().modes[1] is i.ControlMode.Torque
    arm.simulation.advance(0.2)
    state = board.getState()
    assert state.modes[1] is i.ControlMode.Position
    assert state.interactions[1] is i.InteractionMode.Compliant
    assert state.faults.tolist() == [0, 7, 0]
    assert board.getLastFault("elbow").what == "no reference came for 0.2 s: it holds its position"
    arm.simulation.reset()  # what was set lives on
    assert board.getVariable("reference_timeout").tolist() == [0.2]


FAR = ("setEncoder", "setMotorEncoder")


@pytest.mark.parametrize("operation", FAR)
def test_joint_servant_refuses_unreachable_number(arm: Served, operation: str) -> None:
    """From such no controller works out a torque."""
    board = arm.ports["ControlBoard"]
    with pytest.raises(arm.types.RoboCompControlBoard_Refused, match="nothing here reaches"):
        getattr(board, operation)("elbow", 1e308)
    arm.simulation.advance(0.1)
    assert np.abs(board.getState().position - [0.2, 0, 0.05]).max() < 1e-6
    assert not any(warning.number for warning in arm.simulation.world.data.warning)
