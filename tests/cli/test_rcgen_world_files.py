"""Meshes and pictures of worlds in `rcgen check` and `simulator`, and in the simulator itself."""

import json
import logging
from pathlib import Path

import pytest

from robocomp_dsl.simulation.models.mesh_marker import marked_meshes
from robocomp_dsl.simulation.world.simulation import Simulation
from tests.cli.rcgen_run import Rcgen
from tests.hardware.mesh_files import TETRAHEDRA

MESH = "/home/robocomp/robocomp/files/osgModels/basics/cube.3ds"
WORLD = f'<innerModel><mesh id="m" file="{MESH}"/></innerModel>'


@pytest.fixture
def files(here: Path) -> Path:
    """A copy of the meshes, beside the working folder of the world."""
    folder = here / "copy" / "files"
    (folder / "osgModels" / "basics").mkdir(parents=True)
    (folder / "osgModels" / "basics" / "cube.3ds").write_bytes(TETRAHEDRA["a.3ds"])
    (here / "room").mkdir()
    (here / "room" / "world.xml").write_text(WORLD)
    return folder


@pytest.mark.parametrize("by", ["option", "variable"])
def test_check_reports_missing_world_files_if_asked(
    rcgen: Rcgen, files: Path, monkeypatch: pytest.MonkeyPatch, by: str
) -> None:
    assert "RC788" not in rcgen("check", "room/world.xml").out
    for folder in (files, files / "osgModels", files.parent, files.parent.parent / "room"):
        found = folder.name != "room"
        if by == "variable":
            monkeypatch.setenv("ROBOCOMP_FILES", str(folder))
        option = ("--files", folder) if by == "option" else ()
        run = rcgen("check", "room/world.xml", *option)
        assert (run.code, "warning[RC788]" in run.out) == (0, not found), run.out


def test_simulator_keeps_paths_of_found_files(
    rcgen: Rcgen,
    files: Path,
    monkeypatch: pytest.MonkeyPatch,
    caplog: pytest.LogCaptureFixture,
) -> None:
    run = rcgen("simulator", "room/world.xml", "-o", "made", "--files", files)
    assert (run.code, run.err) == (0, "")
    scene = Path("made/world_simulator_generated/scene.json")
    (mesh,) = json.loads(scene.read_text())["scene"]["meshes"]
    assert mesh["file"] == str(files / "osgModels" / "basics" / "cube.3ds")
    assert Simulation.read(scene).state.world.model.nmesh == 1
    moved = files.parent.rename(files.parent.with_name("moved"))
    with caplog.at_level(logging.WARNING):
        assert marked_meshes(Simulation.read(scene).state.world.model) == {0: "m"}
    assert "1 mesh not found, a small marker instead in 1 node: `m`" in caplog.text
    monkeypatch.setenv("ROBOCOMP_FILES", str(moved / "files"))
    assert Simulation.read(scene).state.world.model.nmesh == 1


def test_simulator_reports_missing_files_once(rcgen: Rcgen, files: Path) -> None:
    run = rcgen("simulator", "room/world.xml", "--dry-run", "--files", files.parent.parent / "room")
    assert run.code == 0
    assert run.err.count("warning") == run.err.count("RC788") == 1
    assert "searched by the end of the path in" in run.err
