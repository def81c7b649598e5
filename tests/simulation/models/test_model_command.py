"""`rcgen simulator` of MJCF and URDF at the command line: what is made, and what cannot be."""

from __future__ import annotations

import shutil
import subprocess
import sys
from pathlib import Path

import mujoco
import pytest

from robocomp_dsl.simulation.models.model_copy import copy_model
from robocomp_dsl.simulation.world.simulation import Simulation
from tests.simulation.model_worlds import ARM, BOT
from tests.simulation.served_worlds import rcgen
from tests.support.generated_package import package_in

TABLE = """\
device       kind            interface          port
lift         prismaticjoint  JointMotor         JointMotor
turn         joint           JointMotor         JointMotor
lift         prismaticjoint  ControlBoard       ControlBoard
turn         joint           ControlBoard       ControlBoard
(the world)  world           InnerModelManager  InnerModelManager
(the world)  world           Simulation         Simulation
"""
TETRAHEDRON = """\
v 0 0 0
v 0.1 0 0
v 0 0.1 0
v 0 0 0.1
f 1 3 2
f 1 2 4
f 1 4 3
f 2 3 4
"""


def test_model_command_dry_run_lists_urdf(tmp_path: Path) -> None:
    (tmp_path / "bot.urdf").write_text(BOT)
    done = rcgen("simulator", "bot.urdf", "--dry-run", cwd=tmp_path)
    assert (done.returncode, done.stdout, done.stderr) == (0, TABLE, "")
    assert [path.name for path in tmp_path.iterdir()] == ["bot.urdf"]


def test_model_component_is_clean_typed_and_stable(tmp_path: Path) -> None:
    (tmp_path / "arm.xml").write_text(ARM)
    done = rcgen("simulator", "arm.xml", cwd=tmp_path)
    assert (done.returncode, done.stderr) == (0, "")
    folder = tmp_path / "arm_simulator"
    mypy = [sys.executable, "-m", "mypy", "--strict", "--config-file=", "--no-error-summary"]
    for command in (
        [str(shutil.which("ruff")), "check", "--isolated", "--no-cache", "."],
        [str(shutil.which("ruff")), "format", "--diff", "--isolated", "--no-cache", "."],
        [*mypy, "."],
    ):
        ran = subprocess.run(command, cwd=folder, capture_output=True, text=True, check=False)
        assert ran.returncode == 0, ran.stdout
    assert "step float 1 [ms]" in (folder / "arm_simulator.pdsl").read_text()
    assert "0 of" in rcgen("simulator", "arm.xml", cwd=tmp_path).stdout


# -- the copy beside the component ----------------------------------------------------------------


def test_model_component_needs_only_mesh_files(tmp_path: Path) -> None:
    """Includes are written out, meshes have absolute paths, whatever folder the file names."""
    source = tmp_path / "source"
    (source / "parts" / "shapes").mkdir(parents=True)
    (source / "parts" / "shapes" / "corner.obj").write_text(TETRAHEDRON)
    (source / "parts" / "arm.xml").write_text(
        '<mujocoinclude><body name="b"><joint name="j"/><geom type="mesh" mesh="corner"/></body>'
        "</mujocoinclude>"
    )
    (source / "robot.xml").write_text(
        '<mujoco><!-- <include file="gone.xml"/> --><compiler meshdir="parts/shapes"/>'
        '<asset><mesh file="corner.obj"/></asset>'
        '<worldbody><include file="parts/arm.xml"/></worldbody></mujoco>'
    )
    done = rcgen("simulator", "source/robot.xml", "-o", "made", cwd=tmp_path)
    assert (done.returncode, done.stderr) == (0, "")
    (source / "robot.xml").unlink()
    (source / "parts" / "arm.xml").unlink()
    simulation = Simulation.read(package_in(tmp_path / "made") / "scene.json")
    assert simulation.world.model.nmesh == 1
    assert simulation.devices["j"].board.spec.names == ("j",)


def test_model_command_resolves_urdf_packages(tmp_path: Path) -> None:
    package = tmp_path / "share" / "bot_description"
    (package / "meshes").mkdir(parents=True)
    (package / "meshes" / "corner.obj").write_text(TETRAHEDRON)
    (tmp_path / "home").mkdir()
    mesh = '<visual><geometry><mesh filename="package://bot_description/meshes/corner.obj"/>'
    text = BOT.replace("<collision>", f"{mesh}</geometry></visual><collision>")
    (tmp_path / "home" / "bot.urdf").write_text(text)
    done = rcgen("simulator", "bot.urdf", "--packages", "../share", cwd=tmp_path / "home")
    assert (done.returncode, done.stderr) == (0, "")
    simulation = Simulation.read(package_in(tmp_path / "home" / "bot_simulator") / "scene.json")
    assert simulation.world.model.nmesh == 1


