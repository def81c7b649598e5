"""No module imports itself in a circle: at module level, inside functions, or for type checking."""

from __future__ import annotations

import ast
from collections.abc import Iterator
from graphlib import CycleError, TopologicalSorter
from pathlib import Path

import pytest

ROOT = Path(__file__).parents[2]
PACKAGE = "robocomp_dsl"


def module_files(root: Path) -> dict[str, Path]:
    """Every module of the package by its dotted name."""
    names = {}
    for path in sorted((root / PACKAGE).rglob("*.py")):
        parts = path.relative_to(root).with_suffix("").parts
        names[".".join(parts[:-1] if parts[-1] == "__init__" else parts)] = path
    return names


def imported(tree: ast.AST, modules: dict[str, Path]) -> Iterator[str]:
    """The modules of the package that any import of `tree` names, also one inside a function."""
    for node in ast.walk(tree):
        if isinstance(node, ast.Import):
            yield from (alias.name for alias in node.names if alias.name in modules)
        elif isinstance(node, ast.ImportFrom) and node.module in modules:
            members = (f"{node.module}.{alias.name}" for alias in node.names)
            yield from (member if member in modules else node.module for member in members)
        elif isinstance(node, ast.ImportFrom) and node.level:
            raise AssertionError("use absolute imports")


def import_graph(root: Path) -> dict[str, set[str]]:
    """What every module imports."""
    modules = module_files(root)
    return {
        name: set(imported(ast.parse(path.read_text("utf-8")), modules)) - {name}
        for name, path in modules.items()
    }


def circle(graph: dict[str, set[str]]) -> list[str]:
    """One circle of imports, as a path; empty if there is none."""
    try:
        TopologicalSorter(graph).prepare()
    except CycleError as error:
        path: list[str] = error.args[1]
        return path[::-1]
    return []


def test_modules_import_in_no_circle() -> None:
    found = circle(import_graph(ROOT))
    assert not found, "move what both need into a module below:\n" + " imports\n".join(found)


@pytest.mark.parametrize(
    "line",
    [
        "from robocomp_dsl import b",
        "import robocomp_dsl.b",
        "def f():\n    from robocomp_dsl.b import g",
        "if TYPE_CHECKING:\n    from robocomp_dsl.b import G",
    ],
)
def test_circle_is_found_in_every_kind_of_import(line: str, tmp_path: Path) -> None:
    package = tmp_path / PACKAGE
    package.mkdir()
    (package / "__init__.py").touch()
    (package / "a.py").write_text(line, "utf-8")
    (package / "b.py").write_text("from robocomp_dsl.a import f", "utf-8")
    assert set(circle(import_graph(tmp_path))) == {f"{PACKAGE}.a", f"{PACKAGE}.b"}
