"""Sensors and nodes of a model file, and its world."""

from __future__ import annotations

import os
from pathlib import Path
from typing import Any

import mujoco
import numpy as np
import pytest

from robocomp_dsl.simulation.scene import axes
from tests.simulation.model_worlds import ARM, goal
from tests.simulation.served_worlds import Served, served_model
from tests.support.generated_package import package_in


def test_model_imu_measures_gravity_in_its_site(arm: Served) -> None:
    arm.simulation.advance(1.0)
    it = arm.ports["wrist"].getDataImu()
    data = arm.simulation.world.data
    up = data.site("wrist").xmat.reshape(3, 3).T @ (0, 0, 9.81)
    received = (it.acc.XAcc, it.acc.YAcc, it.acc.ZAcc)
    assert received == pytest.approx((up[0], up[2], up[1]), abs=0.05)


def test_model_touch_sensor_measures_push(arm: Served) -> None:
    """A weight on the site of the sensor is felt as its weight."""
    feel = arm.ports["TouchSensor"].getValues
    assert feel()["palm"].value == 0.0
    arm.simulation.set_physics(False)
    ball = arm.simulation.world.data.joint("ball.joint0")
    wrist = arm.simulation.world.data.site("wrist").xpos
    ball.qpos[:3] = wrist + np.array([0.0, 0.0, 0.08])
    arm.simulation.set_physics(True)
    peak = 0.0
    for _ in range(300):
        arm.simulation.advance(0.001)
        peak = max(peak, feel()["palm"].value)
    assert peak > 0.5


def test_model_camera_shows_scene_of_file(arm: Served) -> None:
    """A door, as far away as a ray says; one of them has a depth, as its `output` says."""
    it = arm.ports["CameraRGBDSimple"].getDepth("eye")
    assert (it.width, it.height, it.focalx) == (64, 48, 58)
    depth = it.depth.view(np.float32).reshape(48, 64)
    ahead = np.array([(36 - 31.5) / 57.94, 1.0, (23.5 - 24) / 57.94])
    world, hit = arm.simulation.world, np.array([-1], np.int32)
    away = mujoco.mj_ray(world.model, world.data, [0, -2, 0.5], ahead, None, 1, -1, hit)
    assert world.model.geom(hit[0]).name == "door"
    assert depth[24, 36] == pytest.approx(1000 * away, rel=2e-3)
    image = arm.ports["far"].getImage()
    assert (image.width, image.height, image.depth) == (640, 480, 3)
    assert len(np.unique(image.image)) > 10


def test_model_nodes_are_bodies_joints_and_sites(arm: Served) -> None:
    nodes = {node.id: node for node in arm.ports["InnerModelManager"].getAllNodeInformation()}
    kinds = {name: node.nType.name for name, node in nodes.items()}
    assert (kinds["shoulder"], kinds["upper"], kinds["hinge"]) == ("Joint", "Transform", "Joint")
    assert (kinds["eye"], kinds["far"], kinds["wrist"]) == ("RGBD", "Camera", "IMU")
    assert kinds["palm"] == "TouchSensor"
    assert nodes["upper"].parentId == "shoulder"
    assert nodes["wrist"].parentId == "lower"


def test_model_node_poses_match_physics(arm: Served) -> None:
    """Of bodies and of sites; a joint is where its body turns."""
    arm.simulation.advance(0.1)
    nodes, data = arm.ports["InnerModelManager"], arm.simulation.world.data
    for name, there in (
        ("lower", data.body("lower").xpos),
        ("wrist", data.site("wrist").xpos),
        ("elbow", data.body("lower").xpos),
        ("hand", data.body("hand").xpos),
    ):
        _, pose = nodes.getPose("root", name)
        x, y, z = there * 1000
        assert (pose.x, pose.y, pose.z) == pytest.approx((x, z, y), abs=1e-3), name
    matrix = arm.simulation.state.matrix("wrist")
    turned = axes.matrix(data.site("wrist").xpos, data.site("wrist").xmat)
    assert np.abs(matrix - turned).max() < 1e-9


def test_model_moves_free_and_mocap_bodies(arm: Served) -> None:
    nodes = arm.ports["InnerModelManager"]
    for name in ("ball", "hand"):
        nodes.setPose("root", name, arm.types.Pose3D(500.0, 700.0, -400.0, 0.0, 0.5, 0.0))
        _, pose = nodes.getPose("root", name)
        found = (pose.x, pose.y, pose.z, pose.ry)
        assert found == pytest.approx((500, 700, -400, 0.5), abs=1e-3), name


REFUSED = [
    ("setPose", ("root", "lower"), "held by the model file"),
    ("setPose", ("root", "elbow"), "JointMotor and ControlBoard move it"),
    ("removeNode", ("lower",), "is of the model file and cannot be removed"),
    ("removeNode", ("wrist",), "is of the model file and cannot be removed"),
    ("removeNode", ("eye",), "is of the model file and cannot be removed"),
    ("moveNode", ("ball", "lower"), "cannot be moved into another"),
    ("addTransform", ("cup", "", "elbow"), "is a joint of the model file"),
    ("addTransform", ("cup", "", "wrist"), "is a mark of the model file"),
    ("addTransform", ("lower", "", "root"), "there is a node `lower` already"),
    ("getPose", ("root", "nobody"), "there is no node `nobody`"),
]


