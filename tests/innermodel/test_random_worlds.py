"""Any well-formed world: the MuJoCo model and the transform tree have equal poses."""

from pathlib import Path

import mujoco
import numpy as np
import pytest

from robocomp_dsl.check.passes import check_innermodel
from robocomp_dsl.check.workspace.workspace import Workspace
from robocomp_dsl.diagnostics import Report
from robocomp_dsl.generate.scene.scene import lower_body
from robocomp_dsl.hardware.description.scene import Scene
from robocomp_dsl.hardware.kinematics.transforms import TransformTree
from robocomp_dsl.simulation.models.model_file import compiled
from robocomp_dsl.simulation.models.model_to_transforms import model_transforms
from robocomp_dsl.simulation.scene import axes
from robocomp_dsl.simulation.scene.scene_spec import body_name, build_spec
from robocomp_dsl.simulation.world.limits import clamp_scene
from robocomp_dsl.simulation.world.simulation import Simulation
from tests.innermodel.random_worlds import random_world
from tests.innermodel.world_files import place


def load(path: Path) -> tuple[Scene, object, Report]:
    report = Report()
    body = check_innermodel(path, Workspace(()), report)
    assert body is not None
    scene, received = clamp_scene(Scene.of_data(lower_body(body)))
    spec, notes = build_spec(scene)
    assert all(isinstance(note, str) and "`" in note for note in received + notes)
    return scene, compiled(spec, []), report


def assert_equal_poses(scene: Scene, model) -> None:  # type: ignore[no-untyped-def]
    """The scene's tree, the model's transforms and MuJoCo agree on every pose."""
    data = mujoco.MjData(model)
    own, found = TransformTree(scene.frames), model_transforms(model)
    mujoco.mj_kinematics(model, data)
    found.follow(data.qpos)
    extent = max(1.0, float(np.abs(data.xpos).max()))
    for i, name in enumerate(found.bodies):
        expected = axes.matrix(data.xpos[i], data.xmat[i])
        result = found.tree.matrix(name, "root")
        assert np.abs(result[:3, :3] - expected[:3, :3]).max() < 1e-9
        assert np.abs(result[:3, 3] - expected[:3, 3]).max() * axes.MM < 1e-9 * extent
    for frame in scene.frames[1:]:
        body = model.body(body_name(frame.id)).id
        expected = axes.matrix(data.xpos[body], data.xmat[body])
        result = own.matrix(frame.id, "root")
        assert np.abs(result[:3, :3] - expected[:3, :3]).max() < 1e-9
        assert np.abs(result[:3, 3] - expected[:3, 3]).max() * axes.MM < 1e-9 * extent


@pytest.mark.parametrize("tens", range(20))
def test_random_worlds_load_with_equal_poses_in_mujoco(tmp_path: Path, tens: int) -> None:
    for seed in range(10 * tens, 10 * tens + 10):
        folder = tmp_path / str(seed)
        folder.mkdir()
        scene, model, _ = load(place(folder, random_world(seed)))
        assert_equal_poses(scene, model)


def test_random_worlds_cover_all_findings(tmp_path: Path) -> None:
    """The random worlds cause all findings of InnerModel nodes."""
    seen: set[str] = set()
    for seed in range(60):
        folder = tmp_path / str(seed)
        folder.mkdir()
        seen |= {item.code.id for item in load(place(folder, random_world(seed)))[2]}
    assert {"RC802", "RC803", "RC804", "RC805", "RC806", "RC807", "RC808"} <= seen


def test_world_of_maximum_depth_loads(tmp_path: Path) -> None:
    text = "<innerModel>" + "".join(f'<transform id="t{i}" tx="10" ry="0.1">' for i in range(199))
    path = place(tmp_path, {"world.xml": text + "</transform>" * 199 + "</innerModel>"})
    scene, model, report = load(path)
    assert not report.has_errors
    assert len(scene.frames) == 200
    assert_equal_poses(scene, model)


def test_world_including_file_twice_has_unique_names(tmp_path: Path) -> None:
    world = '<innerModel><include path="p.xml"/><include path="p.xml"/></innerModel>'
    part = '<innerModel><transform id="t"><plane id="p"/></transform></innerModel>'
    scene, model, report = load(place(tmp_path, {"world.xml": world, "p.xml": part}))
    assert [frame.id for frame in scene.frames] == ["root", "t", "t#2"]
    assert [item.code.id for item in report] == ["RC804", "RC804"]
    assert_equal_poses(scene, model)


