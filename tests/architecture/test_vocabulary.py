"""Names that say nothing stay out, and a class name has one meaning (docs/glossary.md)."""

from __future__ import annotations

import ast
from collections import defaultdict
from collections.abc import Iterator
from pathlib import Path

import pytest

ROOT = Path(__file__).parents[2]
FOLDERS = ("robocomp_dsl", "components", "benchmarks", "editors", "tests")
FORBIDDEN = frozenset({"one", "said", "made", "told", "given", "kept", "wanted"})
NOT_OURS = {"generated", "golden", "old", "node_modules"}

STAGES = {"syntax/ast": "tree", "model": "model"} | dict.fromkeys(
    ("runtime", "hardware", "simulation", "tactile", "innermodel"), "running"
)
"""A noun may have one class in each of these: what is written, what it means, what runs."""


def modules(folder: str) -> list[Path]:
    """The Python files of a top folder that people write."""
    files = (ROOT / folder).rglob("*.py")
    return sorted(f for f in files if not is_generated(f.relative_to(ROOT)))


def is_generated(path: Path) -> bool:
    """Whether a tool or another project wrote the file."""
    return any(p in NOT_OURS or p.endswith("_generated") for p in path.parts)


def bindings(tree: ast.AST) -> Iterator[tuple[str, int]]:
    """Every name that a module binds, with its line."""
    for node in ast.walk(tree):
        match node:
            case ast.Name(id=name, ctx=ast.Store()) | ast.arg(arg=name):
                yield name, node.lineno
            case ast.FunctionDef(name=name) | ast.ClassDef(name=name):
                yield name.strip("_").lower(), node.lineno
            case ast.Attribute(attr=name, ctx=ast.Store()):
                yield name.strip("_"), node.lineno
            case ast.MatchAs(name=str(name)) | ast.MatchStar(name=str(name)):
                yield name, node.lineno
            case ast.ExceptHandler(name=str(name)):
                yield name, node.lineno


@pytest.mark.parametrize("folder", FOLDERS)
def test_names_hold_a_noun(folder: str) -> None:
    found = [
        f"{path.relative_to(ROOT)}:{line}: {name}"
        for path in modules(folder)
        for name, line in bindings(ast.parse(path.read_text("utf-8")))
        if name in FORBIDDEN
    ]
    assert not found, "name the thing instead:\n" + "\n".join(found)


def stage_of(path: Path) -> str:
    """The stage of a module of `robocomp_dsl`; that of a tool is the tool's folder."""
    place = path.relative_to(ROOT / "robocomp_dsl").as_posix()
    return next((s for prefix, s in STAGES.items() if place.startswith(prefix + "/")), "tools")


def test_class_names_have_one_meaning() -> None:
    places: dict[tuple[str, str], list[str]] = defaultdict(list)
    for path in modules("robocomp_dsl"):
        if path.name.endswith("_interface.py"):
            continue
        stage = stage_of(path)
        if stage == "tree":
            continue  # every language has a File, a Name …: one folder, one file a language
        for node in ast.parse(path.read_text("utf-8")).body:
            if isinstance(node, ast.ClassDef) and not node.name.startswith("_"):
                places[node.name, stage].append(str(path.relative_to(ROOT)))
    tools = {name for name, stage in places if stage == "tools"}
    found = [f"{name}: {', '.join(files)}" for (name, _), files in places.items() if files[1:]]
    found += [
        f"{name}: {', '.join(places[name, 'tools'] + files)}"
        for (name, stage), files in places.items()
        if stage != "tools" and name in tools
    ]
    assert not found, "one name, two classes:\n" + "\n".join(sorted(found))
