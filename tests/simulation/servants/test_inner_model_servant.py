"""`InnerModelManager`: the nodes of a running world, read and changed while it goes on."""

from __future__ import annotations

import math
from pathlib import Path
from typing import Any

import numpy as np
import pytest

from robocomp_dsl.hardware.kinematics.transforms import TransformTree
from tests.hardware.mesh_files import TETRAHEDRA
from tests.simulation.served_worlds import ROOM, Served, served

CUBE = "solid c\n" + "\n".join(
    f"vertex {x} {y} {z}"
    for a, b, c in [
        ((0, 0, 0), (1, 0, 0), (0, 1, 0)),
        ((0, 0, 0), (0, 1, 0), (0, 0, 1)),
        ((0, 0, 0), (0, 0, 1), (1, 0, 0)),
        ((1, 0, 0), (0, 0, 1), (0, 1, 0)),
    ]
    for x, y, z in (a, b, c)
)


@pytest.fixture
def world(tmp_path: Path) -> Served:
    return served(tmp_path, ROOM)


def pose(world: Served, *numbers: float) -> Any:
    return world.types.Pose3D(*numbers)


def plane(world: Served, **values: Any) -> Any:
    usual = {"ny": 1.0, "width": 500.0, "height": 500.0, "thickness": 100.0, "texture": "#ff0000"}
    return world.types.Plane3D(**usual | values)


def mistake(world: Served, operation: str, *arguments: Any) -> str:
    with pytest.raises(world.types.InnerModelManagerError) as raised:
        getattr(world.ports["InnerModelManager"], operation)(*arguments)
    assert raised.value.text
    return str(raised.value.err.name)


def test_inner_model_servant_lists_nodes_depth_first(world: Served) -> None:
    nodes = world.ports["InnerModelManager"].getAllNodeInformation()
    found = [(node.id, node.parentId, node.nType.name) for node in nodes]
    assert found[:4] == [
        ("root", "", "Transform"),
        ("floor", "root", "Transform"),
        ("robot", "floor", "DifferentialRobot"),
        ("laser_pose", "robot", "Transform"),
    ]
    assert ("laser", "laser_pose", "Laser") in found
    assert ("neck", "robot", "Joint") in found
    assert ("wall", "floor", "Plane") in found


def test_inner_model_servant_poses_match_transform_tree(world: Served) -> None:
    nodes = world.ports["InnerModelManager"]
    tree = TransformTree(world.simulation.state.scene.frames)
    for base, frame in (("robot", "laser_pose"), ("laser_pose", "platform"), ("root", "neck")):
        done, found = nodes.getPose(base, frame)
        assert done
        assert [found.x, found.y, found.z, found.rx, found.ry, found.rz] == pytest.approx(
            list(tree.pose(frame, base)), abs=1e-6
        )
        point = world.types.coord3D(10.0, 20.0, 30.0)
        _, seen = nodes.transform(base, frame, point)
        expected = tree.transform((10, 20, 30), frame, base)
        assert [seen.x, seen.y, seen.z] == pytest.approx(expected, abs=1e-6)
        matrix = nodes.getTransformationMatrix(base, frame)
        assert (matrix.rows, matrix.cols) == (4, 4)
        assert matrix.data.reshape(4, 4) == pytest.approx(tree.matrix(frame, base), abs=1e-3)


def test_inner_model_servant_poses_follow_physics(world: Served) -> None:
    world.ports["robot"].setSpeedBase(400.0, 0.0)
    world.simulation.advance(1.0)
    _, found = world.ports["InnerModelManager"].getPose("floor", "robot")
    assert found.z == pytest.approx(world.ports["robot"].getBaseState().correctedZ, abs=1e-3)
    assert found.z > -100


def test_inner_model_servant_adds_and_removes_obstacle_of_laser(world: Served) -> None:
    nodes, laser = world.ports["InnerModelManager"], world.ports["laser"]
    assert nodes.addPlane("crate", "floor", plane(world, px=500.0, py=100.0, pz=1000.0, height=400))
    world.simulation.advance(0.1)
    near = laser.getLaserData().dist[50]
    assert near < 1100
    assert nodes.removeNode("crate")
    world.simulation.advance(0.1)
    assert laser.getLaserData().dist[50] == pytest.approx(3100, abs=1)


