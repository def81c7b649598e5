"""What a name can mean in a file, given what the file imports.

In: the imports of a file. Out: declarations by name, the nearest first; guesses for wrong names;
and whether a name may be missing only because a text could not be understood.
"""

from __future__ import annotations

import re
from collections.abc import Callable, Iterable, Sequence
from functools import cached_property
from typing import Protocol, TypeVar

from robocomp_dsl.check.files import Parsed
from robocomp_dsl.check.loaded import Link, every_file
from robocomp_dsl.check.suggest import Offer
from robocomp_dsl.model.interface import Module
from robocomp_dsl.model.types import Declaration
from robocomp_dsl.syntax.ast_base import QualifiedName

Kind = TypeVar("Kind", bound=Declaration)
_DECLARED = re.compile(r"\b(?:struct|enum|exception|interface)\s+(\w+)|>\s*(\w+)\s*;")


class Tree(Protocol):
    """Any language's tree."""

    @property
    def complete(self) -> bool:
        """Whether all of the text was understood."""


class Visible:
    """The declarations behind imports.

    `earlier` are modules that stand above in the same file; `importable` offers to import the file
    that declares a name.
    """

    def __init__(
        self,
        file: Parsed[Tree],
        links: Sequence[Link],
        importable: Callable[[QualifiedName], Offer | None],
        earlier: Iterable[Module] = (),
    ) -> None:
        self.importable = importable
        direct = [m for link in links if link.loaded for m in link.loaded.modules]
        direct.extend(earlier)
        self.direct = tuple(dict.fromkeys(direct))
        everything = (m for module in self.direct for m in module.closure())
        self._modules = tuple(dict.fromkeys((*self.direct, *everything)))
        behind = list(every_file(links))
        trees = [file, *(one.parsed for one in behind)]
        self._broken = [one.source for one in trees if not one.tree.complete]
        every_link = [*links, *(link for one in behind for link in one.links)]
        self._missing = any(link.loaded is None for link in every_link)

    def find(self, name: QualifiedName, kind: type[Kind]) -> list[Kind]:
        """What `name` can mean; direct imports hide what only they import."""
        module = name.module.text if name.module else None
        found = [
            (one, declaration)
            for one, declaration in self._by_name.get(name.name.text, ())
            if module in (None, one.name) and isinstance(declaration, kind)
        ]
        direct = [declaration for one, declaration in found if one in self.direct]
        if module is None and len(found) > 1 and direct:
            return direct
        return [declaration for _, declaration in found]

    @cached_property
    def _by_name(self) -> dict[str, list[tuple[Module, Declaration]]]:
        made: dict[str, list[tuple[Module, Declaration]]] = {}
        for one in self._modules:
            for declaration in one.declarations:
                made.setdefault(declaration.name, []).append((one, declaration))
        return made

    def declarations(self, kind: type[Kind], module: str | None = None) -> list[Kind]:
        """All visible declarations of a kind, or those of one module."""
        return [
            declaration
            for one in self._modules
            if module is None or one.name == module
            for declaration in one.declarations
            if isinstance(declaration, kind)
        ]

    def module_names(self) -> list[str]:
        """Names of all visible modules."""
        return [module.name for module in self._modules]

    def is_excused(self, name: QualifiedName, guess: str | None) -> bool:
        """Whether an unknown `name` is but the echo of an error that was reported already."""
        if name.name.text in self._declared_in_broken:
            return True
        return self._missing and guess is None

    @cached_property
    def _declared_in_broken(self) -> frozenset[str]:
        """What texts that were not understood seem to declare."""
        found = (pair for source in self._broken for pair in _DECLARED.findall(source.text))
        return frozenset(a or b for a, b in found)
