"""Bodies with the engine `bullet` fall wherever nothing else moves them."""

from __future__ import annotations

import math
from pathlib import Path
from typing import Any

import pytest

from robocomp_dsl.hardware.description.falling import carrier, falls, loads
from robocomp_dsl.hardware.description.scene import Frame, Motion
from robocomp_dsl.simulation.scene.scene_spec import build_spec
from tests.simulation.served_worlds import Served, scene_of, served, served_model

G = 9810.0  # mm/s²

WORLD = """\
<innerModel>
  <transform id="world">
    <transform id="floor">
      <plane id="ground" ny="1" size="20000,20000,100" py="-50" collide="1"/>
    </transform>
    <transform id="room" tx="1000" ty="500" ry="1.5707963267948966">
      <transform id="shelf" ty="1000" rz="0.5">
        <transform id="ball" engine="bullet" mass="2" tx="100">
          <plane id="hull" size="100,100,100" collide="1"/>
          <transform id="sticker" ty="50" mass="1"/>
        </transform>
      </transform>
      <transform id="cup" engine="bullet" mass="0.3" tz="-2000" ty="2000"/>
    </transform>
    <differentialrobot id="robot" tx="-4000">
      <joint id="arm" axis="x" ty="900">
        <transform id="tray" engine="bullet" mass="1" tz="100"/>
      </joint>
    </differentialrobot>
  </transform>
</innerModel>
"""
TRAY = "`tray` is in a frame that moves: it is carried, and does not fall"


@pytest.fixture
def world(tmp_path: Path) -> Served:
    return served(tmp_path, WORLD)


def position(world: Served, item: str, base: str = "root") -> tuple[float, float, float]:
    _, pose = world.ports["InnerModelManager"].getPose(base, item)
    return pose.x, pose.y, pose.z


def pose(world: Served, *numbers: float) -> Any:
    return world.types.Pose3D(*numbers)


def test_bodies_below_nested_transforms_start_there_and_fall(world: Served) -> None:
    assert world.simulation.notes == [TRAY]
    ball = (1000.0, 1500 + 100 * math.sin(0.5), -100 * math.cos(0.5))
    assert position(world, "ball") == pytest.approx(ball, abs=1e-6)
    assert position(world, "ball", "shelf") == pytest.approx((100, 0, 0), abs=1e-6)
    assert position(world, "cup") == pytest.approx((-1000, 2500, 0), abs=1e-6)
    world.simulation.advance(0.3)
    drop = G * 0.3**2 / 2
    x, y, z = ball
    assert position(world, "ball") == pytest.approx((x, y - drop, z), rel=0.01)
    assert position(world, "cup") == pytest.approx((-1000, 2500 - drop, 0), rel=0.01)


def test_body_below_world_comes_to_rest_on_floor(world: Served) -> None:
    world.advance_until(lambda: position(world, "ball")[1] < 60)
    world.simulation.advance(1.0)
    resting = position(world, "ball")[1]
    assert 40 < resting < 90
    world.simulation.advance(1.0)
    assert position(world, "ball")[1] == pytest.approx(resting, abs=2)


def test_body_carried_by_joint_does_not_fall(world: Served) -> None:
    before = position(world, "tray", "arm")
    world.simulation.advance(0.5)
    assert position(world, "tray", "arm") == pytest.approx(before, abs=1e-6)
    assert position(world, "tray")[1] == pytest.approx(900, abs=1)


@pytest.mark.parametrize("base", ["root", "world", "floor", "shelf"])
def test_body_added_at_run_time_falls(world: Served, base: str) -> None:
    nodes = world.ports["InnerModelManager"]
    nodes.addTransform("drop", "bullet", base, pose(world, 500, 3000, 700, 0, 0, 0))
    x, y, z = position(world, "drop")
    assert position(world, "drop", base) == pytest.approx((500, 3000, 700), abs=1e-6)
    world.simulation.advance(0.3)
    assert position(world, "drop") == pytest.approx((x, y - G * 0.3**2 / 2, z), rel=0.01)


def test_body_below_nested_transforms_is_placed_in_any_frame(world: Served) -> None:
    nodes = world.ports["InnerModelManager"]
    world.simulation.advance(0.2)
    for base in ("root", "shelf", "robot", "room"):
        nodes.setPose(base, "ball", pose(world, 200, 3000, 300, 0.1, 0.2, 0.3))
        assert position(world, "ball", base) == pytest.approx((200, 3000, 300), abs=1e-6)
    x, y, z = position(world, "ball")
    world.simulation.advance(0.3)
    assert position(world, "ball") == pytest.approx((x, y - G * 0.3**2 / 2, z), rel=0.01)


def test_fallen_body_moves_to_another_parent_with_its_present_local_pose(world: Served) -> None:
    nodes = world.ports["InnerModelManager"]
    world.simulation.advance(0.3)
    _, before = nodes.getPoseFromParent("cup")
    assert before.y == pytest.approx(2000 - G * 0.3**2 / 2, rel=0.01)
    nodes.moveNode("cup", "arm")  # gripped: it is carried from now on
    for _ in range(2):
        _, after = nodes.getPoseFromParent("cup")
        assert (after.x, after.y, after.z) == pytest.approx(
            (before.x, before.y, before.z), abs=1e-3
        )
        world.simulation.advance(0.3)
    nodes.moveNode("cup", "world")  # and released
    released = position(world, "cup")
    assert released == pytest.approx((before.x, before.y, before.z), abs=1e-3)
    world.simulation.advance(0.2)
    x, y, z = released
    assert position(world, "cup") == pytest.approx((x, y - G * 0.2**2 / 2, z), rel=0.01)