@pytest.mark.parametrize(("operation", "values", "message"), REFUSED)
def test_model_inner_model_servant_reports_impossible_requests(
    arm: Served, operation: str, values: tuple[str, ...], message: str
) -> None:
    more: tuple[Any, ...] = ()
    if operation in {"setPose", "addTransform"}:
        more = (arm.types.Pose3D(0, 0, 0, 0, 0, 0),)
    with pytest.raises(arm.types.InnerModelManagerError) as raised:
        getattr(arm.ports["InnerModelManager"], operation)(*values, *more)
    assert message in raised.value.text


def test_model_adds_nodes_and_continues(arm: Served) -> None:
    """Also in a body of the model, which carries them; a joint turns in rad whatever the file."""
    nodes, motors = arm.ports["InnerModelManager"], arm.ports["JointMotor"]
    nodes.setPose("root", "hand", arm.types.Pose3D(-1500.0, 900.0, 100.0, 0, 0, 0))
    motors.setPosition(goal(arm, "shoulder", 0.9, 2.0))
    arm.simulation.advance(0.3)
    before = arm.simulation.world.time
    nodes.addTransform("cup", "", "lower", arm.types.Pose3D(100.0, 0, 0, 0, 0, 0))
    lid = arm.types.jointType(pose=arm.types.Pose3D(0, 0, 0, 0, 0, 0), min=-1.0, max=1.0, axis="y")
    nodes.addJoint("lid", "cup", lid)
    nodes.addPlane(
        "table", "root", arm.types.Plane3D(0, -1000, 0, 0, 1, 0, 500, 500, 100, "#123456")
    )
    assert arm.simulation.world.time == before
    assert nodes.getPose("root", "hand")[1].x == pytest.approx(-1500)
    motors.setPosition(goal(arm, "lid", 0.8, 3.0))
    arm.advance_until(lambda: abs(motors.getMotorState("lid").pos - 0.8) < 0.02)
    assert arm.simulation.state.joint("lid") == pytest.approx(0.8, abs=0.02)
    _, cup = nodes.getPose("lower", "cup")
    assert (cup.x, cup.y, cup.z) == pytest.approx((100, 0, 0), abs=1e-3)
    assert [getJoint.name for getJoint in arm.ports["ControlBoard"].getJoints()] == ["grip", "lid"]
    assert arm.ports["arm"].getState().position.shape == (2,)
    nodes.removeNode("cup")
    assert "lid" not in motors.getAllMotorState()


def test_model_reports_contacts(arm: Served) -> None:
    nodes = arm.ports["InnerModelManager"]
    assert not nodes.collide("ball", "upper")
    matrix = arm.simulation.state.matrix("upper")
    x, y, z = matrix[:3, 3].tolist()
    nodes.setPose("root", "ball", arm.types.Pose3D(x, y, z, 0, 0, 0))
    assert nodes.collide("ball", "upper")


def test_model_resets_restores_snapshot_and_forks(arm: Served) -> None:
    world, motors = arm.ports["Simulation"], arm.ports["JointMotor"]
    fork = world.fork()
    world.move(fork, ["shoulder", "grip"], [1.0, 30.0])
    world.advance(fork, 3.0)
    assert world.getJoints(fork, ["shoulder", "grip"]) == pytest.approx((1.0, 30.0), abs=0.5)
    assert world.getJoints(0, ["shoulder"]) == pytest.approx((0.5,), abs=1e-6)
    saved = world.snapshot()
    motors.setPosition(goal(arm, "shoulder", 1.0, 3.0))
    arm.simulation.advance(1.0)
    world.restore(saved)
    assert world.getJoints(0, ["shoulder"]) == pytest.approx((0.5,), abs=1e-6)
    motors.setPosition(goal(arm, "shoulder", 1.0, 3.0))
    arm.simulation.advance(1.0)
    world.reset()
    assert world.getJoints(0, ["shoulder", "elbow"]).tolist() == [0.5, -1.0]
    assert world.getState().time == 0.0


def test_model_file_is_read_again_after_change(tmp_path: Path) -> None:
    """A world that is built again does not read its file again, but for another one."""
    arm = served_model(tmp_path, ARM)
    model = arm.simulation.world.model
    arm.ports["Simulation"].reset()
    assert arm.simulation.world.model is not model
    file = package_in(tmp_path) / "model.xml"
    file.write_text(ARM.replace('mass="0.3"', 'mass="0.6"'))
    stamp = file.stat().st_mtime_ns + 1_000_000_000
    os.utime(file, ns=(stamp, stamp))
    arm.ports["Simulation"].reset()
    assert arm.simulation.world.model.body("lower").mass[0] == pytest.approx(0.6)


def test_model_is_bit_identical_for_same_seed_and_commands(tmp_path: Path) -> None:
    runs = []
    for name in "ab":
        folder = tmp_path / name
        folder.mkdir()
        arm = served_model(folder, ARM)
        arm.ports["JointMotor"].setPosition(goal(arm, "elbow", -0.2, 3.0))
        arm.simulation.advance(0.5)
        runs.append(arm.simulation.world.data.qpos.tobytes())
    assert runs[0] == runs[1]


def test_model_of_file_is_simulated_unchanged(arm: Served) -> None:
    """But for motors and the numbers that are served, nothing is changed in it."""
    own, model = mujoco.MjModel.from_xml_string(ARM), arm.simulation.world.model
    for what in ("body_mass", "body_pos", "jnt_range", "geom_size", "dof_damping", "geom_friction"):
        assert np.array_equal(getattr(own, what), getattr(model, what)), what
    assert model.opt.timestep == own.opt.timestep
