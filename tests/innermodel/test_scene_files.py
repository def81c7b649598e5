"""Files with paths of another computer are searched beside the world and above it."""

from pathlib import Path

import pytest

from robocomp_dsl.check.passes import check_innermodel
from robocomp_dsl.check.workspace.workspace import Workspace
from robocomp_dsl.diagnostics import Report
from robocomp_dsl.generate.simulator.simulator import simulator

OTHER_COMPUTER = "/home/robocomp/robocomp/files/osgModels"


@pytest.fixture
def folder(tmp_path: Path) -> Path:
    """The folder of a world in a copy of the files of RoboComp."""
    result = tmp_path / "rc" / "files" / "innermodel"
    for name in ("files/osgModels/table.obj", "files/innermodel/near.obj", "alone.obj"):
        file = tmp_path / "rc" / name
        file.parent.mkdir(parents=True, exist_ok=True)
        file.write_text("v 0 0 0\n")
    return result


@pytest.mark.parametrize(
    ("written", "there"),
    [
        (f"{OTHER_COMPUTER}/table.obj", "rc/files/osgModels/table.obj"),
        ("../osgModels/table.obj", "rc/files/innermodel/../osgModels/table.obj"),
        (f"{OTHER_COMPUTER}/near.obj", "rc/files/innermodel/near.obj"),
        ("near.obj", "rc/files/innermodel/near.obj"),
    ],
)
def test_scene_file_of_other_computer_is_found(
    folder: Path, tmp_path: Path, written: str, there: str
) -> None:
    assert resolved_paths(folder, written) == (str(tmp_path / there), str(tmp_path / there))


@pytest.mark.parametrize("written", [f"{OTHER_COMPUTER}/alone.obj", f"{OTHER_COMPUTER}/gone.obj"])
def test_scene_file_search_skips_bare_name_above_world(folder: Path, written: str) -> None:
    assert resolved_paths(folder, written) == (written, written)


def test_scene_file_paths_become_absolute(folder: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.chdir(folder.parent)
    assert resolved_paths(Path("innermodel"), "near.obj") == (str(folder / "near.obj"),) * 2


def resolved_paths(folder: Path, written: str) -> tuple[str, str]:
    """The resolved paths of a mesh and a texture."""
    world = folder / "world.xml"
    world.write_text(
        f'<innerModel><mesh id="m" file="{written}"/><plane id="p" texture="{written}"/>'
        "</innerModel>"
    )
    body = check_innermodel(world, Workspace(environ={}), Report())
    assert body is not None
    scene = simulator(body).scene
    return scene["meshes"][0]["file"], scene["boxes"][0]["texture"]
