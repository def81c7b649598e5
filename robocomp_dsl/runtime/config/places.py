"""The order of the search: which folders, one after the other, may have a file.

In: roots, a robot, a context. Out: `Place`s; the first that has the file wins. Pure.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator
from dataclasses import dataclass
from pathlib import Path

from robocomp_dsl.runtime.config.surroundings import Origin, Root

CONTEXTS = "contexts"
ROBOTS = "robots"


@dataclass(frozen=True, slots=True)
class Place:
    """A folder that is searched: `within` is the way to it from its root, empty for the root."""

    root: Root
    within: str = ""

    @property
    def folder(self) -> Path:
        """Where it is."""
        return self.root.folder / self.within

    @property
    def in_context(self) -> bool:
        """Whether it belongs to a context."""
        return self.within.startswith(f"{CONTEXTS}/")

    def __str__(self) -> str:
        whose = self.root.origin.value
        return f"{whose}, {self.within}" if self.within else whose


def places(roots: Iterable[Root], robot: str, context: str = "") -> tuple[Place, ...]:
    """Working folder and its `etc`, then the robot, the context, and the roots themselves.

    Each in the order of the roots, as YARP has it (ResourceFinder specification, search order). A
    folder that comes a second time is left out.
    """
    made: dict[Path, Place] = {}
    for one in _all(tuple(roots), robot, context):
        made.setdefault(one.folder, one)
    return tuple(made.values())


def _all(roots: tuple[Root, ...], robot: str, context: str) -> Iterator[Place]:
    for root in roots:
        if root.origin is Origin.WORKING:
            yield Place(root)
            yield Place(root, "etc")
    for root in roots:
        yield Place(root, f"{ROBOTS}/{robot}")
    if context:
        for root in roots:
            yield Place(root, f"{CONTEXTS}/{context}")
    for root in roots:
        yield Place(root)
