"""Finds the candidates for a file name in the search paths.

In: a name, search paths. Out: every candidate, and whether it can be used. Names that leave the
search paths are rejected.
"""

from __future__ import annotations

import re
from collections.abc import Iterable
from dataclasses import dataclass
from pathlib import Path, PurePath

from robocomp_dsl.runtime.config.search_paths import SearchPath

CONTEXT_NAME = re.compile(
    r"[A-Za-z0-9_][A-Za-z0-9_.-]{0,99}(/[A-Za-z0-9_][A-Za-z0-9_.-]{0,99}){0,7}"
)


class InvalidName(ValueError):
    """A name that cannot be searched for; the message shows the valid form."""


@dataclass(frozen=True, slots=True)
class Candidate:
    """One candidate. `skip_reason` is empty if it can be used."""

    path: Path
    search_path: SearchPath
    skip_reason: str = ""

    @property
    def is_usable(self) -> bool:
        """Whether it can be used."""
        return not self.skip_reason


def validate_context(name: str, kind: str = "context") -> str:
    """Return `name`. Raises `InvalidName` if it is not the name of a folder inside `contexts`."""
    if not CONTEXT_NAME.fullmatch(name):
        raise InvalidName(
            f"`{name:.80}` is not a valid {kind}: use letters, digits, `_`, `-` and `.`;"
            f" `/` separates nested names"
        )
    return name


def validate_file(name: str) -> PurePath:
    """`name` as a relative path. Raises `InvalidName` if it leaves the search paths."""
    path = PurePath(name)
    if not path.parts or path.is_absolute() or ".." in path.parts or "\0" in name:
        raise InvalidName(
            f"`{name:.80}` cannot be searched for: it leaves the search paths;"
            " `--config` accepts any path"
        )
    return path


def search(name: str, paths: Iterable[SearchPath]) -> list[Candidate]:
    """All candidates in order; the first usable one wins. Raises `InvalidName`."""
    file = validate_file(name)
    return [Candidate(p.folder / file, p, _skip_reason(p.folder / file)) for p in paths]


def _skip_reason(path: Path) -> str:
    try:
        if path.is_file():
            return ""
        return "a folder" if path.is_dir() else "not found"
    except OSError as error:
        return error.strerror or str(error)
