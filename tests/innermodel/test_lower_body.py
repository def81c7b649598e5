"""From InnerModel text to frames, shapes and devices, and on to MuJoCo."""

import json
import math
import warnings
from pathlib import Path

import mujoco
import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from robocomp_dsl.check.passes import check_innermodel
from robocomp_dsl.check.workspace.workspace import Workspace
from robocomp_dsl.diagnostics import Report
from robocomp_dsl.generate.scene.scene import lower_body
from robocomp_dsl.hardware.description.scene import Box, Device, Frame, Mesh, Motion, Scene
from robocomp_dsl.hardware.kinematics.transforms import TransformTree
from robocomp_dsl.simulation.scene import axes
from robocomp_dsl.simulation.scene.scene_spec import build_spec

WORLD = """\
<innerModel>
  <transform id="floor">
    <plane id="floor_plane" ny="1" size="10000,10000,50" texture="#886644" repeat="1"/>
  </transform>
  <differentialrobot id="robot" port="10004" tx="500" tz="-300" ry="0.5">
    <translation id="laser_pose" ty="140" tz="200">
      <laser id="laser" port="10003" measures="100" min="100" max="30000" angle="3"/>
    </translation>
    <mesh id="hull" file="robot.osg" scale="5" tx="1" ry="0.5" collide="1"/>
    <rotation id="mast" rx="-0.3">
      <joint id="pan" axis="y" min="-1" max="1" ty="900" ry="0.25" home="0.1">
        <motor id="drive" force="12" gear="3"/>
        <prismaticjoint id="lift" axis="y" position="40" offset="15" min="0" max="200">
          <rgbd id="eye" width="640" height="480" focal="500" port="10096" noise="2"/>
          <axes id="show" length="100"/>
        </prismaticjoint>
      </joint>
    </rotation>
  </differentialrobot>
  <transform id="ball" engine="bullet" mass="0.3" ty="1000"/>
</innerModel>
"""


@pytest.fixture
def scene(tmp_path: Path) -> Scene:
    path = tmp_path / "world.xml"
    path.write_text(WORLD)
    report = Report()
    found = check_innermodel(path, Workspace(environ={}), report)
    assert [d.message for d in report] == []
    assert found is not None
    return Scene.of_data(json.loads(json.dumps(lower_body(found))))


def test_lower_body_gives_frames(scene: Scene) -> None:
    lift = Motion("slide", "y", 0, 200, home=40, offset=15)
    pan = Motion("hinge", "y", -1, 1, home=0.1, force=12, gear=3)
    assert scene.frames == (
        Frame("root", ""),
        Frame("floor"),
        Frame("robot", "root", (500, 0, -300), (0, 0.5, 0), drives=True),
        Frame("laser_pose", "robot", (0, 140, 200)),
        Frame("mast", "robot", turn=(-0.3, 0, 0)),
        Frame("pan", "mast", (0, 900, 0), (0, 0.1, 0), pan),
        Frame("lift", "pan", (0, 55, 0), motion=lift),
        Frame("ball", "root", (0, 1000, 0), physics=True, mass=0.3),
    )


def test_lower_body_gives_boxes_and_meshes(scene: Scene, tmp_path: Path) -> None:
    floor, x, y, z = scene.boxes
    assert floor == Box(
        "floor_plane", "floor", (10000, 10000, 50), normal=(0, 1, 0), colour="#886644"
    )
    assert x == Box("show.x", "lift", (100, 15, 15), (50, 0, 0), colour="#ff0000")
    assert (y.size, z.place) == ((15, 100, 15), (0, 0, 50))
    hull = str(tmp_path / "robot.osg")
    assert scene.meshes == (
        Mesh("hull", "robot", hull, (1, 0, 0), (0, 0.5, 0), (5, 5, 5), collide=True),
    )


def test_lower_body_gives_devices(scene: Scene) -> None:
    found = {device.id: device for device in scene.devices}
    assert list(found) == ["robot", "laser", "pan", "lift", "eye"]
    assert found["laser"] == Device(
        "laser",
        "laser",
        "laser_pose",
        {"port": 10003, "measures": 100, "min": 100, "max": 30000, "angle": 3.0, "ifconfig": ""}
        | {"noise": 0.0},
    )
    assert (found["eye"].kind, found["eye"].frame) == ("rgbd", "lift")
    assert found["pan"].frame == "pan"


def test_scene_has_equal_poses_in_mujoco(scene: Scene) -> None:
    spec, notes = build_spec(scene)
    assert notes == []  # the mesh that is not there is the concern of the search for files
    model = spec.compile()
    data = mujoco.MjData(model)
    mujoco.mj_kinematics(model, data)
    tree = TransformTree(scene.frames)
    for frame in scene.frames[1:]:
        body = model.body(frame.id).id
        found = axes.matrix(data.xpos[body], data.xmat[body])
        assert found[:3, :3] == pytest.approx(tree.matrix(frame.id, "root")[:3, :3], abs=1e-9)
        assert found[:3, 3] == pytest.approx(tree.matrix(frame.id, "root")[:3, 3], abs=1e-6)


def test_transform_tree_transforms_point(scene: Scene) -> None:
    """The laser is 200 mm ahead of a robot that heads 0.5 rad to the right."""
    tree = TransformTree(scene.frames)
    found = tree.transform((0, 0, 1000), "laser_pose", "root")
    expected = (500 + 1200 * math.sin(0.5), 140, -300 + 1200 * math.cos(0.5))
    assert found == pytest.approx(expected)
    assert np.allclose(tree.transform(found, "root", "laser_pose"), (0, 0, 1000))


PIECES = [
    "inf", "1e300", "-1", "0", '"', "<", ">", "/>", "</joint>", "<plane id='p' size='0'/>", "root",
    'mass="1e9"', 'scale="0,1,1"', 'ny="1e-200"', '<transform id="robot">', 'axis="x"', "é", "",
]  # fmt: skip

CUTS = st.tuples(
    st.integers(0, len(WORLD)), st.sampled_from([0, 0, 1, 3, 10, 40]), st.sampled_from(PIECES)
)


@settings(max_examples=80)
@given(st.lists(CUTS, min_size=1, max_size=6))
def test_lower_body_of_damaged_text_gives_world(cuts: list[tuple[int, int, str]]) -> None:
    text = WORLD
    for at, length, piece in cuts:
        text = text[:at] + piece + text[at + length :]
    workspace = Workspace(environ={})
    path = Path("world.xml")
    workspace.sources.set_overlay(path, text)
    found = check_innermodel(path, workspace, Report())
    assert found is not None
    scene = Scene.of_data(json.loads(json.dumps(lower_body(found))))
    spec, _ = build_spec(scene)
    with warnings.catch_warnings(action="ignore"):  # of inertias, where masses are absurd
        assert spec.compile().nbody == len(scene.frames)
    assert len(TransformTree(scene.frames)) == len(scene.frames)
