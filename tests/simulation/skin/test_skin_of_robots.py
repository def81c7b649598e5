"""The simulators of robots that ship: fresh, with the skin that their descriptions have."""

from __future__ import annotations

import json
import shutil
from pathlib import Path

import pytest

from robocomp_dsl.hardware.description.scene_skin import Skin, geometry_of
from robocomp_dsl.simulation.robots.catalog import description, description_file
from robocomp_dsl.simulation.robots.export import TACTILE, WORLDS, RobotWorld, text
from robocomp_dsl.tactile.skin.geometry import SkinGeometry
from tests.simulation.served_worlds import rcgen
from tests.support.generated_package import package_in

COMPONENTS = Path(__file__).parents[3] / "components"
ROBOTS = pytest.mark.parametrize("world", WORLDS, ids=lambda world: world.robot)


@ROBOTS
def test_robot_skin_world_and_description_are_those_of_robot(world: RobotWorld) -> None:
    path = COMPONENTS / world.file
    assert path.read_text() == text(world)
    assert path.with_name(TACTILE).read_text() == description_file(world.robot).read_text()


@ROBOTS
def test_robot_skin_simulator_is_freshly_generated(world: RobotWorld, tmp_path: Path) -> None:
    path = COMPONENTS / world.file
    folder = tmp_path / path.parent.name
    shutil.copytree(path.parent, folder, ignore=shutil.ignore_patterns("__pycache__"))
    done = rcgen("simulator", path.name, "-o", ".", "--tactile", TACTILE, cwd=folder)
    assert (done.returncode, done.stderr) == (0, "")
    assert ": 0 of " in done.stdout


@ROBOTS
def test_robot_skin_matches_description(world: RobotWorld) -> None:
    scene = package_in((COMPONENTS / world.file).parent) / "scene.json"
    found = geometry_of(map(Skin.of_data, json.loads(scene.read_text())["scene"]["skins"]))
    expected = SkinGeometry.of(description(world.robot))
    assert found.limbs == expected.limbs
    assert found.patches == expected.patches
    assert found.ids.tolist() == expected.ids.tolist()
    assert abs(found.points - expected.points).max() < 1e-8
    assert [frame.covers for frame in found.frames] == [frame.covers for frame in expected.frames]
