"""Skin, control board, generic arm and reflex together: a finger presses, the arm withdraws.

The same reflex, without a word about a robot, on both bodies.
"""

from __future__ import annotations

import mujoco
import numpy as np
import pytest

from robocomp_dsl.hardware.control.modes import Mode
from robocomp_dsl.hardware.mujoco.control_board import SimulatedBoard
from robocomp_dsl.hardware.mujoco.skin import SimulatedSkin, SkinFrame
from robocomp_dsl.hardware.mujoco.world import World
from robocomp_dsl.hardware.robots.boards import whole_robot
from robocomp_dsl.hardware.robots.build import add_robot, new_world, set_pose
from robocomp_dsl.hardware.robots.catalog import ROBOTS, description
from robocomp_dsl.tactile.arm.generic_arm import GenericArm, Orders
from robocomp_dsl.tactile.reflex.engine import (
    ArmFacts,
    Move,
    ReflexEngine,
    ReflexSettings,
    ReflexState,
)
from robocomp_dsl.tactile.reflex.frames import FrameGate
from robocomp_dsl.tactile.reflex.law import Field, Law
from robocomp_dsl.tactile.reflex.receptors import Receptors
from robocomp_dsl.tactile.skin.geometry import SkinGeometry

FINGER = 0.008
LAW = Law(threshold=0.03, full=0.12)


class TouchedRobot:
    """A robot with skin, one arm under control, and a finger that can press on it."""

    def __init__(self, name: str, side: str) -> None:
        robot, self.part = ROBOTS[name](), description(name).part(side)
        spec = new_world()
        add_robot(spec, robot)
        finger = spec.worldbody.add_body(name="finger", mocap=True, pos=[0, 0, 3])
        finger.add_geom(type=mujoco.mjtGeom.mjGEOM_SPHERE, size=[FINGER, 0, 0])
        self.geometry = SkinGeometry.of(description(name))
        self.skin = SimulatedSkin(self.geometry)
        self.board = SimulatedBoard(whole_robot(robot))
        self.world = World(spec, [self.skin, self.board])
        set_pose(self.world.model, self.world.data, robot)
        self.world.advance(0.001)
        self.board.commands.set_mode(None, Mode.POSITION)
        self.arm = GenericArm(self.part)
        low, high = self.arm.low, self.arm.high
        facts = ArmFacts(low, high, self.arm.speed_limits, self.part.start)
        self.engine = ReflexEngine(facts, ReflexSettings(hold=0.5))
        self.gate = FrameGate(self.geometry.version, self.geometry.size)
        self.receptors = Receptors(self.geometry, side, self.part.fields, LAW)
        self.skin.subscribe(self.feel)
        self.names = [joint.split("/")[-1] for joint in self.part.joints]
        self.board_index = [self.board.board.spec.names.index(n) for n in self.names]
        self.first_force = self.first_move = self.cleared = None
        self.peak = 0.0

    def feel(self, frame: SkinFrame) -> None:
        """What the reflex component does with a frame."""
        now = self.world.time
        state = self.board.board.state()
        i = self.board_index
        here = self.arm.sense(now, state.position[i], state.velocity[i], state.torque[i])
        self.obey(self.engine.arm(here.position, now))
        forces = self.gate.check(frame.sequence, frame.time, frame.geometry, frame.force)
        self.obey(self.engine.frame(self.receptors.answer(forces), now))
        total = float(forces.sum())
        self.peak = max(self.peak, total)
        if total > 0.0 and self.first_force is None:
            self.first_force = now
        if self.first_force is not None:
            self.cleared = now if total > 0.0 or self.cleared is None else self.cleared

    def obey(self, action) -> None:
        if isinstance(action, Move):
            orders: Orders = self.arm.move(action.position, action.speed)
            self.board.settings.set_reference_speed(self.names, orders.speeds)
            self.board.commands.position_move(self.names, orders.values)
            if self.first_move is None:
                self.first_move = self.world.time

    def surface(self, field: Field, depth: float) -> np.ndarray:
        """Where the finger's centre is when it is `depth` into the limb at the field's centre."""
        limb = self.part.limb(field.limb)
        out = np.array([0.0, *field.centre[1:]])
        out /= np.linalg.norm(out)
        body = self.world.data.body(limb.body)
        turn = body.xmat.reshape(3, 3)
        axis = turn @ limb.to_body(np.array([field.centre[0], 0, 0])) + body.xpos
        way = turn @ limb.axes @ out
        start = axis + 0.055 * way  # nearer than anything else of the robot
        geom = np.zeros(1, np.int32)
        distance = mujoco.mj_ray(self.world.model, self.world.data, start, -way, None, 1, -1, geom)
        return start - (distance - FINGER + depth) * way

    def press(self, field: Field, depth: float, seconds: float) -> None:
        """Push the finger in along the normal within 0.1 s, hold it there, take it away."""
        far, near = self.surface(field, -0.003), self.surface(field, depth)
        for k in range(10):
            self.world.data.mocap_pos[0] = far + (near - far) * (k + 1) / 10
            self.world.advance(0.01)
        self.world.advance(seconds - 0.1)
        self.world.data.mocap_pos[0] = (0, 0, 3)


