"""The worlds of the robots that ship: they are the robots, and their simulators are fresh."""

from __future__ import annotations

from functools import cache
from pathlib import Path
from typing import Any

import mujoco
import numpy as np
import pytest

from robocomp_dsl.hardware.control.joints import BoardSpec
from robocomp_dsl.hardware.control.modes import Mode
from robocomp_dsl.resources import INTERFACES
from robocomp_dsl.simulation.robots.boards import board_names, robot_board
from robocomp_dsl.simulation.robots.build import add_robot, new_world
from robocomp_dsl.simulation.robots.catalog import ROBOTS, description, description_file
from robocomp_dsl.simulation.robots.export import (
    FINGERS,
    FORCE,
    WORLDS,
    RobotWorld,
    robot_text,
    text,
)
from robocomp_dsl.simulation.world.simulation import Simulation, SimulationOptions
from tests.simulation.served_worlds import rcgen
from tests.support.generated_package import package_in

COMPONENTS = Path(INTERFACES).parent / "components"
EXPORT = "run `python -m robocomp_dsl.simulation.robots.export` and commit what it changes"
RCGEN = "run `rcgen simulator {} --tactile tactile.yaml -o .` there and commit what it changes"

worlds = pytest.mark.parametrize("world", WORLDS, ids=lambda world: world.robot)


@cache
def simulation(world: RobotWorld) -> Simulation:
    """The world as its simulator reads it; each test sets it to its start."""
    scene = package_in((COMPONENTS / world.file).parent) / "scene.json"
    return Simulation.read(scene, SimulationOptions(step=0.001))


@worlds
def test_robot_world_file_matches_exporter(world: RobotWorld) -> None:
    path = COMPONENTS / world.file
    assert path.read_text("utf-8") == text(world), EXPORT
    described = description_file(world.robot).read_bytes()
    assert path.with_name("tactile.yaml").read_bytes() == described, EXPORT


@pytest.mark.parametrize("name", ROBOTS)
def test_robot_model_of_description_matches_exporter(name: str) -> None:
    model = description_file(name).with_name(description(name).model)
    assert model.read_text("utf-8") == robot_text(name), EXPORT


@worlds
def test_robot_simulator_is_freshly_generated(world: RobotWorld, tmp_path: Path) -> None:
    file = COMPONENTS / world.file
    for path in (file, file.with_name("tactile.yaml")):
        (tmp_path / path.name).write_bytes(path.read_bytes())
    values = ("simulator", file.name, "--tactile", "tactile.yaml", "-o", "made")
    done = rcgen(*values, cwd=tmp_path)
    assert (done.returncode, done.stderr) == (0, "")
    saved = {"README.md", "specificworker.py", "etc/config.yaml"}
    joint_poses = {
        str(path.relative_to(tmp_path / "made")): path.read_text("utf-8")
        for path in (tmp_path / "made").rglob("*")
        if path.is_file()
    }
    assert len(joint_poses) > 10
    for name in joint_poses.keys() - saved:
        assert (file.parent / name).read_text("utf-8") == joint_poses[name], (
            f"{file.parent.name}/{name}: {RCGEN.format(file.name)}"
        )


@worlds
def test_robot_world_forward_kinematics_match_robot(world: RobotWorld) -> None:
    """The file has six digits: bodies and points are where the robot has them to 0.01 mm."""
    robot = ROBOTS[world.robot]()
    spec = new_world()
    add_robot(spec, robot)
    own, file = spec.compile(), mujoco.MjModel.from_xml_path(str(COMPONENTS / world.file))
    here, there = mujoco.MjData(own), mujoco.MjData(file)
    random = np.random.default_rng(7)
    for _ in range(20):
        for joint in robot.joints.values():
            angle = random.uniform(joint.low, joint.high)
            here.joint(joint.name).qpos[0] = there.joint(joint.name).qpos[0] = angle
        mujoco.mj_forward(own, here)
        mujoco.mj_forward(file, there)
        for link in robot.links:
            body, other = here.body(link.name), there.body(link.name)
            assert np.abs(body.xpos - other.xpos).max() < 1e-5
            assert np.abs(body.xmat - other.xmat).max() < 1e-5
            for point in link.points:
                apart = here.site(point).xpos - there.site(point).xpos
                assert np.abs(apart).max() < 1e-5


def limits(spec: BoardSpec) -> dict[str, tuple[float, ...]]:
    """Of all joints."""
    return {
        joint.name: (joint.low, joint.high, joint.speed_limit, joint.torque_limit)
        for joint in spec.joints
    }


