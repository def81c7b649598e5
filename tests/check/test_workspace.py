"""The workspace: cached modules, and their invalidation after changes."""

from __future__ import annotations

import os
from pathlib import Path

import pytest

from robocomp_dsl.check.languages import check_file, check_syntax
from robocomp_dsl.check.passes import check_cdsl, check_idsl
from robocomp_dsl.check.workspace.workspace import Workspace
from robocomp_dsl.diagnostics import Report
from robocomp_dsl.model.interface import Module

BASE = "module Base { struct Pose { int x; }; };\n"
ARM = 'import "Base.idsl";\nmodule Arm { interface Arm { void go(Base::Pose to); }; };\n'


@pytest.fixture
def folder(tmp_path: Path) -> Path:
    (tmp_path / "Base.idsl").write_text(BASE)
    (tmp_path / "Arm.idsl").write_text(ARM)
    return tmp_path


def _workspace() -> Workspace:
    return Workspace(environ={}, shipped=Path("nowhere"))


def _module(path: Path, workspace: Workspace) -> tuple[Module, list[str]]:
    report = Report()
    modules = check_idsl(path, workspace, report)
    assert modules is not None
    return modules[0], [diagnostic.code.id for diagnostic in report]


def _rewrite(path: Path, text: str) -> None:
    """Write the file with a later modification time, as an editor does."""
    later = path.stat().st_mtime_ns + 1_000_000
    path.write_text(text)
    os.utime(path, ns=(later, later))


def test_workspace_caches_unchanged_modules(folder: Path) -> None:
    workspace = _workspace()
    first, _ = _module(folder / "Arm.idsl", workspace)
    second, _ = _module(folder / "Arm.idsl", workspace)
    assert first is second
    (base,) = first.imports
    assert base is _module(folder / "Base.idsl", workspace)[0]


def test_workspace_reloads_changed_import(folder: Path) -> None:
    workspace = _workspace()
    first, found = _module(folder / "Arm.idsl", workspace)
    assert found == []
    _rewrite(folder / "Base.idsl", "module Base { struct Place { int x; }; };\n")
    second, found = _module(folder / "Arm.idsl", workspace)
    assert found == ["RC301"]
    assert second is not first
    _rewrite(folder / "Base.idsl", BASE)
    assert _module(folder / "Arm.idsl", workspace)[1] == []


def test_workspace_uses_new_file_in_earlier_folder(folder: Path) -> None:
    (folder / "shipped").mkdir()
    (folder / "Base.idsl").rename(folder / "shipped" / "Base.idsl")
    workspace = Workspace(environ={}, shipped=folder / "shipped")
    assert _module(folder / "Arm.idsl", workspace)[1] == []
    (folder / "Base.idsl").write_text("module Base { };\n")
    assert _module(folder / "Arm.idsl", workspace)[1] == ["RC301"]
    (folder / "Base.idsl").unlink()
    assert _module(folder / "Arm.idsl", workspace)[1] == []


def test_workspace_finds_import_created_later(folder: Path) -> None:
    workspace = _workspace()
    (folder / "Base.idsl").unlink()
    assert _module(folder / "Arm.idsl", workspace)[1] == ["RC201"]
    (folder / "Base.idsl").write_text(BASE)
    assert _module(folder / "Arm.idsl", workspace)[1] == []


def test_overlay_takes_precedence_over_file(folder: Path) -> None:
    workspace = _workspace()
    assert _module(folder / "Arm.idsl", workspace)[1] == []
    workspace.sources.set_overlay(folder / "Base.idsl", "module Base { };\n")
    assert _module(folder / "Arm.idsl", workspace)[1] == ["RC301"]
    workspace.sources.set_overlay(folder / "Base.idsl", BASE)
    assert _module(folder / "Arm.idsl", workspace)[1] == []
    workspace.sources.set_overlay(folder / "Base.idsl", "module Base { };\n")
    workspace.sources.remove_overlay(folder / "Base.idsl")
    assert _module(folder / "Arm.idsl", workspace)[1] == []


def test_overlay_needs_no_file(folder: Path) -> None:
    workspace = _workspace()
    workspace.sources.set_overlay(folder / "New.idsl", 'import "Newer.idsl";\nmodule New { };\n')
    workspace.sources.set_overlay(folder / "Newer.idsl", "module Newer { };\n")
    assert _module(folder / "New.idsl", workspace)[1] == []


def test_fixed_import_cycle_is_not_reported(folder: Path) -> None:
    workspace = _workspace()
    _rewrite(folder / "Base.idsl", f'import "Arm.idsl";\n{BASE}')
    first = _module(folder / "Arm.idsl", workspace)[1]
    assert first == _module(folder / "Base.idsl", workspace)[1] == ["RC202"]
    _rewrite(folder / "Base.idsl", BASE)
    assert _module(folder / "Arm.idsl", workspace)[1] == []


def test_import_cycle_is_reported_once(folder: Path) -> None:
    workspace = _workspace()
    _rewrite(folder / "Base.idsl", f'import "Arm.idsl";\n{BASE}')
    report = Report()
    check_file(folder / "Arm.idsl", workspace, report)
    check_file(folder / "Base.idsl", workspace, report)
    assert len(report) == 1


def test_check_syntax_resolves_no_imports(folder: Path) -> None:
    (folder / "Base.idsl").unlink()
    report = Report()
    check_syntax(folder / "Arm.idsl", _workspace(), report)
    assert len(report) == 0


def test_symbolic_link_and_target_are_one_module(folder: Path) -> None:
    (folder / "sub").mkdir()
    (folder / "sub" / "Base.idsl").symlink_to(folder / "Base.idsl")
    workspace = _workspace()
    assert (
        _module(folder / "sub" / "Base.idsl", workspace)[0]
        is _module(folder / "Base.idsl", workspace)[0]
    )


def test_component_uses_parameters_on_disk(folder: Path) -> None:
    (folder / "x.pdsl").write_text("ComponentParams x { rate int 5 1:10; };\n")
    text = 'Component x { Communications { }; language Python; parameters "x.pdsl"; };\n'
    (folder / "x.cdsl").write_text(text)
    workspace = _workspace()
    component = check_cdsl(folder / "x.cdsl", workspace, Report())
    assert component is not None
    assert component.parameters is not None
    workspace.sources.set_overlay(folder / "x.pdsl", "ComponentParams x { rate int 50 1:10; };\n")
    report = Report()
    check_cdsl(folder / "x.cdsl", workspace, report)
    assert [diagnostic.code.id for diagnostic in report] == ["RC404"]
