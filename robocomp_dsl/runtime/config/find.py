"""Looks for a file in places. In: a name, places. Out: every candidate, and whether it is there.

Names that lead out of the folders are refused.
"""

from __future__ import annotations

import re
from collections.abc import Iterable
from dataclasses import dataclass
from pathlib import Path, PurePath

from robocomp_dsl.runtime.config.places import Place

CONTEXT = re.compile(r"[A-Za-z0-9_][A-Za-z0-9_.-]{0,99}(/[A-Za-z0-9_][A-Za-z0-9_.-]{0,99}){0,7}")


class WrongName(ValueError):
    """A name that may not be searched for; the message says what it should look like."""


@dataclass(frozen=True, slots=True)
class Tried:
    """One candidate. `obstacle` is empty when it can be used, else says why not."""

    path: Path
    place: Place
    obstacle: str = ""

    @property
    def there(self) -> bool:
        """Whether it can be used."""
        return not self.obstacle


def checked_context(name: str, what: str = "context") -> str:
    """`name` itself. Raises `WrongName` for what is no name of a folder inside `contexts`."""
    if not CONTEXT.fullmatch(name):
        raise WrongName(
            f"`{name:.80}` is no {what}: letters, digits, `_`, `-` and `.`, with `/` in between"
            f" for a {what} inside another"
        )
    return name


def checked_file(name: str) -> PurePath:
    """`name` as a path to search for. Raises `WrongName` for one that leaves the folder."""
    path = PurePath(name)
    if not path.parts or path.is_absolute() or ".." in path.parts or "\0" in name:
        raise WrongName(
            f"`{name:.80}` cannot be searched for: it leads out of the folders;"
            " `--config` takes any path"
        )
    return path


def search(name: str, places: Iterable[Place]) -> list[Tried]:
    """All candidates in order; the first that is `there` wins. Raises `WrongName`."""
    path = checked_file(name)
    return [Tried(one.folder / path, one, _obstacle(one.folder / path)) for one in places]


def _obstacle(path: Path) -> str:
    try:
        if path.is_file():
            return ""
        return "a folder" if path.is_dir() else "not there"
    except OSError as error:
        return error.strerror or str(error)