def test_falling_body_keeps_its_motion_when_another_node_is_added(world: Served) -> None:
    nodes = world.ports["InnerModelManager"]
    world.simulation.advance(0.2)
    nodes.addTransform("mark", "static", "shelf", pose(world, 0, 0, 0, 0, 0, 0))
    world.simulation.advance(0.1)
    assert position(world, "cup")[1] == pytest.approx(2500 - G * 0.3**2 / 2, rel=0.01)


def test_reset_returns_falling_bodies_to_their_frames(world: Served) -> None:
    before = position(world, "ball")
    world.simulation.advance(0.3)
    world.ports["Simulation"].reset()
    assert position(world, "ball") == pytest.approx(before, abs=1e-6)


def test_light_body_with_parts_falls_with_whole_gravity(tmp_path: Path) -> None:
    """Its parts are a load: their weight is not compensated as that of a robot's frames is."""
    text = """<innerModel><transform id="world"><transform id="crate" engine="bullet" ty="3000">
      <transform id="lid" ty="100"><transform id="knob" ty="20" mass="0.5"/></transform>
    </transform></transform></innerModel>"""
    world = served(tmp_path, text)
    world.simulation.advance(0.3)
    assert position(world, "crate")[1] == pytest.approx(3000 - G * 0.3**2 / 2, rel=0.01)


def test_two_bodies_in_one_another_fall_together(tmp_path: Path) -> None:
    text = """<innerModel><transform id="world">
      <transform id="box" engine="bullet" mass="1" ty="3000">
        <transform id="content" engine="bullet" mass="1" tx="50"/>
      </transform></transform></innerModel>"""
    world = served(tmp_path, text)
    world.simulation.advance(0.3)
    assert position(world, "box")[1] == pytest.approx(3000 - G * 0.3**2 / 2, rel=0.01)
    assert position(world, "content", "box") == pytest.approx((50, 0, 0), abs=1e-6)


def test_body_added_to_fixed_body_of_model_file_falls(tmp_path: Path) -> None:
    text = """<mujoco><worldbody>
      <body name="table" pos="1 0 0.5" euler="0 0 90"><geom type="box" size=".3 .3 .02"/>
        <body name="top" pos="0 0 .1"/></body>
      <body name="link" pos="0 0 2"><joint name="hinge" axis="0 1 0"/><geom size=".05"/></body>
    </worldbody></mujoco>"""
    world = served_model(tmp_path, text)
    nodes = world.ports["InnerModelManager"]
    nodes.addTransform("apple", "bullet", "top", pose(world, 200, 1000, 0, 0, 0, 0))
    assert position(world, "apple", "top") == pytest.approx((200, 1000, 0), abs=1e-6)
    x, y, z = position(world, "apple")
    assert y == pytest.approx(1600)
    world.simulation.advance(0.3)
    assert position(world, "apple") == pytest.approx((x, y - G * 0.3**2 / 2, z), rel=0.01)
    nodes.addTransform("hook", "bullet", "link", pose(world, 0, 0, 100, 0, 0, 0))
    world.simulation.advance(0.1)
    assert position(world, "hook", "link") == pytest.approx((0, 0, 100), abs=1e-6)


def test_laser_on_falling_body_below_world_does_not_see_it(tmp_path: Path) -> None:
    text = """<innerModel><transform id="world">
      <transform id="drone" engine="bullet" mass="1" ty="3000">
        <plane id="shell" nz="-1" size="400,400,400" collide="1"/>
        <transform id="eye"><laser id="laser" measures="5" max="4000" angle="1"/></transform>
      </transform></transform></innerModel>"""
    world = served(tmp_path, text)
    assert [item.dist for item in world.ports["laser"].getLaserData()] == [4000] * 5


def test_falls_needs_fixed_frames_above() -> None:
    hinge = Motion("hinge", "x")
    frames = {
        frame.id: frame
        for frame in (
            Frame("root", ""),
            Frame("room", "root"),
            Frame("ball", "room", physics=True),
            Frame("seam", "ball"),
            Frame("valve", "seam", motion=hinge),
            Frame("cap", "valve"),
            Frame("door", "room", motion=hinge),
            Frame("handle", "door", physics=True),
            Frame("inner", "ball", physics=True),
        )
    }
    assert [name for name, frame in frames.items() if falls(frame, frames)] == ["ball"]
    assert loads(frames.values()) == {"ball", "seam", "inner"}
    assert carrier("cap", frames) == "ball"
    assert carrier("handle", frames) == "handle"


def test_build_spec_notes_falling_body_without_mass(tmp_path: Path) -> None:
    text = """<innerModel><transform id="world">
      <transform id="ball" engine="bullet"/></transform></innerModel>"""
    _, notes = build_spec(scene_of(tmp_path / "world.xml", text))
    assert notes == ["`ball` falls and has no mass: it gets 0.001 kg"]