@worlds
def test_robot_world_boards_match_joints_and_limits_of_robot(world: RobotWorld) -> None:
    robot, board = ROBOTS[world.robot](), simulation(world).devices["finger_x"]
    here = limits(board.board.spec)
    for name in board_names(robot):
        expected = robot_board(robot, name)
        group = [joint for joint in board.names if board.groups[joint] == name]
        assert group == list(expected.spec.names)
        for joint, limit in limits(expected.spec).items():
            assert here[joint] == pytest.approx(limit, rel=1e-5), joint
        at = board.board.select.indices(group)
        assert board.board.spec.coupling[np.ix_(at, at)] == pytest.approx(expected.spec.coupling)
    assert set(board.groups.values()) == {*board_names(robot), *FINGERS}


@worlds
def test_robot_world_start_pose_is_free_of_contacts(world: RobotWorld) -> None:
    """And it stays there, with all boards in position mode."""
    robot, it = ROBOTS[world.robot](), simulation(world)
    it.reset()
    assert it.overlaps() == []
    start = {name: robot.start.get(name, 0.0) for name in robot.joints}
    assert it.world.data.ncon == 0
    it.advance(1.0)
    for name, angle in start.items():
        assert it.state.joint(name) == pytest.approx(angle, abs=1e-3), name
    for finger, parked in zip(FINGERS, world.parked, strict=True):
        assert it.world.data.body(finger).xpos == pytest.approx(parked, abs=1e-5)


def move(it: Simulation, joints: list[str], goal: list[float], seconds: float) -> Any:
    board = it.devices[joints[0]].board
    chosen = board.select.indices(joints)
    board.references.move(chosen, np.array(goal), board.dt, np.full(len(joints), 0.3))
    it.advance(seconds)
    return board


def slides(finger: str) -> list[str]:
    return [f"{finger}_{axis}" for axis in "xyz"]


@worlds
def test_robot_world_fingers_follow_their_joints(world: RobotWorld) -> None:
    """Each by itself: the other one stays."""
    it, goal = simulation(world), [world.parked[0][0] + 0.05, 0.3, 0.2]
    it.reset()
    for finger, parked, other in zip(FINGERS, world.parked, FINGERS[::-1], strict=True):
        stays = it.world.data.body(other).xpos.copy()
        move(it, slides(finger), goal, 3.0)
        assert it.world.data.body(finger).xpos == pytest.approx(goal, abs=2e-3)
        assert it.world.data.body(other).xpos == pytest.approx(stays, abs=1e-4)
        move(it, slides(finger), list(parked), 3.0)


@pytest.mark.parametrize("finger", FINGERS)
@worlds
def test_robot_world_finger_force_is_limited(world: RobotWorld, finger: str) -> None:
    """Driven through the robot's root, which is fixed, it presses on it with 20 N."""
    it = simulation(world)
    it.reset()
    root = ROBOTS[world.robot]().links[0].name
    middle = it.world.data.geom(root).xpos.copy()
    ahead = world.parked[0][0]
    move(it, slides(finger), [ahead, *middle[1:]], 4.0)
    move(it, slides(finger)[:1], [middle[0] - 0.5], 8.0)
    data, pressed = it.world.data, np.zeros(6)
    total = 0.0
    for i in range(data.ncon):
        mujoco.mj_contactForce(it.world.model, data, i, pressed)
        total += pressed[0]
    assert total == pytest.approx(FORCE, rel=0.05)


def test_robot_world_icub_eyes_turn_by_version_and_vergence() -> None:
    """Encoders at the joints count these; those of the motors each its own eye."""
    it = simulation(next(world for world in WORLDS if world.robot == "icub_v2"))
    it.reset()
    eyes, pans = ["eyes_version", "eyes_vergence"], ["l_eye_pan", "r_eye_pan"]
    board = move(it, eyes, [0.2, 0.3], 3.0)
    at = board.select.indices(eyes)
    left, right = (it.state.joint(pan) for pan in pans)
    assert (left, right) == pytest.approx((0.35, 0.05), abs=5e-3)
    state = board.state()
    assert state.position[at] == pytest.approx([0.2, 0.3], abs=5e-3)
    turns = state.motor_counts[at] / board.motors.counts[at] * 2 * np.pi / board.motors.gear[at]
    assert turns == pytest.approx([left, right], abs=1e-3)
    assert [motor.name for motor in board.spec.motors[at[0] : at[1] + 1]] == pans
    move(it, ["eyes_vergence"], [0.0], 3.0)
    assert [it.state.joint(pan) for pan in pans] == pytest.approx([0.2, 0.2], abs=5e-3)
    move(it, ["eyes_tilt"], [0.2], 3.0)
    assert it.state.joint("eyes_tilt") == pytest.approx(0.2, abs=5e-3)
    # both pushed with all there is: no motor gets more than its joint may have
    board.set_modes(at, [Mode.TORQUE] * 2)
    board.set_streamed_reference(board.law.torque, at, board.limits.torque[at])
    it.advance(0.001)
    motors = [it.world.data.actuator(pan).ctrl[0] for pan in pans]
    assert motors == pytest.approx([1.0, 0.0], abs=1e-6)