CASES = [(n, s) for n in ("nao_h21", "icub_v2") for s in ("left_arm", "right_arm")]
PLACES = ("lower_arm_outer", "lower_arm_inner", "lower_arm_under", "lower_arm_upper",
          "upper_arm_front")  # fmt: skip


def field_of(robot: TouchedRobot, name: str) -> Field:
    return next(one for one in robot.part.fields if one.name == name)


@pytest.mark.parametrize("place", PLACES)
@pytest.mark.parametrize(("name", "side"), CASES)
def test_a_pressed_arm_withdraws_and_comes_back(name, side, place):
    robot = TouchedRobot(name, side)
    robot.world.advance(0.1)
    assert robot.engine.state is ReflexState.WATCHING
    field = field_of(robot, place)
    limb = robot.part.limb(field.limb)
    body = robot.world.data.body(limb.body)

    def spot() -> np.ndarray:
        return body.xpos + body.xmat.reshape(3, 3) @ limb.to_body(field.centre)

    before = spot()
    robot.press(field, 0.004, 0.5)
    assert robot.first_force is not None
    assert robot.first_move - robot.first_force <= 0.0401
    assert {one.field.name for one in robot.engine.active} >= {place}
    assert np.linalg.norm(spot() - before) > 0.01
    assert not robot.skin.frame.force.any()  # the finger is still there, the arm is not
    assert robot.cleared - robot.first_force < 0.5
    robot.world.advance(4.0)
    assert robot.engine.state is ReflexState.WATCHING
    assert robot.engine.withdrawals == 1
    assert robot.arm.state.position == pytest.approx(robot.part.start, abs=0.05)
    assert robot.gate.accepted > 100
    assert not robot.gate.rejected


def test_a_touch_outside_all_fields_is_felt_and_left_alone():
    robot = TouchedRobot("icub_v2", "left_arm")
    lonely = Field("x", "lower_arm", np.array([0.03, 0.026, 0.026]), 0.03, np.zeros(5))
    robot.receptors = Receptors(
        robot.geometry, "left_arm", (field_of(robot, "lower_arm_inner"),), LAW
    )
    robot.press(lonely, 0.002, 0.3)
    assert robot.peak > 1.0
    assert robot.first_move is None


def test_a_gentle_touch_below_the_threshold_is_left_alone():
    robot = TouchedRobot("nao_h21", "left_arm")
    robot.receptors = Receptors(
        robot.geometry, "left_arm", robot.part.fields, Law(threshold=50.0, full=60.0)
    )
    robot.press(field_of(robot, "lower_arm_under"), 0.002, 0.3)
    assert robot.peak > 0.5
    assert robot.first_move is None