COPIES = {
    '<mujoco><asset><texture file="a.png"/></asset></mujoco>': "{0}/a.png",
    '<mujoco><compiler texturedir="t"/><asset><texture file="a.png"/></asset></mujoco>': (
        "{0}/t/a.png"
    ),
    '<mujoco><compiler assetdir="t"/><asset><hfield file="a.png"/></asset></mujoco>': "{0}/t/a.png",
    '<mujoco><compiler strippath="true"/><asset><mesh file="x/a.obj"/></asset></mujoco>': (
        "{0}/a.obj"
    ),
    "<mujoco><asset><texture fileup='a&amp;b.png'/></asset></mujoco>": "{0}/a&amp;b.png",
    '<robot><mesh filename="file:///x/a.stl"/></robot>': "/x/a.stl",
}


@pytest.mark.parametrize("text", COPIES)
def test_model_copy_has_relative_paths(tmp_path: Path, text: str) -> None:
    (tmp_path / "m.xml").write_text(text)
    copy = copy_model(tmp_path / "m.xml")
    assert f'"{COPIES[text].format(tmp_path)}"' in copy
    assert "strippath" not in copy


def test_model_copy_without_references_is_identical(tmp_path: Path) -> None:
    (tmp_path / "arm.xml").write_text(ARM)
    assert copy_model(tmp_path / "arm.xml") == ARM


# -- what cannot be ------------------------------------------------------------------------------

BAD = {
    "<mujoco><worldbody><bodyy/></worldbody></mujoco>": ("robot.xml:1:", "bodyy"),
    '<mujoco>\n<worldbody>\n<body name="a"><joint/></body>\n</worldbody></mujoco': ("RC651", ""),
    "<mujoco><worldbody><body><joint/></body></worldbody></mujoco>": ("RC652", "no mass"),
    '<mujoco><include file="gone.xml"/></mujoco>': ("RC651", "gone.xml"),
    '<mujoco><include file="robot.xml"/></mujoco>': ("RC651", ""),
    '<robot name="r"><link name="a"/><link name="a"/></robot>': ("robot.xml:1:", "two links `a`"),
    '<robot name="r">\n<link name="a"/>\n<joint name="j" type="x"/></robot>': ("xml:3:", "j"),
    '<robot><xacro:macro name="m"/></robot>': ("RC651", "xacro"),
    '<mujoco><asset><mesh name="m" file="no.obj"/></asset><worldbody>'
    '<geom type="mesh" mesh="m"/></worldbody></mujoco>': ("RC652", "no.obj"),
    '<mujoco><worldbody><geom size=".1"/><body name="in"><freejoint/><geom size=".1"/></body>'
    "</worldbody></mujoco>": ("RC653", "`in` and"),
    '<mujoco><worldbody><body name="b"><joint name="j"/><geom size=".1"/></body></worldbody>'
    '<keyframe><key name="k" qpos="1 2"/></keyframe></mujoco>': ("RC651", "`k`"),
    '<mujoco><worldbody><body name="b" pos="0 nan 0"><joint/><geom size=".1"/></body></worldbody>'
    "</mujoco>": ("RC651", "the body `b` has a `pos` that is no finite number"),
    "<mujocoinclude/>": ("RC651", "give the file that includes it"),
    '<mujoco><compiler settotalmass="3"/><worldbody><body><freejoint/><geom size=".1"/></body>'
    "</worldbody></mujoco>": ("RC652", "settotalmass"),
}


@pytest.mark.parametrize("text", BAD)
def test_model_command_reports_invalid_files(tmp_path: Path, text: str) -> None:
    """With a line or a name where there is one, and never as a traceback."""
    (tmp_path / "robot.xml").write_text(text)
    done = rcgen("simulator", "robot.xml", "--dry-run", "--format", "concise", cwd=tmp_path)
    place, message = BAD[text]
    assert place in done.stderr
    assert message in done.stderr
    assert "Traceback" not in done.stderr
    assert "internal error" not in done.stderr
    failed = "error" in done.stderr
    assert done.returncode == int(failed)


def test_model_command_reports_text_that_is_not_utf_8(tmp_path: Path) -> None:
    """MuJoCo takes it, and so do we."""
    text = ARM.replace("<worldbody>", "<!-- Fuß --><worldbody>", 1)
    (tmp_path / "arm.xml").write_bytes(text.encode("latin-1"))
    assert mujoco.MjModel.from_xml_path(str(tmp_path / "arm.xml")).nbody > 1
    done = rcgen("simulator", "arm.xml", cwd=tmp_path)
    assert (done.returncode, done.stderr) == (0, "")
