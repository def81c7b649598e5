"""Saving an `InnerModel`: only what has changed differs from the file that was read."""

from __future__ import annotations

import difflib
import random
import stat
from dataclasses import fields
from pathlib import Path

import pytest

from robocomp_dsl.innermodel import InnerModel, InnerModelError
from tests.innermodel.random_trees import random_tree
from tests.innermodel.random_worlds import random_world

ROOT = Path(__file__).parents[2]
SHIPPED = (
    ROOT / "tests/migrate/old/follow/etc/room.xml",
    ROOT / "tests/simulation/models/files/room.xml",
)
ROBOT = """\
<?xml version="1.0" encoding="UTF-8"?>
<!-- A robot. -->
<innerModel>
    <transform id="robot" ty="0.5 m"  rz='90 deg' >   <!-- the base -->
        <translation id = "arm" tz="1e2"/>
        <joint id="elbow" axis="x"
               min="-90 deg" max="1.57">
            <motor id="drive" force="12"/>
        </joint>
        <plane id="shield" nz="1" nz="1" texture="#ff0000"/>
    </transform>
</innerModel>
"""


def changes(before: str, after: str) -> list[str]:
    """The lines that differ, with `-` or `+`."""
    lines = difflib.ndiff(before.splitlines(), after.splitlines())
    return [line for line in lines if line[0] in "-+"]


def same(first: InnerModel, second: InnerModel) -> None:
    """Assert that two models have the same nodes, values and poses; siblings in any order."""
    assert sorted(first.getIDKeys()) == sorted(second.getIDKeys())
    for name in first.getIDKeys():
        assert first.getParentIdentifier(name) == second.getParentIdentifier(name)
        assert values_of(first, name) == values_of(second, name)
        found, expected = first.transform6D("root", name), second.transform6D("root", name)
        assert found == pytest.approx(expected, abs=1e-9)


def values_of(model: InnerModel, name: str) -> dict[str, object]:
    """The values of a node with its class; files as paths."""
    node = model.getNode(name)
    assert node is not None
    values = {field.name: getattr(node, field.name) for field in fields(node)}
    folder = node.span.source.path.parent
    if folder != Path() and values.get("file"):
        values["file"] = folder / values["file"]
    for left_out in ("span", "children", "tag"):
        values.pop(left_out, None)
    return values | {"class": type(node)}


@pytest.mark.parametrize("path", SHIPPED, ids=lambda path: path.parent.name)
def test_unchanged_innermodel_is_saved_byte_by_byte(path: Path, tmp_path: Path) -> None:
    model = InnerModel(path)
    assert model.save(tmp_path / "copy.xml") is True
    assert (tmp_path / "copy.xml").read_bytes() == path.read_bytes()


def test_unchanged_random_innermodels_are_saved_byte_by_byte(tmp_path: Path) -> None:
    saved = 0
    for seed in range(150):
        folder = tmp_path / str(seed)
        folder.mkdir()
        for name, text in random_world(seed).items():
            (folder / name).write_text(text)
        path = folder / "world.xml"
        try:
            model = InnerModel(path)
        except InnerModelError:
            continue
        model.save(folder / "copy.xml")
        assert (folder / "copy.xml").read_bytes() == path.read_bytes()
        same(InnerModel(folder / "copy.xml"), model)
        saved += 1
    assert saved > 20


@pytest.mark.parametrize(
    "data",
    [
        b"\xef\xbb\xbf" + ROBOT.encode(),
        ROBOT.replace("\n", "\r\n").encode(),
        ROBOT.replace("UTF-8", "ISO-8859-1").replace("base", "R\xe4der").encode("latin-1"),
        ROBOT.replace("UTF-8", "ISO-8859-1").replace("base", "R\xe4der").encode(),
        ROBOT.replace("base", "R\xe4der \u20ac").encode(),
    ],
    ids=["bom", "crlf", "latin-1", "utf-8 declared as latin-1", "utf-8"],
)
def test_innermodel_save_keeps_encoding_and_line_ends(tmp_path: Path, data: bytes) -> None:
    path = tmp_path / "robot.xml"
    path.write_bytes(data)
    model = InnerModel(path)
    model.save(path)
    assert path.read_bytes() == data
    model.updateTransformValues("arm", 0, 0, 250, 0, 0, 0)
    model.save(path)
    assert path.read_bytes() == data.replace(b"1e2", b"250")
    model.newTransform("r\xe4der\u20ac", "static", "arm")
    model.save(path)
    same(InnerModel(path), model)
    assert path.read_bytes().count(b"\r\n") in {0, path.read_bytes().count(b"\n")}


