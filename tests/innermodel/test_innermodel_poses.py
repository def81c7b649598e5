"""`InnerModel` at run time: its numbers against matrices that are multiplied in the test."""

from __future__ import annotations

import inspect
import math
import random
from pathlib import Path

import numpy as np
import pytest

from robocomp_dsl.innermodel import InnerModel, InnerModelError
from tests.innermodel.random_trees import Poses, pose_matrix, random_tree

ARM = """\
<innerModel>
  <transform id="world">
    <differentialrobot id="robot" tx="1000" tz="500" ry="90 deg">
      <joint id="shoulder" axis="z" min="-1" max="1" ty="300">
        <transform id="upper" tx="200">
          <joint id="elbow" axis="y"><translation id="hand" tx="150"/></joint>
        </transform>
      </joint>
      <prismaticjoint id="lift" axis="y" offset="100" position="5" min="0" max="300">
        <laser id="laser" measures="10" angle="3"/>
        <camera id="camera" width="640" height="480" focal="500"/>
        <camera id="blind" width="640" height="480"/>
      </prismaticjoint>
      <mesh id="hull" file="hull.stl" tx="70"/>
    </differentialrobot>
    <plane id="floor" ny="1"/>
    <touchsensor id="bumper" type="bumper"/>
  </transform>
</innerModel>
"""


@pytest.fixture
def arm() -> InnerModel:
    return InnerModel.fromString(ARM)


@pytest.mark.parametrize("seed", range(12))
def test_innermodel_transforms_agree_with_products_of_matrices(seed: int) -> None:
    rng = np.random.default_rng(seed)
    text = random_tree(seed)
    model, poses = InnerModel.fromString(text), Poses(text)
    assert set(model.getIDKeys()) == set(poses.local)
    for _ in range(60):
        to, start = rng.choice(sorted(poses.local), 2)
        expected = poses.between(to, start)
        points = rng.uniform(-900, 900, (4, 3))
        seen = points @ expected[:3, :3].T + expected[:3, 3]
        assert model.transform(to, points[0], start) == pytest.approx(seen[0], abs=1e-8)
        assert model.transform(to, list(points[1]), start) == pytest.approx(seen[1], abs=1e-8)
        assert model.transform(to, points, start) == pytest.approx(seen, abs=1e-8)
        assert model.transform(to, start) == pytest.approx(expected[:3, 3], abs=1e-8)
        assert model.getTransformationMatrix(to, start) == pytest.approx(expected, abs=1e-8)
        assert model.getRotationMatrixTo(to, start) == pytest.approx(expected[:3, :3], abs=1e-9)
        assert model.getTranslationVectorTo(to, start) == pytest.approx(expected[:3, 3], abs=1e-8)
        pose = rng.uniform(-3, 3, 6)
        pose_seen = model.transform6D(to, pose, start)
        assert pose_matrix(*pose_seen) == pytest.approx(expected @ pose_matrix(*pose), abs=1e-8)
        assert model.transform(to, pose, start) == pytest.approx(pose_seen)
        turned = pose_matrix(0, 0, 0, *model.rotationAngles(to, start))
        assert turned[:3, :3] == pytest.approx(expected[:3, :3], abs=1e-9)


@pytest.mark.parametrize("seed", range(8))
def test_innermodel_updates_agree_with_products_of_matrices(seed: int) -> None:
    rng = random.Random(seed)
    text = random_tree(seed + 100)
    model, poses = InnerModel.fromString(text), Poses(text)
    posed = [n for n, tag in poses.tags.items() if tag in {"transform", "joint", "omnirobot"}]
    slides = [n for n, tag in poses.tags.items() if tag == "prismaticjoint"]
    for _ in range(40):
        name = rng.choice(posed)
        pose = [rng.uniform(-500, 500) for _ in range(3)] + [rng.uniform(-3, 3) for _ in range(3)]
        base = rng.choice(sorted(poses.local))
        choice = rng.randrange(5)
        if choice == 0:
            model.updateTransformValues(name, *pose)
            poses.local[name] = pose_matrix(*pose)
        elif choice == 1 and name not in _path(poses, base):
            model.updateTransformValuesV(name, np.array(pose), base)
            above = poses.between(poses.parent[name], base)
            poses.local[name] = above @ pose_matrix(*pose)
        elif choice == 2:
            model.updateTranslationValues(name, *pose[:3])
            poses.local[name][:3, 3] = pose[:3]
        elif choice == 3:
            model.updateRotationValues(name, *pose[3:])
            poses.local[name][:3, :3] = pose_matrix(*pose)[:3, :3]
        elif slides:
            slide = rng.choice(slides)
            model.updatePrismaticJointPosition(slide, pose[0])
            axis = "xyz".index(poses.attributes[slide]["axis"])
            poses.local[slide][axis, 3] = pose[0] + float(poses.attributes[slide]["offset"])
        to, start = rng.choice(sorted(poses.local)), rng.choice(sorted(poses.local))
        matrix = model.getTransformationMatrix(to, start)
        assert matrix == pytest.approx(poses.between(to, start), abs=1e-7)


