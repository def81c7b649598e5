"""List and classify the files of an old component.

In: the folder. Out: `ComponentFile`s with their `FileCategory`. Links are not followed.
"""

from __future__ import annotations

import os
import re
from collections.abc import Iterator
from dataclasses import dataclass
from enum import Enum, auto
from pathlib import Path, PurePosixPath

from robocomp_dsl.source import UnreadableSource, read_source_bytes

SKIPPED_FOLDERS = frozenset(
    ("__pycache__", "build", "bin", "generated", "CMakeFiles", "node_modules")
)
"""Folders without hand-written files."""
MAX_FILES = 5_000
GENERIC_FORM = "ui_mainUI"
"""The module of the main window, which RoboComp's `genericworker` imported."""
_RUNS_WORKER = re.compile(rb"\bspecificworker\b", re.IGNORECASE)


class FileCategory(Enum):
    """How a file is migrated."""

    DESCRIPTION = auto()
    CONFIG = auto()
    WORKER = auto()
    MODULE = auto()
    COPY = auto()
    REPLACED = auto()
    CODE = auto()
    WINDOW = auto()
    LINK = auto()
    TOO_MANY = auto()


@dataclass(frozen=True, slots=True)
class ComponentFile:
    """One file; `relative` is its path in the folder."""

    path: Path
    relative: PurePosixPath
    category: FileCategory


_CODE = {".cpp", ".cc", ".cxx", ".c", ".h", ".hpp", ".hxx", ".cu"}
_BUILD = {".cmake", ".pro", ".ice", ".o", ".so", ".a", ".pyc"}
CONFIG_SUFFIXES = {"", ".conf", ".config", ".cfg", ".toml"}
_GENERATED = re.compile(
    r"""(generic(worker|monitor)|specificmonitor|main|commonbehavior|interfaces)\.\w+
      | [a-z0-9_]+I\.(cpp|h|py) | ui_\w+\.(h|py) | CMakeLists\w*\.txt | (GNU)?Makefile
      | [Dd]oxy[Ff]ile
      | (run|forcerun)\.sh""",
    re.VERBOSE,
)


def _is_skipped(folder: str) -> bool:
    return folder in SKIPPED_FOLDERS or folder.startswith(".") or folder.endswith("_generated")


def list_files(folder: Path) -> Iterator[ComponentFile]:
    """Every hand-written or configuration file of the folder, ordered by path."""
    count = 0
    for place, below, names in os.walk(folder):
        below[:] = sorted(b for b in below if not _is_skipped(b))
        for name in sorted(names):
            if name.startswith("."):
                continue
            path = Path(place, name)
            relative = PurePosixPath(path.relative_to(folder).as_posix())
            count += 1
            if count > MAX_FILES:
                yield ComponentFile(path, relative, FileCategory.TOO_MANY)
                return
            usual = not path.is_symlink() and path.is_file()
            category = _classify(relative) if usual else FileCategory.LINK
            if category is FileCategory.REPLACED and _is_own_module(path, relative):
                category = FileCategory.MODULE
            yield ComponentFile(path, relative, category)


def _is_own_module(path: Path, relative: PurePosixPath) -> bool:
    """Whether a file in `src/` only has a name as RoboComp's generator chooses them.

    RoboComp generated no folders below `src/`, and `ui_x.py` from a form `x.ui`.
    """
    if relative.parts[0] != "src" or relative.suffix != ".py":
        return False
    is_form = relative.stem.startswith("ui_")
    if len(relative.parts) > 2:
        return not is_form or not _has_form(path)
    return is_form and relative.stem != GENERIC_FORM and not _has_form(path)


def _has_form(path: Path) -> bool:
    """Whether the form of `ui_x.py` is beside it."""
    return path.with_name(f"{path.stem.removeprefix('ui_')}.ui").exists()


def is_main_script(file: ComponentFile, component: str) -> bool:
    """Whether a file is the old main program: it has the component's name, and runs the worker."""
    if file.relative.parts != ("src", f"{component}.py"):
        return False
    try:
        return bool(_RUNS_WORKER.search(read_source_bytes(file.path)))
    except UnreadableSource:
        return True


def _classify(relative: PurePosixPath) -> FileCategory:
    """The category of the first rule that applies; a file without one is copied."""
    name, suffix = relative.name, relative.suffix.lower()
    top = relative.parts[0] if len(relative.parts) > 1 else ""
    in_etc = top == "etc" and len(relative.parts) == 2
    rules = (
        (suffix in (".cdsl", ".pdsl", ".idsl") and not top, FileCategory.DESCRIPTION),
        (in_etc and suffix in CONFIG_SUFFIXES, FileCategory.CONFIG),
        (name == "specificworker.py" and top in ("", "src"), FileCategory.WORKER),
        (suffix == ".ui", FileCategory.WINDOW),
        (suffix in _BUILD or bool(_GENERATED.fullmatch(name)), FileCategory.REPLACED),
        (suffix in _CODE, FileCategory.CODE),
        (top == "src" and suffix == ".py", FileCategory.MODULE),
    )
    return next((category for applies, category in rules if applies), FileCategory.COPY)
