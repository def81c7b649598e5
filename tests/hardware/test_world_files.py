"""The search for meshes and pictures of worlds that were written on another computer."""

from pathlib import Path

import pytest

from robocomp_dsl.hardware.description.world_files import FileSearch, exists, missing_files

WRITTEN = Path("/home/robocomp/robocomp/files/osgModels/mobiliario/Mesa.osg")


def placed(path: Path) -> Path:
    path.parent.mkdir(parents=True, exist_ok=True)
    path.write_text("v 0 0 0\n")
    return path


@pytest.mark.parametrize(
    "file",
    ["files/osgModels/mobiliario/Mesa.osg", "osgModels/mobiliario/Mesa.osg", "Mesa.osg"],
)
@pytest.mark.parametrize("by", ["option", "variable"])
def test_file_search_maps_end_of_path(tmp_path: Path, file: str, by: str) -> None:
    there = placed(tmp_path / "copy" / file)
    other, folder = tmp_path / "other", tmp_path / "copy"
    if by == "option":
        search = FileSearch(tmp_path / "world", (other, folder), environ={})
    else:
        search = FileSearch(tmp_path / "world", environ={"ROBOCOMP_FILES": f"{other}::{folder}"})
    assert search.find(WRITTEN) == there


def test_file_search_prefers_longest_end_and_first_folder(tmp_path: Path) -> None:
    placed(tmp_path / "a" / "Mesa.osg")
    longest = placed(tmp_path / "a" / "mobiliario" / "Mesa.osg")
    placed(tmp_path / "b" / "osgModels" / "mobiliario" / "Mesa.osg")
    search = FileSearch(tmp_path / "a", (tmp_path / "a", tmp_path / "b"), environ={})
    assert search.find(WRITTEN) == longest


@pytest.mark.parametrize("file", ["osgmodels/Mobiliario/mesa.OSG", "MESA.osg"])
@pytest.mark.parametrize("folder", ["copy", "world"])
def test_file_search_ignores_case_at_last(tmp_path: Path, file: str, folder: str) -> None:
    there = placed(tmp_path / folder / file)
    search = FileSearch(tmp_path / "world", (tmp_path / "copy",), environ={})
    assert search.find(WRITTEN) == there
    exact = placed(tmp_path / "copy" / "Mesa.osg")
    assert FileSearch(tmp_path / "world", (tmp_path / "copy",), environ={}).find(WRITTEN) == exact


@pytest.mark.parametrize("written", ["C:\\models\\chairs\\chair.obj", "..\\chairs\\chair.obj"])
def test_file_search_reads_paths_of_windows(tmp_path: Path, written: str) -> None:
    there = placed(tmp_path / "copy" / "chairs" / "chair.obj")
    assert FileSearch(tmp_path, (tmp_path / "copy",), environ={}).find(Path(written)) == there


@pytest.mark.parametrize("written", ["/x/" + "a" * 5000, "/x/a\0b.obj", "/"])
def test_file_search_of_impossible_name_finds_nothing(tmp_path: Path, written: str) -> None:
    search = FileSearch(tmp_path, (tmp_path,), environ={})
    assert search.find(Path(written)) == Path(written)
    assert exists(Path(written)) == (written == "/")


def test_file_search_names_link_of_git_annex(tmp_path: Path) -> None:
    link = tmp_path / "files" / "osgModels" / "mobiliario" / "Mesa.osg"
    link.parent.mkdir(parents=True)
    link.symlink_to("../../../.git/annex/objects/2v/f7/SHA256E-s2726--bb.osg")
    search = FileSearch(tmp_path, (tmp_path / "files",), environ={})
    assert search.find(WRITTEN) == link
    missing = missing_files([("m", str(link))], [])
    assert missing.help(search) == (
        f"git-annex has not fetched their content: `git annex get` in {link.parent}"
    )


def test_missing_files_are_counted_in_one_message(tmp_path: Path) -> None:
    here = str(placed(tmp_path / "here.obj"))
    meshes = [(f"m{i}", f"/far/{i % 6}.ive") for i in range(20)] + [("found", here)]
    missing = missing_files(meshes, [("floor", "/far/wood.jpg")])
    assert missing.message == (
        "6 meshes not found, a small marker instead in 20 nodes: `m0` (/far/0.ive), `m1`"
        " (/far/1.ive), `m2` (/far/2.ive), `m3` (/far/3.ive) and 2 more; 1 picture not found,"
        " a colour instead in 1 node: `floor` (/far/wood.jpg)"
    )
    search = FileSearch(tmp_path, (tmp_path / "copy",), environ={})
    assert missing.help(search) == (
        f"searched by the end of the path in {tmp_path / 'copy'}, {tmp_path} and the folders above"
        " it; `--files DIR` or ROBOCOMP_FILES=DIR names the folder that has `far/0.ive`"
    )
    assert missing.first == "m0"
    assert not missing_files([("found", here)], [])