def _path(poses: Poses, name: str) -> list[str]:
    found = [name]
    while poses.parent[found[-1]]:
        found.append(poses.parent[found[-1]])
    return found


def test_innermodel_transform_follows_robocomp_example(arm: InnerModel) -> None:
    """Turned by 90° about y, what is ahead of the robot (z) is along x of the world."""
    assert arm.transform("world", [0, 0, 100], "robot") == pytest.approx([1100, 0, 500])
    assert arm.transform("robot", [1100, 0, 500], "world") == pytest.approx([0, 0, 100])
    assert arm.transform("world", "robot", [0, 0, 100]) == pytest.approx([1100, 0, 500])
    assert arm.transform("laser", "world") == pytest.approx([500, -105, -1000])


def test_innermodel_sees_node_without_frame_at_its_holder(arm: InnerModel) -> None:
    for leaf, holder in (("hull", "robot"), ("laser", "lift"), ("floor", "world")):
        assert arm.transform("world", leaf) == pytest.approx(arm.transform("world", holder))


def test_update_joint_value_stays_within_limits_unless_forced(arm: InnerModel) -> None:
    assert arm.updateJointValue("shoulder", 2.0) == 1.0
    assert arm.transform("robot", "upper") == pytest.approx(
        [200 * math.cos(1), 300 + 200 * math.sin(1), 0]
    )
    assert arm.updateJointValue("shoulder", 2.0, force=True) == 2.0
    shoulder = arm.getJoint("shoulder")
    assert (shoulder.getAngle(), shoulder.min, shoulder.max) == (2.0, -1.0, 1.0)
    assert shoulder.setAngle(-5) == -1.0
    assert shoulder.unitaryAxis() == pytest.approx([0, 0, 1])
    lift = arm.getPrismaticJoint("lift")
    assert lift.getPosition() == 5.0
    assert lift.setPosition(500) == 300.0
    assert arm.transform("robot", "lift") == pytest.approx([0, 400, 0])


def test_updates_in_another_node_follow_robocomp(arm: InnerModel) -> None:
    arm.updateRotationValues("upper", 0.1, 0.2, 0.3)
    arm.updateTranslationValues("upper", 1, 2, 3, "world")
    assert arm.transform6D("world", "upper") == pytest.approx([1, 2, 3, 0, 0, 0], abs=1e-9)
    arm.updateRotationValues("upper", 0.1, 0.2, 0.3, "world")
    assert arm.transform6D("world", "upper") == pytest.approx([0, 0, 0, 0.1, 0.2, 0.3], abs=1e-9)


def test_innermodel_jacobian_is_minus_the_derivative(arm: InnerModel) -> None:
    joints = ["shoulder", "elbow"]
    arm.updateJointValue("shoulder", 0.4)
    arm.updateJointValue("elbow", -0.7)
    columns = InnerModel(arm).jacobian(joints, [0, 0], "hand")
    assert columns.shape == (6, 2)
    base = arm.getTransformationMatrix("elbow", "world")
    before = base @ arm.getTransformationMatrix("world", "hand")
    for column, joint in enumerate(joints):
        moved = arm.copy()
        moved.updateJointValue(joint, moved.getJoint(joint).getAngle() + 1e-6)
        step = (base @ moved.getTransformationMatrix("world", "hand") - before) / 1e-6
        turn = step[:3, :3] @ before[:3, :3].T
        motion = [*step[:3, 3], turn[2, 1], turn[0, 2], turn[1, 0]]
        assert columns[:, column] == pytest.approx([-part for part in motion], abs=1e-2)
    held = arm.jacobian(joints, [0, 1], "hand")
    assert not held[:, 1].any()
    assert held[:, 0] == pytest.approx(columns[:, 0])


