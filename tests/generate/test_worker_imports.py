"""Imports of generated modules: each names a module that is generated, too."""

from __future__ import annotations

import ast
from pathlib import Path

import pytest

from robocomp_dsl.check.passes import check_cdsl
from robocomp_dsl.check.workspace.workspace import Workspace
from robocomp_dsl.diagnostics import Report
from robocomp_dsl.generate.plan import plan
from robocomp_dsl.generate.write import write

MACHINE = "lamp { initial_state on; states off; transitions { on => off; off => on; }; };\n"


def generate(folder: Path, statemachine: str, gui: str = "") -> Path:
    file = folder / "lamp.cdsl"
    file.write_text(
        f"Component lamp {{ Communications {{ }}; language Python; {gui} {statemachine} }};\n"
    )
    component = check_cdsl(file, Workspace(environ={}), Report())
    assert component is not None
    write(folder, plan(component))
    return folder / "lamp_generated"


def relative_imports(package: Path) -> set[str]:
    trees = (ast.parse(file.read_text()) for file in package.glob("*.py"))
    return {
        node.module or ""
        for tree in trees
        for node in ast.walk(tree)
        if isinstance(node, ast.ImportFrom) and node.level
    }


@pytest.mark.parametrize("gui", ["", "gui Qt(QWidget);"])
@pytest.mark.parametrize("exists", [False, True])
def test_generic_imports_name_generated_modules(tmp_path: Path, gui: str, *, exists: bool) -> None:
    if exists:
        (tmp_path / "lamp.smdsl").write_text(MACHINE)
    package = generate(tmp_path, 'statemachine "lamp.smdsl";', gui)
    imported = relative_imports(package)
    assert ("machine" in imported) is exists
    assert {name for name in imported if not (package / f"{name}.py").exists()} == set()
