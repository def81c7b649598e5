"""Where joints of InnerModel start and go home, and the gears of their motors."""

from __future__ import annotations

import math
from pathlib import Path

import pytest

from tests.simulation.served_worlds import Served, rcgen, served

ARM = """\
<innerModel>
  <transform id="world">
    <joint id="home" axis="z" min="-1.5" max="1.5" home="0.4">
      <motor id="m1" gear="50"/>
      <translation id="tip" tx="1000"/>
    </joint>
    <joint id="turned" axis="x" rx="0.3" ry="0.2"/>
    <joint id="both" axis="y" rx="0.1" ry="0.2" home="-0.5"/>
    <joint id="zero" axis="y" ry="0.2" home="0"/>
    <joint id="usual" axis="y"><motor id="m2" force="3"/></joint>
    <prismaticjoint id="home_slide" axis="y" home="100">
      <motor id="m3" gear="2000"/>
    </prismaticjoint>
    <prismaticjoint id="slide" axis="x" position="50"/>
    <prismaticjoint id="both_slide" axis="z" min="0" max="400" position="50" offset="5" home="100"/>
    <prismaticjoint id="usual_slide" axis="z"/>
  </transform>
</innerModel>
"""
START = {
    "home": 0.4,
    "turned": 0.3,
    "both": -0.5,
    "zero": 0.0,
    "usual": 0.0,
    "home_slide": 100.0,
    "slide": 50.0,
    "both_slide": 50.0,
    "usual_slide": 0.0,
}
HOME = START | {"both_slide": 100.0}


@pytest.fixture
def arm(tmp_path: Path) -> Served:
    return served(tmp_path, ARM)


def positions(arm: Served) -> dict[str, float]:
    return {name: state.pos for name, state in arm.ports["JointMotor"].getAllMotorState().items()}


def test_joint_starts_at_home(arm: Served) -> None:
    assert positions(arm) == pytest.approx(START, abs=1e-6)
    nodes = arm.ports["InnerModelManager"]
    _, tip = nodes.getPose("root", "tip")
    expected = (1000 * math.cos(0.4), 1000 * math.sin(0.4), 0)
    assert (tip.x, tip.y, tip.z) == pytest.approx(expected, abs=1e-6)
    _, both = nodes.getPoseFromParent("both")  # its angles about the other axes are fixed
    assert (both.rx, both.ry, both.rz) == pytest.approx((0.1, -0.5, 0), abs=1e-9)
    _, slide = nodes.getPoseFromParent("both_slide")
    assert slide.z == pytest.approx(55, abs=1e-6)


def test_joint_holds_home_and_returns_there(arm: Served) -> None:
    arm.simulation.advance(0.5)
    assert positions(arm) == pytest.approx(START, abs=1e-3)
    motors = arm.ports["JointMotor"]
    params = {name: motors.getMotorParams(name).zeroPos for name in START}
    assert params == pytest.approx(HOME)
    motors.setPosition(arm.types.MotorGoalPosition("home", -1.0, 0))
    arm.simulation.advance(0.2)
    motors.setSyncZeroPos()
    arm.advance_until(lambda: not any(s.isMoving for s in motors.getAllMotorState().values()))
    assert positions(arm) == pytest.approx(HOME, abs=0.5)
    assert positions(arm)["home"] == pytest.approx(0.4, abs=2e-3)
    arm.ports["Simulation"].reset()
    assert positions(arm) == pytest.approx(START, abs=1e-6)


def test_joint_added_at_run_time_has_home_where_it_starts(arm: Served) -> None:
    joint = arm.types.jointType(
        pose=arm.types.Pose3D(0, 0, 0, 0, 0.7, 0), min=-1.0, max=1.0, axis="y"
    )
    arm.ports["InnerModelManager"].addJoint("nod", "world", joint)
    motors = arm.ports["JointMotor"]
    assert motors.getMotorState("nod").pos == pytest.approx(0.7)
    assert motors.getMotorParams("nod").zeroPos == pytest.approx(0.7)


def test_motor_gear_is_that_of_description(arm: Served) -> None:
    """Turns of the motor per turn of the joint; 100 if the description does not say."""
    board = arm.ports["ControlBoard"]
    gears = {axis.name: axis.gear for axis in board.getJoints()}
    assert gears == dict.fromkeys(START, 100.0) | {"home": 50.0, "home_slide": 2000.0}
    state = arm.ports["JointMotor"].getMotorState("home")
    assert state.p == pytest.approx(0.4 / math.tau * 50 * 4096, abs=1)
    slide = arm.ports["JointMotor"].getMotorState("home_slide")
    assert slide.p == pytest.approx(0.1 / math.tau * 2000 * 4096, abs=1)


def test_motor_gear_of_driver_is_that_of_description(tmp_path: Path) -> None:
    (tmp_path / "arm.xml").write_text(ARM)
    done = rcgen("hardware", "bus", "--like", "arm.xml#home,usual", cwd=tmp_path)
    assert done.returncode == 0, done.stderr
    written = (tmp_path / "bus" / "driver.py").read_text()
    # a default is not written, and that of `MotorSpec` is 100
    assert [float(part.split(",")[0]) for part in written.split("gear=")[1:]] == [50.0]