def test_innermodel_camera_projects_and_back(arm: InnerModel) -> None:
    """y is up, rows count from the top; the distance is that to the centre of the camera."""
    column, row, distance = arm.project("camera", [100, 50, 1000], "camera")
    assert (column, row) == pytest.approx((320 + 50, 240 - 25))
    assert distance == pytest.approx(math.hypot(100, 50, 1000))
    assert arm.backProject("camera", [column, row]) == pytest.approx([0.1, 0.05, 1])
    seen = arm.imageCoordPlusDepthTo("camera", [column, row], 1000, "world")
    assert seen == pytest.approx(arm.transform("world", [100, 50, 1000], "camera"))
    assert arm.project("world", seen, "camera")[:2] == pytest.approx([column, row])
    assert arm.laserTo("laser", "laser", 200, 0.5) == pytest.approx(
        [200 * math.sin(0.5), 0, 200 * math.cos(0.5)]
    )
    assert (arm.getCameraWidth("camera"), arm.getCameraHeight("camera")) == (640, 480)
    assert arm.getCameraFocal("camera") == 500


BINDING = (
    *("updateTransformValues", "updateTransformValuesV", "cleanupTables", "jacobian", "transform"),
    *("getTransformationMatrix", "getParentIdentifier", "getJoint"),
)
"""The methods of `BOOST_PYTHON_MODULE(librobocomp_innermodel)`."""


def test_innermodel_has_names_and_keywords_of_robocomp_binding() -> None:
    assert all(callable(getattr(InnerModel, name)) for name in BINDING)
    keywords = list(inspect.signature(InnerModel.updateTransformValues).parameters)
    assert keywords[1:] == ["transformId", "tx", "ty", "tz", "rx", "ry", "rz", "parentId"]
    keywords = list(inspect.signature(InnerModel.updateTransformValuesV).parameters)
    assert keywords[1:] == ["transformId", "v", "parentId"]


@pytest.mark.parametrize(
    ("call", "words"),
    [
        (lambda m: m.transform("wold", [0, 0, 0], "robot"), "no node `wold`: did you mean `world`"),
        (lambda m: m.transform("world", [0, 0, 0]), "transform(to, point, from)"),
        (lambda m: m.transform("world", [0, 0], "robot"), "not the shape (2,)"),
        (lambda m: m.transform("world", ["a", 0, 0], "robot"), "consists of numbers"),
        (lambda m: m.transform("world", None, "robot"), "not the shape ()"),
        (lambda m: m.transform(3, [0, 0, 0], "robot"), "an id is a string"),
        (lambda m: m.transform6D("world", [0, 0, 0], "robot"), "6 numbers"),
        (lambda m: m.getTransformationMatrix("x", "robot"), "no node `x`"),
        (lambda m: m.updateTransformValues("robot", 0, 0, 0, 0, math.nan, 0), "`ry` is nan"),
        (lambda m: m.updateTransformValues("robot", "a", 0, 0, 0, 0, 0), "`tx` is a number"),
        (lambda m: m.updateTransformValues("robot", 0, 0, 0, 0, 0, 0, "wo"), "no node `wo`"),
        (lambda m: m.updateTransformValues("hull", 0, 0, 0, 0, 0, 0), "`hull` is a `mesh`"),
        (lambda m: m.updateTransformValues("lift", 0, 0, 0, 0, 0, 0), "updatePrismaticJoint"),
        (lambda m: m.updateTransformValues("bumper", 0, 0, 0, 0, 0, 0), "`bumper` is a `touch"),
        (lambda m: m.updateTransformValues("root", 0, 0, 0, 0, 0, 0), "the root stays"),
        (lambda m: m.updateJointValue("robot", 1), "`robot` is a `differentialrobot`, not a joint"),
        (lambda m: m.updateJointValue("elbow", math.inf), "`angle` is inf"),
        (lambda m: m.updatePrismaticJointPosition("elbow", 1), "not a prismatic joint"),
        (lambda m: m.updatePlaneValues("robot", 0, 1, 0, 0, 0, 0), "not a plane"),
        (lambda m: m.getJoint("laser"), "`laser` is a `laser`, not a joint"),
        (lambda m: m.getParentIdentifier("nobody"), "no node `nobody`"),
        (lambda m: m.jacobian([], [], "hand"), "at least one joint"),
        (lambda m: m.jacobian(["robot"], [0], "hand"), "`robot` is no joint"),
        (lambda m: m.jacobian(["elbow"], [0, 0], "hand"), "`motores` has 1 numbers"),
        (lambda m: m.project("world", [0, 0, 0], "laser"), "not a camera"),
        (lambda m: m.project("camera", [1, 1, 0], "camera"), "beside `camera`"),
        (lambda m: m.project("world", [0, 0, 0], "blind"), "no `focal` length"),
        (lambda m: m.laserTo("world", "camera", 1, 0), "not a laser"),
    ],
)
def test_innermodel_refuses_call_and_stays_as_it_was(arm: InnerModel, call, words: str) -> None:  # type: ignore[no-untyped-def]
    with pytest.raises(InnerModelError) as raised:
        call(arm)
    assert words in str(raised.value)
    assert raised.value.findings == ()
    assert arm.toString() == ARM