def test_innermodel_save_changes_values_in_their_unit_and_nothing_else() -> None:
    model = InnerModel.fromString(ROBOT)
    model.updateTransformValues("robot", 0, 600, 0, 0, 0, model.getTransform("robot").rz)
    model.updateJointValue("elbow", 0.5)
    model.updatePlaneValues("shield", 0, 0, -1, 0, 0.1, 0)
    assert changes(ROBOT, model.toString()) == [
        """-     <transform id="robot" ty="0.5 m"  rz='90 deg' >   <!-- the base -->""",
        """+     <transform id="robot" ty="0.6 m"  rz='90 deg' >   <!-- the base -->""",
        """-                min="-90 deg" max="1.57">""",
        """+                min="-90 deg" max="1.57" rx="0.5">""",
        """-         <plane id="shield" nz="1" nz="1" texture="#ff0000"/>""",
        """+         <plane id="shield" nz="-1" texture="#ff0000" py="0.1"/>""",
    ]
    model.updateTransformValues("robot", 0, 500, 0, 0, 0, model.getTransform("robot").rz)
    assert """<transform id="robot" ty="0.5 m"  rz='90 deg' >""" in model.toString()
    model.updateTransformValues("robot", 0, 1 / 3, 0, 0, 0, 1 / 3)
    same(InnerModel.fromString(model.toString()), model)


def test_innermodel_save_writes_turned_translation_as_transform() -> None:
    model = InnerModel.fromString(ROBOT)
    model.updateTransformValues("arm", 0, 0, 100, 0, 0, 0.25)
    assert changes(ROBOT, model.toString()) == [
        '-         <translation id = "arm" tz="1e2"/>',
        '+         <transform id = "arm" tz="1e2" rz="0.25"/>',
    ]
    model.newTransform("hand", "static", "arm")
    assert "</transform>" in model.toString()
    same(InnerModel.fromString(model.toString()), model)


def test_innermodel_save_adds_removes_and_moves_elements() -> None:
    model = InnerModel.fromString(ROBOT)
    hand = model.newTransform("hand", "static", "arm", tx=1, rz=0.5)
    model.newMesh("glove", hand, "a & b.stl", (1, 2, 3), 1)
    model.newLaser("laser", "robot", max=5000)
    model.moveSubTree("elbow", hand)
    model.removeNode("shield")
    assert (
        model.toString().split("-->\n")[2]
        == """\
        <translation id = "arm" tz="1e2">
            <transform id="hand" tx="1" rz="0.5">
                <mesh id="glove" file="a &amp; b.stl" scale="1,2,3" render="wireframe"/>
                <joint id="elbow" axis="x"
                       min="-90 deg" max="1.57">
                    <motor id="drive" force="12"/>
                </joint>
            </transform>
        </translation>
        <laser id="laser" max="5000" angle="3.141592653589793" measures="360"/>
    </transform>
</innerModel>
"""
    )
    same(InnerModel.fromString(model.toString()), model)


def test_empty_innermodel_is_built_and_saved(tmp_path: Path) -> None:
    model = InnerModel()
    assert model.getIDKeys() == ["root"]
    world = model.newTransform("world", "static", "root")
    base = model.newDifferentialRobot("base", world, 10, 0, 20, 0, 1.5, 0, 10004)
    shoulder = model.newJoint("shoulder", base, min=-1, max=1, axis="y", ry=0.25)
    model.newPrismaticJoint("lift", shoulder, 0, 500, 20, 5, axis="y")
    model.newOmniRobot("omni", "world", noise=0.5, collide=True)
    model.newTouchSensor("bumper", base, "bumper", nz=1)
    model.newCamera("camera", "lift", 640, 480, 500)
    model.newRGBD("rgbd", "lift", 640, 480, 500, 0.1, 10096, "base")
    model.newIMU("imu", base)
    model.newPlane("wall", "world", "#00ff00", 1000, 2000, 10, 1, nz=-1, collidable=True)
    model.newDisplay("screen", 0, "world", "#000000", 400, 300, 10, 1)
    model.newPointCloud("cloud", "world")
    assert (shoulder.getAngle(), shoulder.axis) == (0.25, "y")
    assert model.transform("shoulder", "lift") == pytest.approx([0, 25, 0])
    model.save(tmp_path / "built.xml")
    same(InnerModel(tmp_path / "built.xml"), model)
    assert InnerModel(tmp_path / "built.xml").warnings == ()