def test_inner_model_servant_keeps_motion_when_node_is_added(world: Served) -> None:
    base, nodes = world.ports["robot"], world.ports["InnerModelManager"]
    base.setSpeedBase(400.0, 0.0)
    world.ports["JointMotor"].setPosition(world.types.MotorGoalPosition("neck", 0.8, 0.4))
    world.simulation.advance(1.0)
    before, time = base.getBaseState(), world.simulation.world.time
    neck = world.ports["JointMotor"].getMotorState("neck").pos
    nodes.addTransform("mark", "static", "robot", pose(world, 0, 500, 0, 0, 0, 0))
    after = base.getBaseState()
    assert (after.x, after.z) == (before.x, before.z)
    assert (after.correctedZ, after.advVz) == pytest.approx((before.correctedZ, 400), abs=1)
    assert world.simulation.world.time == time
    world.simulation.advance(0.5)
    assert base.getBaseState().correctedZ == pytest.approx(before.correctedZ + 200, abs=2)
    assert world.ports["JointMotor"].getMotorState("neck").pos > neck + 0.1
    _, mark = nodes.getPose("robot", "mark")
    assert (mark.x, mark.y, mark.z) == pytest.approx((0, 500, 0), abs=1e-6)


def test_inner_model_servant_moves_base_without_acceleration(world: Served) -> None:
    nodes, base = world.ports["InnerModelManager"], world.ports["robot"]
    nodes.setPose("root", "robot", pose(world, 1000, 0, 500, 0, 1.0, 0))
    world.simulation.advance(0.1)
    state = base.getBaseState()
    assert (state.x, state.z, state.alpha) == pytest.approx((0, 0, 0), abs=1e-3)
    found = (state.correctedX, state.correctedZ, state.correctedAlpha)
    assert found == pytest.approx((1000, 500, 1.0), abs=1e-3)
    base.setSpeedBase(400.0, 0.0)  # ahead is now where it was turned to
    world.simulation.advance(1.0)
    state = base.getBaseState()
    way = math.hypot(state.correctedX - 1000, state.correctedZ - 500)
    assert state.correctedX - 1000 == pytest.approx(way * math.sin(1.0), abs=1)
    world.ports["Simulation"].reset()
    assert base.getBaseState().correctedX == pytest.approx(1000, abs=1e-3)


def test_inner_model_servant_sets_joint_that_stays(world: Served) -> None:
    nodes = world.ports["InnerModelManager"]
    nodes.setPoseFromParent("neck", pose(world, 0, 0, 0, 0, 0.6, 0))
    world.simulation.advance(0.5)
    assert world.ports["JointMotor"].getMotorState("neck").pos == pytest.approx(0.6, abs=1e-3)


def test_inner_model_servant_adds_ball_that_falls(world: Served) -> None:
    nodes = world.ports["InnerModelManager"]
    nodes.addTransform("ball", "bullet", "root", pose(world, 0, 2000, 0, 0, 0, 0))
    world.simulation.advance(0.3)
    _, found = nodes.getPose("root", "ball")
    assert found.y == pytest.approx(2000 - 9810 * 0.3**2 / 2, rel=0.01)
    nodes.setPose("root", "ball", pose(world, 0, 3000, 0, 0, 0, 0))
    _, found = nodes.getPose("root", "ball")
    assert found.y == pytest.approx(3000)


def test_inner_model_servant_adds_joint_that_moves(world: Served) -> None:
    nodes, motors, i = world.ports["InnerModelManager"], world.ports["JointMotor"], world.types
    joint = i.jointType(pose=pose(world, 0, 300, 0, 0, 0, 0), min=-1.0, max=1.0, axis="x")
    nodes.addJoint("nod", "neck", joint)
    motors.setPosition(i.MotorGoalPosition("nod", 0.5, 0))
    world.advance_until(lambda: motors.getMotorState("nod").pos > 0.49)
    nodes.removeNode("neck")
    with pytest.raises(Exception, match="no joints"):
        motors.getMotorState("nod")


def test_inner_model_servant_adds_scaled_mesh_that_collides(world: Served, tmp_path: Path) -> None:
    nodes, i = world.ports["InnerModelManager"], world.types
    (tmp_path / "cube.stl").write_text(CUBE)
    mesh = i.meshType(
        pose(world, -3000, 0, 0, 0, 0, 0), 100, 100, 100, 0, str(tmp_path / "cube.stl")
    )
    nodes.addMesh("block", "floor", mesh)
    nodes.addPlane("post", "floor", plane(world, px=-2700.0, py=0.0, width=100, height=100))
    assert not nodes.collide("block", "post")
    nodes.setScale("block", 400.0, 400.0, 400.0)
    assert nodes.collide("block", "post")
    assert nodes.collide("floor", "post")
    nodes.setPlane("post", plane(world, px=-2000.0, py=0.0, width=100, height=100))
    assert not nodes.collide("block", "post")


def test_inner_model_servant_moves_subtree_to_another_parent(world: Served) -> None:
    nodes = world.ports["InnerModelManager"]
    nodes.moveNode("laser_pose", "platform")
    _, found = nodes.getPose("platform", "laser_pose")
    assert (found.x, found.y, found.z) == pytest.approx((0, 140, 200), abs=1e-6)
    world.simulation.advance(0.1)
    assert world.ports["laser"].getLaserData().dist[50] == pytest.approx(2800, abs=1)


