"""Computes the search order: the folders that may hold a file, one after the other. Pure.

In: roots, a robot, a context. Out: `SearchPath`s; the first that has the file wins.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator
from dataclasses import dataclass
from pathlib import Path

from robocomp_dsl.runtime.config.search_environment import Origin, Root

CONTEXTS = "contexts"
ROBOTS = "robots"


@dataclass(frozen=True, slots=True)
class SearchPath:
    """A folder that is searched: `subfolder` of `root`, empty for the root itself."""

    root: Root
    subfolder: str = ""

    @property
    def folder(self) -> Path:
        """The folder."""
        return self.root.folder / self.subfolder

    @property
    def in_context(self) -> bool:
        """Whether it belongs to a context."""
        return self.subfolder.startswith(f"{CONTEXTS}/")

    def __str__(self) -> str:
        origin = self.root.origin.value
        return f"{origin}, {self.subfolder}" if self.subfolder else origin


def search_paths(roots: Iterable[Root], robot: str, context: str = "") -> tuple[SearchPath, ...]:
    """The search order: working folder and its `etc`, then robot, context, and the roots.

    Each group follows the order of the roots, as in YARP (ResourceFinder specification). A folder
    that occurs again is left out.
    """
    paths: dict[Path, SearchPath] = {}
    for path in _ordered_paths(tuple(roots), robot, context):
        paths.setdefault(path.folder, path)
    return tuple(paths.values())


def _ordered_paths(roots: tuple[Root, ...], robot: str, context: str) -> Iterator[SearchPath]:
    for root in roots:
        if root.origin is Origin.WORKING:
            yield SearchPath(root)
            yield SearchPath(root, "etc")
    for root in roots:
        yield SearchPath(root, f"{ROBOTS}/{robot}")
    if context:
        for root in roots:
            yield SearchPath(root, f"{CONTEXTS}/{context}")
    for root in roots:
        yield SearchPath(root)