def test_axes_boxes_get_names_unused_by_nodes(tmp_path: Path) -> None:
    world = '<innerModel><axes id="a"/><plane id="a.x"/></innerModel>'
    scene, _, _ = load(place(tmp_path, {"world.xml": world}))
    assert sorted(box.id for box in scene.boxes) == ["a.x", "a.x'", "a.y", "a.z"]


def test_world_including_itself_is_reported_and_loaded(tmp_path: Path) -> None:
    world = '<innerModel>\n<plane id="a"/>\n<include path="p.xml"/></innerModel>'
    part = '<innerModel>\n<include path="world.xml"/></innerModel>'
    scene, _, report = load(place(tmp_path, {"world.xml": world, "p.xml": part}))
    assert len(scene.boxes) == 1
    (found,) = report
    assert "includes itself through `p.xml`" in found.message
    assert found.span.source.path.name == "p.xml"


def test_world_of_thousands_of_nodes_loads(tmp_path: Path) -> None:
    """More bodies than fit into the default memory of MuJoCo."""
    inside = "".join(
        f'<transform id="t{i}" tx="{i}"><plane id="p{i}" size="5,5,5"/></transform>'
        for i in range(2900)
    )
    scene, model, report = load(
        place(tmp_path, {"world.xml": f"<innerModel>{inside}</innerModel>"})
    )
    assert not report.has_errors
    assert_equal_poses(scene, model)


# content of the root element, and the frames of the scene
UNUSUAL = {
    "": ["root"],
    "<!-- a room -->": ["root"],
    '<include path="/home/somebody/else/gone.xml"/>': ["root"],
    # the joints of a base have names that nodes may have, too
    '<differentialrobot id="b"/><joint id="b.z"/><joint id="b.alpha"><joint id="b.x"/></joint>': [
        *("root", "b", "b.z", "b.alpha", "b.x"),
    ],
    '<omnirobot id="b"><joint id="b.x"/><differentialrobot id="b.x\'"/></omnirobot>': [
        *("root", "b", "b.x", "b.x'"),
    ],
    '<differentialrobot id="world" tx="100"><joint id="j"/></differentialrobot>': [
        *("root", "world", "j"),
    ],
    '<transform id="a" tz = "-900" ty= "5"\n\ttx=\'100\'/>': ["root", "a"],
    '<joint id="a" axis="y"></joint>>7<transform id="b"/>-->': ["root", "a", "b"],
    '<transform id="a" ry=" -1.9" tx="1." ty="-.5" tz="+1e-05"/>': ["root", "a"],
    '<rotation id="a" rx="1.57"><translation id="a" tx="10"/></rotation>': ["root", "a", "a#2"],
    '<transform id="a"><plane id="p" nx="-0.0" nz="0.0" size="0.0,800"/></transform>': [
        "root",
        "a",
    ],
    '<plane id="p" nx="2500" size="85, -85,1"/><plane id="q" size="-216,279,10"/>': ["root"],
    '<mesh id="m" file="folder/" tx="-57" scale="-18,5,5"/>': ["root"],
    '<pointcloud id="c"/><mesh id="m" file="axis.osg" render="wireframe"/>': ["root"],
    '<joint id="j" lx="-3.14" hx="0.1" tx="-150" rx="-3.14"/>': ["root", "j"],
    'parameters<transform id="1a" tx="+500" ry="0,0"/>': ["root", "1a"],
    '<joint id="elbow" axis="x" min="0.01" max="2.6" home="0.2"/>': ["root", "elbow"],
    '<plane id="p" nx="-0.01" nz="6766.374512" size="6771.970703,1900,9"/>': ["root"],
    '<!-- a <plane id="p"/> &ndash;&gt;--><axes id="x"/><INCLUDE/>': ["root"],
}


@pytest.mark.parametrize("inside", UNUSUAL)
def test_world_with_unusual_syntax_loads(tmp_path: Path, inside: str) -> None:
    scene, model, _ = load(
        place(tmp_path, {"world.xml": f"<innerModel>{inside}</innerModel>\n<!-- by hand -->\n"})
    )
    assert [frame.id for frame in scene.frames] == UNUSUAL[inside]
    assert_equal_poses(scene, model)
    Simulation(scene).world.advance(0.01)
