"""The import resolver: order of folders, and paths as they are written."""

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
        "../elsewhere/Laser.idsl",
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


def test_import_resolver_tries_written_path_first(tmp_path: Path) -> None:
    for mark in ("outside", "here", "first"):
        _laser(tmp_path / mark, mark)
    component, report = _component(tmp_path, "../outside/Laser.idsl", _workspace(tmp_path))
    assert not report.has_errors
    assert component.ports[0].interface.module == "outside"
    (tmp_path / "outside" / "Laser.idsl").unlink()
    component, _ = _component(tmp_path, "../outside/Laser.idsl", _workspace(tmp_path))
    assert component.ports[0].interface.module == "here"


def test_import_resolver_is_relative_to_importing_file(tmp_path: Path) -> None:
    deep = tmp_path / "other" / "IDSLs"
    (deep / "types").mkdir(parents=True)
    (deep / "types" / "Pose.idsl").write_text("module Deep { struct Pose { int x; }; };\n")
    (tmp_path / "here").mkdir()
    (tmp_path / "here" / "Pose.idsl").write_text("module Here { struct Wrong { int x; }; };\n")
    text = 'import "types/Pose.idsl";\nmodule L {{ interface Laser {{ {} }}; }};\n'
    (deep / "Laser.idsl").write_text(text.format("Pose get();"))
    (deep / "Scan.idsl").write_text('import "Laser.idsl";\nmodule S { interface Scan { }; };\n')
    component, report = _component(tmp_path, "../other/IDSLs/Laser.idsl", _workspace(tmp_path))
    assert not report.has_errors
    assert [module.name for module in component.modules[0].imports] == ["Deep"]
    _, report = _component(tmp_path, "../other/IDSLs/Scan.idsl", _workspace(tmp_path))
    assert "RC201" not in {diagnostic.code.id for diagnostic in report}


def test_import_resolver_finds_interfaces_beside_and_above(tmp_path: Path) -> None:
    places = ["here/interfaces", "here/interfaces/IDSLs", "interfaces", "interfaces/IDSLs"]
    for mark, place in enumerate(places):
        (tmp_path / place).mkdir(parents=True, exist_ok=True)
        _laser(tmp_path / place, f"M{mark}")
    _laser(tmp_path / "first", "first")
    order = ["first", "M0", "M1", "M2", "M3"]
    workspace = Workspace([tmp_path / "first"], {}, shipped=tmp_path / "deep" / "shipped")
    for mark, place in zip(order, ["first", *places], strict=True):
        component, report = _component(tmp_path, "/robocomp/IDSLs/Laser.idsl", workspace)
        assert not report.has_errors
        assert component.ports[0].interface.module == mark
        (tmp_path / place / "Laser.idsl").unlink()


def test_import_resolver_accepts_files_of_same_name_in_two_folders(tmp_path: Path) -> None:
    (tmp_path / "here").mkdir()
    for mark in ("a", "b"):
        _laser(tmp_path / "here" / mark, mark)
    path = tmp_path / "here" / "two.idsl"
    path.write_text('import "a/Laser.idsl";\nimport "b/Laser.idsl";\nmodule M { };\n')
    report = Report()
    modules = check_idsl(path, Workspace((), {}), report)
    assert modules is not None
    assert [module.name for module in modules[0].imports] == ["a", "b"]
    path.write_text('import "a/Laser.idsl";\nimport "./a/Laser.idsl";\nmodule M { };\n')
    check_idsl(path, Workspace((), {}), report)
    assert [diagnostic.code.id for diagnostic in report] == ["RC208"]


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