def test_inner_model_servant_adds_and_removes_attributes(world: Served) -> None:
    nodes = world.ports["InnerModelManager"]
    nodes.addAttribute("robot", "colour", "string", "red")
    assert mistake(world, "addAttribute", "robot", "colour", "string", "blue") == (
        "AttributeAlreadyExists"
    )
    nodes.setAttribute("robot", "colour", "string", "blue")
    assert nodes.getAttribute("robot", "colour") == (True, "string", "blue")
    received = {node.id: node.attributes for node in nodes.getAllNodeInformation()}
    assert received["robot"]["colour"].value == "blue"
    nodes.removeAttribute("robot", "colour")
    assert mistake(world, "getAttribute", "robot", "colour") == "NonExistingAttribute"


def test_inner_model_servant_removes_nodes_for_other_servants(world: Served) -> None:
    world.ports["InnerModelManager"].removeNode("robot")
    assert mistake(world, "getPose", "root", "robot") == "NonExistingNode"
    with pytest.raises(Exception, match="removed") as raised:
        world.ports["robot"].setSpeedBase(1.0, 0.0)
    assert type(raised.value).__name__.endswith("HardwareFailedException")
    world.simulation.advance(0.5)
    world.ports["platform"].setSpeedBase(100.0, 0.0, 0.0)


MISTAKES = [
    ("addTransform", ("robot", "static", "root", 0), "NodeAlreadyExists"),
    ("addTransform", ("new", "static", "nowhere", 0), "NonExistingNode"),
    ("addTransform", ("new", "static", "wall", 0), "OperationInvalidNode"),
    ("addTransform", ("new", "static", "root", math.nan), "InvalidValues"),
    ("addTransform", ("", "static", "root", 0), "InvalidValues"),
    ("setPose", ("root", "nobody", 0), "NonExistingNode"),
    ("setPose", ("root", "wall", 0), "OperationInvalidNode"),
    ("setPose", ("robot", "root", 0), "OperationInvalidNode"),
    ("setPose", ("root", "robot", math.inf), "InvalidValues"),
    ("getPose", ("root", "nobody"), "NonExistingNode"),
    ("setScale", ("wall", 1.0, 1.0, 1.0), "OperationInvalidNode"),
    ("setScale", ("nobody", 1.0, 1.0, 1.0), "NonExistingNode"),
    ("removeNode", ("root",), "OperationInvalidNode"),
    ("removeNode", ("nobody",), "NonExistingNode"),
    ("moveNode", ("floor", "robot"), "OperationInvalidNode"),
    ("moveNode", ("root", "robot"), "OperationInvalidNode"),
    ("addAttribute", ("nobody", "a", "int", "1"), "NonExistingNode"),
]


@pytest.mark.parametrize(("operation", "values", "error"), MISTAKES)
def test_inner_model_servant_reports_error_codes_and_changes_nothing(
    world: Served, operation: str, values: tuple[Any, ...], error: str
) -> None:
    scene = world.simulation.state.scene
    if operation in ("addTransform", "setPose"):
        values = (*values[:-1], pose(world, values[-1], 0, 0, 0, 0, 0))
    assert mistake(world, operation, *values) == error
    assert world.simulation.state.scene is scene
    world.simulation.advance(0.1)
    assert np.isfinite(world.simulation.world.data.qpos).all()


def test_inner_model_servant_finds_mesh_of_other_computer(
    world: Served, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    (tmp_path / "osgModels").mkdir()
    (tmp_path / "osgModels" / "a.3ds").write_bytes(TETRAHEDRA["a.3ds"])
    path = "/home/robocomp/robocomp/files/osgModels/a.3ds"
    mesh = world.types.meshType(pose(world, 0, 0, 0, 0, 0, 0), 1, 1, 1, 0, path)
    assert mistake(world, "addMesh", "new", "root", mesh) == "InvalidPath"
    monkeypatch.setenv("ROBOCOMP_FILES", str(tmp_path))
    assert world.ports["InnerModelManager"].addMesh("new", "root", mesh)


def test_inner_model_servant_reports_unreadable_mesh_as_invalid_path(world: Served) -> None:
    mesh = world.types.meshType(pose(world, 0, 0, 0, 0, 0, 0), 1, 1, 1, 0, "/nowhere.stl")
    assert mistake(world, "addMesh", "new", "root", mesh) == "InvalidPath"
    mesh.scaleX = -1.0
    assert mistake(world, "addMesh", "new", "root", mesh) == "InvalidValues"
