"""Where imports lead: the order of the folders, and that nothing leads out of them."""

from __future__ import annotations

from pathlib import Path

import pytest

from robocomp_dsl.check import check_cdsl, check_idsl
from robocomp_dsl.check.workspace import Workspace
from robocomp_dsl.diagnostics import Report
from robocomp_dsl.model.component import Component

COMPONENT = (
    'import "{}";\nComponent reader {{ Communications {{ requires Laser; }}; language Python; }};\n'
)


def _laser(folder: Path, mark: str, name: str = "Laser.idsl") -> None:
    folder.mkdir(exist_ok=True)
    (folder / name).write_text(f"module {mark} {{ interface Laser {{ int get(); }}; }};\n")


def _component(tmp_path: Path, written: str, workspace: Workspace) -> tuple[Component, Report]:
    path = tmp_path / "here" / "reader.cdsl"
    path.parent.mkdir(exist_ok=True)
    path.write_text(COMPONENT.format(written))
    report = Report()
    found = check_cdsl(path, workspace, report)
    assert found is not None
    return found, report


def _workspace(tmp_path: Path) -> Workspace:
    folders = [tmp_path / "first", tmp_path / "second"]
    environ = {"ROBOCOMP_INTERFACES": f"{tmp_path / 'third'}::{tmp_path / 'fourth'}"}
    return Workspace(folders, environ, shipped=tmp_path / "shipped")


def test_the_first_folder_wins(tmp_path: Path) -> None:
    order = ["here", "first", "second", "third", "fourth", "shipped"]
    for mark in order:
        _laser(tmp_path / mark, mark)
    for mark in order:
        component, report = _component(tmp_path, "Laser.idsl", _workspace(tmp_path))
        assert not report.failed
        assert component.ports[0].interface.module == mark
        (tmp_path / mark / "Laser.idsl").unlink()
    _, report = _component(tmp_path, "Laser.idsl", _workspace(tmp_path))
    (finding,) = report
    assert finding.code.id == "RC201"
    places = [finding.help.index(str(tmp_path / mark)) for mark in order]
    assert places == sorted(places)


@pytest.mark.parametrize(
    "written",
    [
        "/robocomp/interfaces/IDSLs/Laser.idsl",
        "../../../..//interfaces/IDSLs/Laser.idsl",
        "C:\\robocomp\\Laser.idsl",
        "here/Laser.idsl",
    ],
)
def test_only_the_last_part_of_a_path_counts(tmp_path: Path, written: str) -> None:
    _laser(tmp_path / "shipped", "shipped")
    _, report = _component(tmp_path, written.replace("\\", "\\\\"), _workspace(tmp_path))
    assert not report.failed


@pytest.mark.parametrize(
    "written",
    [
        "../outside/Laser.idsl",
        "../../etc/passwd",
        "..",
        ".",
        "/",
        "a\\0.idsl",
        "x" * 5000 + ".idsl",
    ],
)
def test_no_path_leads_out_of_the_folders(tmp_path: Path, written: str) -> None:
    _laser(tmp_path / "outside", "outside")
    _, report = _component(tmp_path, written, _workspace(tmp_path))
    assert {one.code.id for one in report} <= {"RC201", "RC207"}
    assert report.failed


def test_all_files_behind_a_component_see_the_same_file(tmp_path: Path) -> None:
    workspace = _workspace(tmp_path)
    _laser(tmp_path / "here", "here")
    _laser(tmp_path / "shipped", "shipped")
    text = 'import "Laser.idsl";\nmodule M { struct S { int a; }; };\n'
    (tmp_path / "shipped" / "Other.idsl").write_text(text)
    component, _ = _component(tmp_path, "Other.idsl", workspace)
    (module,) = component.modules
    assert [one.name for one in module.imports] == ["here"]
    modules = check_idsl(tmp_path / "shipped" / "Other.idsl", workspace, Report())
    assert modules is not None
    assert [one.name for one in modules[0].imports] == ["shipped"]


def test_a_folder_with_the_name_of_a_file_is_passed_over(tmp_path: Path) -> None:
    (tmp_path / "here" / "Laser.idsl").mkdir(parents=True)
    _laser(tmp_path / "shipped", "shipped")
    component, report = _component(tmp_path, "Laser.idsl", _workspace(tmp_path))
    assert not report.failed
    assert component.ports[0].interface.module == "shipped"
