"""The examples that ship with the package: components, robots and demos.

In: the folder `COMPONENTS`. Out: a record of each example, and the files of a copy.
"""

from __future__ import annotations

import re
from collections.abc import Iterator
from pathlib import Path

from robocomp_dsl.diagnostics import Report
from robocomp_dsl.generate.output import OutputFile
from robocomp_dsl.record import ValueRecord
from robocomp_dsl.resources import COMPONENTS
from robocomp_dsl.source import Source
from robocomp_dsl.syntax.parse import parse_ddsl

DEMO = "demo.py"
_SENTENCE = re.compile(r"(.+?\.)(\s|$)", re.DOTALL)


class Example(ValueRecord):
    """One example: its name, its kind, a one-line description, and its folder."""

    name: str
    kind: str
    about: str
    folder: Path

    @property
    def start(self) -> str:
        """The command that runs it, in its folder."""
        if (self.folder / DEMO).is_file():
            return f"python3 {DEMO}"
        deployments = sorted(self.folder.glob("*.ddsl"))
        return f"rcdeploy {deployments[0].name}" if deployments else "python3 main.py"


def examples(shipped: Path = COMPONENTS) -> dict[str, Example]:
    """All examples by name, sorted by kind and name."""
    found = [_example(path) for path in shipped.iterdir() if (path / "README.md").is_file()]
    return {entry.name: entry for entry in sorted(found, key=lambda e: (e.kind, e.name))}


def example_files(example: Example) -> list[OutputFile]:
    """The files of `example` and of all folders that its deployments import.

    Paths start with `components/`, as in the repository, so that relative paths keep their meaning.
    """
    return [file for folder in _needed(example.folder) for file in _files(folder)]


def _example(folder: Path) -> Example:
    if (folder / DEMO).is_file() or not any(folder.glob("*.cdsl")):
        kind = "demo"
    else:
        kind = "robot" if any(folder.glob("*.xml")) else "component"
    return Example(folder.name.removesuffix("_demo"), kind, _about(folder / "README.md"), folder)


def _about(readme: Path) -> str:
    """The first sentence below the title."""
    paragraph = readme.read_text(encoding="utf-8").split("\n\n")[1]
    text = " ".join(paragraph.split())
    sentence = _SENTENCE.match(text)
    return sentence[1] if sentence else text


def _needed(folder: Path) -> list[Path]:
    """`folder` and the folders beside it that its deployments import, and so on."""
    needed = [folder]
    for entry in needed:  # grows meanwhile
        needed += [path for path in _imported(entry) if path not in needed]
    return needed


def _imported(folder: Path) -> Iterator[Path]:
    """The folders beside `folder` that contain files imported by its deployments."""
    folders: dict[Path, None] = {}
    for path in sorted(folder.glob("*.ddsl")):
        for statement in parse_ddsl(Source.read(path), Report()).imports:
            beside = (folder / statement.path.value).resolve().parent
            if beside != folder.resolve() and beside.parent == folder.resolve().parent:
                folders[folder.parent / beside.name] = None
    yield from folders


def _files(folder: Path) -> Iterator[OutputFile]:
    for path in sorted(folder.rglob("*")):
        if path.is_file() and "__pycache__" not in path.parts:
            place = path.relative_to(folder.parent).as_posix()
            text = path.read_bytes().decode("utf-8", "surrogateescape")
            yield OutputFile(f"components/{place}", text)
