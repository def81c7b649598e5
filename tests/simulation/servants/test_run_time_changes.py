"""Changes of a running world: devices move with their nodes, impossible values are rejected."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import numpy as np
import pytest

from robocomp_dsl.hardware.description.scene import Frame, Model, Scene
from robocomp_dsl.simulation.world.limits import clamp_scene
from tests.simulation.served_worlds import Served, served, served_model

WORLD = """\
<innerModel>
  <transform id="world">
    <plane id="wall" nz="-1" pz="3025" py="500" size="6000,1000,50" collide="1"/>
    <differentialrobot id="robot" ry="0.5">
      <transform id="mast" ty="500">
        <laser id="laser" measures="3" max="9000" angle="0.2"/>
        <imu id="imu"/>
      </transform>
    </differentialrobot>
    <omnirobot id="platform" tx="-1000" tz="1000">
      <plane id="shell" nz="-1" py="500" pz="600" size="300,300,50" collide="1"/>
    </omnirobot>
    <transform id="rocket" engine="bullet" mass="1" ty="5000" rx="0.3"/>
  </transform>
</innerModel>
"""


@pytest.fixture
def world(tmp_path: Path) -> Served:
    return served(tmp_path, WORLD)


def pose(world: Served, *numbers: float) -> Any:
    return world.types.Pose3D(*numbers)


def mistake(world: Served, operation: str, *arguments: Any) -> tuple[str, str]:
    with pytest.raises(world.types.InnerModelManagerError) as raised:
        getattr(world.ports["InnerModelManager"], operation)(*arguments)
    return raised.value.err.name, raised.value.text


def test_sensor_measures_in_the_frame_to_which_it_is_moved(world: Served) -> None:
    nodes, imu = world.ports["InnerModelManager"], world.ports["imu"]
    assert imu.getOrientation().Yaw == pytest.approx(0.5)
    nodes.moveNode("imu", "rocket")
    world.simulation.advance(0.1)
    assert imu.getOrientation().Pitch == pytest.approx(0.3)
    acceleration = imu.getAcceleration()  # it falls
    felt = (acceleration.XAcc, acceleration.YAcc, acceleration.ZAcc)
    assert felt == pytest.approx((0, 0, 0), abs=1e-3)
    nodes.moveNode("imu", "platform")
    assert imu.getOrientation().Yaw == pytest.approx(0.0)
    assert imu.getAcceleration().YAcc == pytest.approx(9.81)


@pytest.mark.parametrize("node", ["mast", "laser"])
def test_laser_ignores_the_robot_to_which_it_is_moved(world: Served, node: str) -> None:
    """The shell of the platform is 600 mm in front of it, the wall 2000 mm."""
    world.ports["InnerModelManager"].moveNode(node, "platform")
    if node == "laser":
        world.ports["InnerModelManager"].setPose(
            "world", "platform", pose(world, 0, 500, 1000, 0, 0, 0)
        )
    world.simulation.advance(0.1)
    assert world.ports["laser"].getLaserData()[1].dist == pytest.approx(2000, abs=1)


def test_device_that_is_not_moved_keeps_its_reference(world: Served) -> None:
    imu = world.ports["imu"]
    imu.resetImu()
    assert imu.getOrientation().Yaw == pytest.approx(0.0)
    world.ports["InnerModelManager"].addTransform(
        "mark", "static", "world", pose(world, 0, 0, 0, 0, 0, 0)
    )
    assert imu.getOrientation().Yaw == pytest.approx(0.0)


def test_added_node_may_have_the_name_of_a_joint_of_a_base(world: Served) -> None:
    base = world.ports["robot"]
    base.setSpeedBase(400.0, 0.0)
    world.simulation.advance(1.0)
    base.setSpeedBase(0.0, 1.0)
    world.simulation.advance(1.0)
    before = base.getBaseState()
    for name in ("robot.x", "robot.z", "robot.alpha"):
        world.ports["InnerModelManager"].addTransform(
            name, "bullet", "world", pose(world, 0, 1000, 0, 0, 0, 0)
        )
    after = base.getBaseState()
    for name in ("correctedX", "correctedZ"):
        assert getattr(after, name) == pytest.approx(getattr(before, name), abs=1)
    assert after.correctedAlpha == pytest.approx(before.correctedAlpha, abs=0.01)


@pytest.mark.parametrize("engine", ["bulet", "Bullet", "ode"])
def test_add_transform_rejects_unknown_engine(world: Served, engine: str) -> None:
    code, text = mistake(world, "addTransform", "a", engine, "world", pose(world, 0, 0, 0, 0, 0, 0))
    assert (code, text) == ("InvalidEngine", f"there is no engine `{engine}`: static or bullet")
    for accepted in ("", "static", "bullet"):
        name = f"a{accepted}"
        world.ports["InnerModelManager"].addTransform(
            name, accepted, "world", pose(world, 0, 9, 0, 0, 0, 0)
        )


def test_changes_reject_values_that_cannot_be_simulated(world: Served) -> None:
    """They would be replaced by the largest possible ones, or destroy all other numbers."""
    i = world.types
    far, turned = pose(world, 1e12, 0, 0, 0, 0, 0), pose(world, 0, 0, 0, 1e20, 0, 0)
    plane = i.Plane3D(px=1e15, ny=1.0, width=10.0, height=10.0, thickness=10.0)
    for operation, arguments in (
        ("addTransform", ("a", "static", "world", far)),
        ("addTransform", ("a", "bullet", "world", turned)),
        ("addJoint", ("a", "world", i.jointType(pose=far, min=-1, max=1))),
        ("addPlane", ("a", "world", plane)),
        ("setPlane", ("wall", plane)),
        ("setPose", ("world", "mast", far)),
        ("setPose", ("world", "rocket", far)),
        ("setPoseFromParent", ("mast", turned)),
    ):
        code, text = mistake(world, operation, *arguments)
        assert code == "InvalidValues", operation
        assert "cannot be simulated" in text
    found = {node.id for node in world.ports["InnerModelManager"].getAllNodeInformation()}
    assert "a" not in found
    world.simulation.advance(0.1)
    assert world.ports["InnerModelManager"].getPose("world", "mast")[1].y == pytest.approx(500)


def test_clamp_scene_keeps_model_file() -> None:
    scene = Scene((Frame("root", ""), Frame("a", "root", (1e12, 0, 0))), model=Model(Path("m.xml")))
    clamped, notes = clamp_scene(scene)
    assert clamped.model == scene.model
    assert clamped.frames[1].place == (1e9, 0, 0)
    assert notes == ["`a`: `place` is 1e+09, 0, 0 here, 1e+12, 0, 0 cannot be simulated"]


def test_camera_sees_body_that_was_placed(tmp_path: Path) -> None:
    """A `mocap` body of a model file: its pose is not part of the joints."""
    text = """<mujoco><worldbody>
      <body name="target" mocap="true" pos="5 5 5">
        <geom type="box" size=".3 .3 .3" rgba="1 0 0 1"/></body>
      <camera name="eye" pos="0 0 0" euler="90 0 0" resolution="32 24"/>
    </worldbody></mujoco>"""
    world = served_model(tmp_path, text)
    world.ports["InnerModelManager"].setPose("root", "target", pose(world, 0, 0, 1500, 0, 0, 0))
    world.simulation.advance(0.1)
    image = world.simulation.devices["eye"].picture().colour.astype(int)
    middle = image[image.shape[0] // 2, image.shape[1] // 2]
    assert middle[0] - max(middle[1:]) > 100
    world.ports["InnerModelManager"].setPose("root", "target", pose(world, 0, 0, -1500, 0, 0, 0))
    world.simulation.advance(0.1)
    image = world.simulation.devices["eye"].picture().colour.astype(int)
    assert np.abs(np.diff(image, axis=2)).max() < 100