@pytest.mark.parametrize(
    ("call", "words"),
    [
        (lambda m: m.newTransform("arm", "static", "robot"), "there is a node `arm` already"),
        (lambda m: m.newTransform("x", "static", "nobody"), "no node `nobody`"),
        (lambda m: m.newTransform(" ", "static", "robot"), "non-empty string"),
        (lambda m: m.newTransform(5, "static", "robot"), "non-empty string"),
        (lambda m: m.newTransform("a\0b", "static", "robot"), "which XML does not have"),
        (lambda m: m.updateDisplay("shield", "\ud800.png"), "which XML does not have"),
        (lambda m: m.newTransform("x", "fast", "robot"), "`engine` is one of `static`, `bullet`"),
        (lambda m: m.newTransform("x", "static", "robot", tx=float("nan")), "`tx` is nan"),
        (lambda m: m.newTransform("x", "static", "shield"), "cannot hold other nodes"),
        (lambda m: m.newTransform("x", "static", "robot", mass=-1), "`mass` must not be negative"),
        (lambda m: m.newJoint("x", "robot", axis="w"), "`axis` is one of `x`, `y`, `z`"),
        (lambda m: m.newJoint("x", "robot", min=2, max=1), "exceeds `max`"),
        (lambda m: m.newCamera("x", "robot", 1.5, 2, 3), "`width` is an integer"),
        (lambda m: m.newMesh("x", "robot", "a.stl", (1, 2)), "`scale` has three numbers"),
        (lambda m: m.newMesh("x", "robot", "a.stl", 0), "`scale` must contain finite numbers"),
        (lambda m: m.removeNode("root"), "`root` is the root"),
        (lambda m: m.removeNode("nobody"), "no node `nobody`"),
        (lambda m: m.moveSubTree("robot", "arm"), "`arm` is part of `robot`"),
        (lambda m: m.moveSubTree("arm", "shield"), "cannot hold other nodes"),
        (lambda m: m.moveSubTree("drive", "arm"), "the motor of `elbow`"),
    ],
)
def test_innermodel_refuses_edit_and_stays_as_it_was(call, words: str) -> None:  # type: ignore[no-untyped-def]
    model = InnerModel.fromString(ROBOT)
    with pytest.raises(InnerModelError) as raised:
        call(model)
    assert words in str(raised.value)
    assert model.toString() == ROBOT


def test_innermodel_limits_the_depth_that_a_file_can_have() -> None:
    model = InnerModel()
    deepest = "root"
    for number in range(200):
        deepest = model.newTransform(f"t{number}", "static", deepest).id
    with pytest.raises(InnerModelError, match="at most 200 deep"):
        model.newTransform("too_deep", "static", deepest)
    same(InnerModel.fromString(model.toString()), model)
    model.newTransform("a", "static", "root")
    model.newTransform("b", "static", "a")
    with pytest.raises(InnerModelError, match="at most 200 deep"):
        model.moveSubTree("a", deepest)


PART = """\
<innerModel>
  <!-- of the part -->
  <transform id="part" tx="1">
    <mesh id="shell" file="shell.stl"/>
  </transform>
  <include path="deeper.xml"/>
</innerModel>
"""
MAIN = """\
<innerModel>
    <transform id="world">
        <include path="parts/part.xml"/>
        <plane id="floor"/>
    </transform>
</innerModel>
"""


@pytest.fixture
def main(tmp_path: Path) -> Path:
    (tmp_path / "parts").mkdir()
    (tmp_path / "parts" / "part.xml").write_text(PART)
    (tmp_path / "parts" / "deeper.xml").write_text('<innerModel><imu id="imu"/></innerModel>')
    path = tmp_path / "main.xml"
    path.write_text(MAIN)
    return path


