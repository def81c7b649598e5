"""The import resolver: order of folders, and rejection of paths outside them."""

from __future__ import annotations

from pathlib import Path

import pytest

from robocomp_dsl.check.passes import check_cdsl, check_idsl
from robocomp_dsl.check.workspace.workspace import Workspace
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


def test_import_resolver_uses_first_folder(tmp_path: Path) -> None:
    order = ["here", "first", "second", "third", "fourth", "shipped"]
    for mark in order:
        _laser(tmp_path / mark, mark)
    for mark in order:
        component, report = _component(tmp_path, "Laser.idsl", _workspace(tmp_path))
        assert not report.has_errors
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
def test_import_resolver_uses_last_path_part(tmp_path: Path, written: str) -> None:
    _laser(tmp_path / "shipped", "shipped")
    _, report = _component(tmp_path, written.replace("\\", "\\\\"), _workspace(tmp_path))
    assert not report.has_errors


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
def test_import_resolver_stays_in_its_folders(tmp_path: Path, written: str) -> None:
    _laser(tmp_path / "outside", "outside")
    _, report = _component(tmp_path, written, _workspace(tmp_path))
    assert {diagnostic.code.id for diagnostic in report} <= {"RC201", "RC207"}
    assert report.has_errors


def test_import_resolver_gives_one_file_per_name(tmp_path: Path) -> None:
    workspace = _workspace(tmp_path)
    _laser(tmp_path / "here", "here")
    _laser(tmp_path / "shipped", "shipped")
    text = 'import "Laser.idsl";\nmodule M { struct S { int a; }; };\n'
    (tmp_path / "shipped" / "Other.idsl").write_text(text)
    component, _ = _component(tmp_path, "Other.idsl", workspace)
    (module,) = component.modules
    assert [diagnostic.name for diagnostic in module.imports] == ["here"]
    modules = check_idsl(tmp_path / "shipped" / "Other.idsl", workspace, Report())
    assert modules is not None
    assert [diagnostic.name for diagnostic in modules[0].imports] == ["shipped"]


def test_import_resolver_skips_folder_with_file_name(tmp_path: Path) -> None:
    (tmp_path / "here" / "Laser.idsl").mkdir(parents=True)
    _laser(tmp_path / "shipped", "shipped")
    component, report = _component(tmp_path, "Laser.idsl", _workspace(tmp_path))
    assert not report.has_errors
    assert component.ports[0].interface.module == "shipped"