def test_innermodel_locates_all_errors_of_a_file(tmp_path: Path) -> None:
    part = tmp_path / "part.xml"
    part.write_text('<innerModel><transform id="a" tx="1,5"/></innerModel>')
    path = tmp_path / "robot.xml"
    path.write_text(
        '<innerModel>\n  <transform id="a" foo="1"/>\n  <include path="part.xml"/>\n'
        '  <joint id="j" min="2" max="1"/>\n</innerModel>'
    )
    with pytest.raises(InnerModelError) as raised:
        InnerModel(path)
    found = {(f.kind, Path(f.location.file).name, f.location.line) for f in raised.value.findings}
    assert found == {
        ("RC802", "robot.xml", 2),
        ("RC803", "part.xml", 1),
        ("RC804", "part.xml", 1),
        ("RC808", "robot.xml", 4),
    }
    assert f"--> {path}:2:21" in str(raised.value)
    assert 'foo="1"' in str(raised.value)


@pytest.mark.parametrize("content", [None, b"\xff\xfe<", b"<innerModel>", b"", b"<robot/>"])
def test_innermodel_error_names_unusable_file(tmp_path: Path, content: bytes | None) -> None:
    path = tmp_path / "robot.xml"
    if content is not None:
        path.write_bytes(content)
    with pytest.raises(InnerModelError) as raised:
        InnerModel(str(path))
    assert str(path) in str(raised.value)
    assert raised.value.findings


def test_innermodel_reads_includes_and_returns_warnings(tmp_path: Path) -> None:
    (tmp_path / "part.xml").write_text('<innerModel><transform id="b" tx="5" tx="5"/></innerModel>')
    text = (
        '<innerModel><transform id="a" tx="1"><include path="part.xml"/></transform></innerModel>'
    )
    model = InnerModel.fromString(text, tmp_path)
    assert model.transform("root", "b") == pytest.approx([6, 0, 0])
    assert [(f.kind, f.location.line) for f in model.warnings] == [("RC186", 1)]


def test_copied_innermodel_is_independent(arm: InnerModel) -> None:
    twin = InnerModel(arm)
    twin.updateTransformValues("robot", 0, 0, 0, 0, 0, 0)
    twin.newTransform("new", "static", "hand", tx=1)
    assert arm.toString() == ARM
    assert "new" not in arm
    assert twin.transform("world", "new") == pytest.approx([351, 300, 0])
    arm.removeNode("robot")
    assert "hand" in twin


def test_innermodel_joint_has_its_own_angle_until_a_simulator_sets_home() -> None:
    """As in RoboComp: only its simulator sets the joints that it serves to their homes."""
    model = InnerModel.fromString(
        """<innerModel><joint id="hinge" axis="y" ry="0.3" home="1"/><joint id="plain"/>
        <prismaticjoint id="slide" axis="x" home="40"/></innerModel>"""
    )
    hinge, slide, plain = model.getJoint("hinge"), model.getPrismaticJoint("slide"), "plain"
    assert (hinge.getAngle(), hinge.home) == (0.3, 1.0)
    assert (slide.getPosition(), slide.home) == (0.0, 40.0)
    assert model.getJoint(plain).home == 0.0