def test_innermodel_save_keeps_include_of_unchanged_file(main: Path) -> None:
    model = InnerModel(main)
    model.newIMU("other", "world")
    assert changes(MAIN, model.toString()) == ['+         <imu id="other"/>']


def test_innermodel_save_writes_changed_included_nodes_into_the_file(main: Path) -> None:
    model = InnerModel(main)
    model.updateTransformValues("part", 2, 0, 0, 0, 0, 0)
    assert model.toString() == MAIN.replace(
        '<include path="parts/part.xml"/>',
        """\
<!-- of the part -->
        <transform id="part" tx="2">
          <mesh id="shell" file="parts/shell.stl"/>
        </transform>
        <include path="parts/deeper.xml"/>""",
    )
    model.save(main)
    same(InnerModel(main), model)
    assert (main.parent / "parts" / "part.xml").read_text() == PART


def test_innermodel_save_moves_included_nodes(main: Path) -> None:
    model = InnerModel(main)
    model.newTransform("shelf", "static", "world", ty=100)
    model.moveSubTree("part", "shelf")
    model.removeNode("imu")
    text = model.toString()
    assert '            <transform id="part" tx="1">\n' in text
    assert 'file="parts/shell.stl"' in text
    model.save(main)
    same(InnerModel(main), model)


def edit(model: InnerModel, rng: random.Random, new: str) -> None:
    """Change something, or try to."""
    name, target = rng.choice(model.getIDKeys()), rng.choice(model.getIDKeys())
    values = [rng.choice((0, 1, rng.uniform(-400, 400), rng.random())) for _ in range(6)]
    match rng.randrange(9):
        case 0:
            model.updateTransformValues(name, *values, rng.choice(("", target)))
        case 1:
            model.updateTranslationValues(name, *values[:3])
        case 2:
            model.updateJointValue(name, values[5])
        case 3:
            model.updatePrismaticJointPosition(name, values[0])
        case 4:
            model.updatePlaneValues(name, *values)
        case 5:
            model.newTransform(new, "static", name, *values)
        case 6:
            model.newPlane(new, name, "", 10, 20, 3.5, 1, *values)
        case 7:
            model.moveSubTree(name, target)
        case 8 if len(model) > 12:
            model.removeNode(name)


def test_innermodel_reads_back_texts_with_special_characters() -> None:
    model = InnerModel.fromString(ROBOT)
    model.updateDisplay("shield", """a "b" & 'c' <d>\te\r\nf \N{SNOWMAN}.png """)
    model.newTransform(""" "x" & <y> 'z' """, "static", "robot")
    model.newMesh("mesh", "arm", """ 'm' & "n".stl """)
    again = InnerModel.fromString(model.toString())
    same(again, model)
    assert """"x" & <y> 'z'""" in again


@pytest.mark.parametrize("seed", range(25))
def test_randomly_edited_innermodel_is_read_back_as_it_was(seed: int) -> None:
    rng = random.Random(seed)
    text = random_tree(seed + 500)
    model = InnerModel.fromString(text)
    for step in range(30):
        before = model.toString()
        try:
            edit(model, rng, f"new{step}")
        except InnerModelError:
            assert model.toString() == before
    saved = model.toString()
    again = InnerModel.fromString(saved)
    same(again, model)
    assert again.toString() == saved
    assert saved.count("<!--") <= text.count("<!--")


def test_innermodel_save_replaces_file_of_link_with_its_mode(tmp_path: Path) -> None:
    path, link = tmp_path / "robot.xml", tmp_path / "link.xml"
    path.write_text(ROBOT)
    path.chmod(0o640)
    link.symlink_to(path)
    model = InnerModel(link)
    model.removeNode("arm")
    model.save(link)
    assert link.is_symlink()
    assert path.read_text() == model.toString()
    assert stat.S_IMODE(path.stat().st_mode) == 0o640
    assert sorted(p.name for p in tmp_path.iterdir()) == ["link.xml", "robot.xml"]


def test_innermodel_save_names_file_that_cannot_be_written(tmp_path: Path) -> None:
    model = InnerModel.fromString(ROBOT)
    for path in (tmp_path / "no" / "folder.xml", tmp_path):
        with pytest.raises(InnerModelError, match=path.name):
            model.save(path)
    assert list(tmp_path.iterdir()) == []
