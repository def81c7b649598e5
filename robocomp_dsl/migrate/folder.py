"""What lies in the folder of an old component, and what becomes of each file.

In: the folder. Out: `Found` files by `Fate`. Links are not followed; nothing is changed.
"""

from __future__ import annotations

import os
import re
from collections.abc import Iterator
from dataclasses import dataclass
from enum import Enum, auto
from pathlib import Path, PurePosixPath

SKIPPED = frozenset(("__pycache__", "build", "bin", "generated", "CMakeFiles", "node_modules"))
"""Folders with nothing that somebody wrote."""
MOST_FILES = 5_000


class Fate(Enum):
    """What becomes of a file."""

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
class Found:
    """One file; `relative` is its path in the folder."""

    path: Path
    relative: PurePosixPath
    fate: Fate


_CODE = {".cpp", ".cc", ".cxx", ".c", ".h", ".hpp", ".hxx", ".cu"}
_BUILD = {".cmake", ".pro", ".ice", ".o", ".so", ".a", ".pyc"}
CONFIG_SUFFIXES = {"", ".conf", ".config", ".cfg", ".toml"}
_GENERATED = re.compile(
    r"""(generic(worker|monitor)|specificmonitor|main|commonbehavior|interfaces)\.\w+
      | \w+I\.(cpp|h|py) | ui_\w+\.(h|py) | CMakeLists\w*\.txt | (GNU)?Makefile | [Dd]oxy[Ff]ile
      | (run|forcerun)\.sh""",
    re.VERBOSE,
)


def files_of(folder: Path) -> Iterator[Found]:
    """Every file of the folder that somebody may miss, in order of path."""
    count = 0
    for place, below, names in os.walk(folder):
        below[:] = sorted(b for b in below if not b.startswith(".") and b not in SKIPPED)
        for name in sorted(names):
            if name.startswith("."):
                continue
            path = Path(place, name)
            relative = PurePosixPath(path.relative_to(folder).as_posix())
            count += 1
            if count > MOST_FILES:
                yield Found(path, relative, Fate.TOO_MANY)
                return
            usual = not path.is_symlink() and path.is_file()
            yield Found(path, relative, _fate(relative) if usual else Fate.LINK)


def _fate(relative: PurePosixPath) -> Fate:
    """The first rule that holds for a file; the others are copied as they are."""
    name, suffix = relative.name, relative.suffix.lower()
    top = relative.parts[0] if len(relative.parts) > 1 else ""
    in_etc = top == "etc" and len(relative.parts) == 2
    rules = (
        (suffix in (".cdsl", ".pdsl", ".idsl") and not top, Fate.DESCRIPTION),
        (in_etc and suffix in CONFIG_SUFFIXES, Fate.CONFIG),
        (name == "specificworker.py" and top in ("", "src"), Fate.WORKER),
        (suffix == ".ui", Fate.WINDOW),
        (suffix in _BUILD or bool(_GENERATED.fullmatch(name)), Fate.REPLACED),
        (suffix in _CODE, Fate.CODE),
        (top == "src" and suffix == ".py", Fate.MODULE),
    )
    return next((fate for holds, fate in rules if holds), Fate.COPY)
