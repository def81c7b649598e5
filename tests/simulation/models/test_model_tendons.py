"""Motors of tendons and of sites in MJCF: those that move one joint are motors of that joint."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest

from robocomp_dsl.generate.simulator.served_interfaces import not_served
from robocomp_dsl.simulation.models.model_scene import ModelDescription, describe
from tests.simulation.served_worlds import served_model

TIED = '<equality><joint joint1="left" joint2="right" polycoef="0 {slope} 0 0 0"/></equality>'
SPLIT = '<tendon><fixed name="t"><joint joint="left" coef="0.5"/>{other}</fixed></tendon>'
OTHER = '<joint joint="right" coef="0.5"/>'
CLOSE = '<actuator><general name="close" {on} gear="2" forcerange="-30 30"/></actuator>'
GRIPPER = """\
<mujoco>
  <option timestep="0.001"/>
  <worldbody>
    <body name="hand">
      <geom type="box" size=".02 .06 .02" mass="1"/>
      <site name="s"/>
      <body>
        <joint name="left" type="slide" axis="0 1 0" range="0 0.04" armature="1" damping="2"/>
        <geom type="box" size=".01 .005 .02" pos="0 .01 .05" mass="0.02" contype="0"/>
      </body>
      <body>
        <joint name="right" type="slide" axis="0 -1 0" range="0 0.04" armature="1" damping="2"/>
        <geom type="box" size=".01 .005 .02" pos="0 -.01 .05" mass="0.02" contype="0"/>
      </body>
    </body>
  </worldbody>
  {more}
</mujoco>
"""


def gripper(*more: str) -> str:
    return GRIPPER.format(more="\n  ".join(more))


PANDA = gripper(TIED.format(slope=1), SPLIT.format(other=OTHER), CLOSE.format(on='tendon="t"'))


def described(folder: Path, text: str) -> ModelDescription:
    (folder / "robot.xml").write_text(text)
    return describe(folder / "robot.xml", "model.xml")


def test_tendon_motor_closes_both_fingers(tmp_path: Path) -> None:
    world = served_model(tmp_path, PANDA)
    motors = world.ports["JointMotor"]
    assert list(motors.getAllMotorState()) == ["right"]
    motors.setPosition(world.types.MotorGoalPosition("right", 30.0, 0.0))
    world.simulation.advance(0.05)
    world.advance_until(lambda: not motors.getMotorState("right").isMoving)
    world.simulation.advance(0.3)
    left, right = (world.simulation.world.data.joint(name).qpos[0] for name in ("left", "right"))
    assert (left, right) == pytest.approx((0.03, 0.03), abs=1e-3)


def test_tendon_motor_force_follows_from_tendon(tmp_path: Path) -> None:
    """30 N at the tendon, which goes as far as the fingers, behind a gear of 2."""
    assert forces(tmp_path, PANDA) == {"right": 60.0}
    slow = PANDA.replace(TIED.format(slope=1), TIED.format(slope=0.5))
    assert forces(tmp_path, slow) == {"right": 45.0}


def forces(folder: Path, text: str) -> dict[str, float]:
    description = described(folder, text)
    assert description.findings == []
    return {
        device["id"]: device["settings"]["force"]
        for device in description.scene["devices"]
        if device["kind"] == "prismaticjoint"
    }


def test_tendon_of_one_joint_acts_like_joint(tmp_path: Path) -> None:
    text = gripper(SPLIT.format(other=""), CLOSE.format(on='tendon="t"'))
    assert forces(tmp_path, text) == {"left": 30.0}
    assert not_served(described(tmp_path, text).scene) == [("right", "passivejoint")]


LEFT_OUT = {
    "two joints that go their own ways": gripper(
        SPLIT.format(other=OTHER), CLOSE.format(on='tendon="t"')
    ),
    "joints that go against each other": gripper(
        TIED.format(slope=-1), SPLIT.format(other=OTHER), CLOSE.format(on='tendon="t"')
    ),
    "a tendon through space": gripper(
        '<tendon><spatial name="t"><site site="s"/><site site="w"/></spatial></tendon>',
        CLOSE.format(on='tendon="t"'),
    ).replace("<worldbody>", '<worldbody><site name="w" pos="0 0 1"/>'),
    "a thruster": gripper(CLOSE.format(on='site="s"')),
}


@pytest.mark.parametrize("case", LEFT_OUT)
def test_tendon_motor_that_moves_no_single_joint_is_reported(tmp_path: Path, case: str) -> None:
    description = described(tmp_path, LEFT_OUT[case])
    assert [finding.message for finding in description.findings] == [
        "not on one joint, so on no control board; they keep the commands of the start: `close`"
    ]
    assert "pulled" not in description.scene["model"]


def test_tendon_does_not_replace_motor_of_joint(tmp_path: Path) -> None:
    motor = CLOSE.format(on='tendon="t"').replace(
        "</actuator>", '<motor name="own" joint="right" ctrlrange="-9 9"/></actuator>'
    )
    text = gripper(TIED.format(slope=1), SPLIT.format(other=OTHER), motor)
    description = described(tmp_path, text)
    assert ["`close`" in finding.message for finding in description.findings] == [True]


def test_tendon_motor_is_restored_by_reset_and_fork(tmp_path: Path) -> None:
    world = served_model(tmp_path, PANDA)
    board = world.ports["ControlBoard"]
    for _ in range(2):
        board.setReferenceSpeed([], [1.0])
        board.positionMove([], [0.02])
        world.simulation.advance(0.5)
        assert np.abs(board.getState().position - 0.02).max() < 1e-3
        world.simulation.reset()
        assert np.abs(board.getState().position).max() < 1e-6
