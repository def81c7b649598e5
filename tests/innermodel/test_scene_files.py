"""Files that a world of another machine names are found beside it and above it."""

from pathlib import Path

import pytest

from robocomp_dsl.check.passes import check_innermodel
from robocomp_dsl.check.workspace.workspace import Workspace
from robocomp_dsl.diagnostics import Report
from robocomp_dsl.generate.simulator.simulator import simulator

ELSEWHERE = "/home/robocomp/robocomp/files/osgModels"


@pytest.fixture
def folder(tmp_path: Path) -> Path:
    """Of a world in a copy of RoboComp's files."""
    result = tmp_path / "rc" / "files" / "innermodel"
    for name in ("files/osgModels/table.obj", "files/innermodel/near.obj", "alone.obj"):
        file = tmp_path / "rc" / name
        file.parent.mkdir(parents=True, exist_ok=True)
        file.write_text("v 0 0 0\n")
    return result


@pytest.mark.parametrize(
    ("written", "there"),
    [
        (f"{ELSEWHERE}/table.obj", "rc/files/osgModels/table.obj"),
        ("../osgModels/table.obj", "rc/files/innermodel/../osgModels/table.obj"),
        (f"{ELSEWHERE}/near.obj", "rc/files/innermodel/near.obj"),
        ("near.obj", "rc/files/innermodel/near.obj"),
    ],
)
def test_a_file_is_found(folder: Path, tmp_path: Path, written: str, there: str) -> None:
    assert named(folder, written) == (str(tmp_path / there), str(tmp_path / there))


@pytest.mark.parametrize("written", [f"{ELSEWHERE}/alone.obj", f"{ELSEWHERE}/gone.obj"])
def test_a_bare_name_above_the_world_is_not_meant(folder: Path, written: str) -> None:
    assert named(folder, written) == (written, written)


def test_relative_paths_become_absolute(folder: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.chdir(folder.parent)
    assert named(Path("innermodel"), "near.obj") == (str(folder / "near.obj"),) * 2


def named(folder: Path, written: str) -> tuple[str, str]:
    """The paths of a mesh and of a picture that are written so."""
    world = folder / "world.xml"
    world.write_text(
        f'<innerModel><mesh id="m" file="{written}"/><plane id="p" texture="{written}"/>'
        "</innerModel>"
    )
    body = check_innermodel(world, Workspace(environ={}), Report())
    assert body is not None
    scene = simulator(body).scene
    return scene["meshes"][0]["file"], scene["boxes"][0]["texture"]
