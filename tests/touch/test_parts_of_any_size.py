"""Parts with another number of servos than an arm: the generic head of listing 2, and a neck."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest

from robocomp_dsl.tactile.description.read import load_robot
from tests.support.waiting import wait_until
from tests.touch.arm_client import NONE, arm_on, refusal_of
from tests.touch.kinematic_robot import KinematicRobot

LISTING = """\
<Generic_Robot_Part>icub_head</Generic_Robot_Part>
  <generic_servo_number>2</generic_servo_number>{first}
  <generic_servo id="1">
    <destination_servo_id>2</destination_servo_id>
    <transform_factor>1.00</transform_factor>
    <transform_displacement>0.00</transform_displacement>
    <stiffness>1.00</stiffness>
    <damping>0.00</damping>
    <speed>20.00</speed>
  </generic_servo>
  .....
<initial_positions>
  <servo type="deg" destination_servo_id="0" pos="-2.00"/>
  <servo type="deg" destination_servo_id="1" pos="15.00"/>
</initial_postions>
"""
"""Listing 2 of Ma and Dahl (2016) as printed, with another servo at {first}; factor 1: degrees."""
PITCH = """
  <generic_servo id="0">
    <destination_servo_id>0</destination_servo_id>
    <transform_factor>-1.00</transform_factor>
    <transform_displacement>0.00</transform_displacement>
    <speed>20.00</speed>
    <limits min="-30" max="22"/>
  </generic_servo>"""


def degrees(*values: float) -> np.ndarray:
    return np.array(values, dtype=float)


def test_generic_head_of_printed_listing_moves_robot(tmp_path: Path) -> None:
    """Servo 1 is joint 2 of the board; joints 0 and 1 stay at their initial positions."""
    file = tmp_path / "icub_head.xml"
    file.write_text(LISTING.format(first=""))
    with arm_on(
        "icub_v2", "part=icub_head", "begin=start", "begin_speed=1", description=file, board="head"
    ) as (head, served):
        assert head.getLimits().available.tolist() == [False, True]
        outcome = head.move(degrees(0.0, 12.0), NONE)
        assert outcome.dropped.tolist() == [False, False]
        assert head.wait_for_rest().position == pytest.approx([0.0, 12.0], abs=1.0)
        names = served.part.board.spec.names
        roll = names.index("neck_roll")
        wait_until(lambda: abs(np.degrees(served.part.board.position[roll]) - 15.0) < 1.5)
        assert "no kinematic chain" in refusal_of(head.getHand)


def test_generic_head_with_two_servos_is_commanded_in_every_way(tmp_path: Path) -> None:
    file = tmp_path / "icub_head.xml"
    file.write_text(LISTING.format(first=PITCH))
    with arm_on("icub_v2", "part=icub_head", description=file, board="head") as (head, _):
        limits = head.getLimits()
        assert limits.available.tolist() == [True, True]
        assert limits.low[0] == pytest.approx(-22.0)
        head.move(degrees(5.0, 10.0), NONE)
        assert head.wait_for_rest().position == pytest.approx([5.0, 10.0], abs=1.0)
        head.moveBy(degrees(3.0, -4.0), NONE)
        assert head.wait_for_rest().position == pytest.approx([8.0, 6.0], abs=1.0)
        assert head.move(degrees(90.0, 0.0), NONE).clipped.tolist() == [True, False]
        head.stop()
        assert "2 values are needed, not 5" in refusal_of(head.move, np.zeros(5), NONE)


NECK = """
robot: neck
model: neck.xml
parts:
  neck:
    servos:
      - {joint: yaw, gamma: 1, sigma: 0, limits: [-2, 2], speed: 3}
      - {joint: pitch, gamma: -1, sigma: 0, limits: [-1, 1], speed: 3}
      - {joint: roll, gamma: 1, sigma: 0, limits: [-0.8, 0.8], speed: 3}
    limbs:
      head: {body: head, rpy: [0, -90 deg, 0], cone: {x: [20 mm, 120 mm], r: [60 mm, 60 mm]}}
    skin:
      - {patch: head, limb: head, rings: {x: [40 mm, 70 mm, 100 mm], count: 12}}
    fields:
      - {name: front, limb: head, x: 80 mm, theta: 180 deg, radius: 60 mm, motion: [0, 0.3, 0]}
      - {name: back, limb: head, x: 80 mm, theta: 0, radius: 60 mm, motion: [0, -0.3, 0]}
      - {name: left, limb: head, x: 80 mm, theta: 90 deg, radius: 60 mm, motion: [0, 0, 0.3]}
      - {name: right, limb: head, x: 80 mm, theta: -90 deg, radius: 60 mm, motion: [0, 0, -0.3]}
"""
NECK_MODEL = """
<mujoco model="neck"><compiler angle="radian"/><worldbody>
  <body name="trunk" pos="0 0 1"><geom type="box" size="0.1 0.15 0.2"/>
    <body name="neck_1" pos="0 0 0.25"><joint name="yaw" axis="0 0 1" range="-2 2"/>
      <inertial pos="0 0 0" mass="0.1" diaginertia="1e-4 1e-4 1e-4"/>
      <body name="neck_2"><joint name="pitch" axis="0 1 0" range="-1 1"/>
        <inertial pos="0 0 0" mass="0.1" diaginertia="1e-4 1e-4 1e-4"/>
        <body name="head"><joint name="roll" axis="1 0 0" range="-0.8 0.8"/>
          <geom type="cylinder" fromto="0 0 0.02 0 0 0.12" size="0.06"/>
</body></body></body></body></worldbody></mujoco>
"""


@pytest.fixture
def neck(tmp_path: Path) -> Path:
    (tmp_path / "neck.xml").write_text(NECK_MODEL)
    file = tmp_path / "neck.tactile.yaml"
    file.write_text(NECK)
    return file


@pytest.mark.parametrize("law", ["fixed", "pose"])
def test_reflex_withdraws_a_part_with_three_servos(start_reflex, neck: Path, law: str) -> None:
    class Neck(KinematicRobot):
        def describe(self):
            return load_robot(neck)

    harness = start_reflex("neck", "neck", Neck, description=neck, law=law).wait_until_watching()
    moved = {}
    for name in ("front", "left"):
        harness.press(name, 20.0, 0.03)
        harness.run_until("Holding")
        moved[name] = harness.robot.pose.copy()
        harness.release()
        harness.run_until("Watching", 30.0)
    assert moved["front"].shape == (3,)
    if law == "fixed":
        assert moved["front"][1] > 0.1
        assert moved["left"][2] > 0.1
    assert np.abs(moved["front"][1]) > np.abs(moved["front"][2])
    assert np.abs(moved["left"][2]) > np.abs(moved["left"][1])
