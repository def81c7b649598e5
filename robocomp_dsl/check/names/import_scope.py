"""The scope of a file: the declarations of its imports.

In: the imports of a file. Out: declarations by name, direct imports first; import suggestions; and
whether an unknown name is only a follow-on error of a syntax error.
"""

from __future__ import annotations

import re
from collections.abc import Callable, Iterable, Sequence
from functools import cached_property
from typing import Protocol, TypeVar

from robocomp_dsl.check.names.suggest import ImportSuggestion
from robocomp_dsl.check.workspace.loaded import ResolvedImport, transitive_imports
from robocomp_dsl.check.workspace.ros_definitions import is_ros_import
from robocomp_dsl.check.workspace.source_cache import Parsed
from robocomp_dsl.model.interface import Module
from robocomp_dsl.model.types import Declaration
from robocomp_dsl.syntax.ast.base import QualifiedName

Kind = TypeVar("Kind", bound=Declaration)
_DECLARED = re.compile(r"\b(?:struct|enum|exception|interface|union|service)\s+(\w+)|>\s*(\w+)\s*;")


class Tree(Protocol):
    """Any language's tree."""

    @property
    def complete(self) -> bool:
        """Whether the file has no syntax errors."""


class ImportScope:
    """The imported declarations.

    `earlier` are preceding modules of the same file; `suggest_import` finds files that declare a
    name.
    """

    def __init__(
        self,
        file: Parsed[Tree],
        links: Sequence[ResolvedImport],
        importable: Callable[[QualifiedName], ImportSuggestion | None],
        earlier: Iterable[Module] = (),
    ) -> None:
        self.suggest_import = importable
        direct = [m for link in links if link.loaded for m in link.loaded.modules]
        direct.extend(earlier)
        self.direct = tuple(dict.fromkeys(direct))
        everything = (m for module in self.direct for m in module.closure())
        self._modules = tuple(dict.fromkeys((*self.direct, *everything)))
        transitive = list(transitive_imports(links))
        trees = [file, *(loaded.parsed for loaded in transitive)]
        self._broken = [loaded.source for loaded in trees if not loaded.tree.complete]
        every_link = [*links, *(link for loaded in transitive for link in loaded.imports)]
        missing = [link.statement.path.value for link in every_link if link.loaded is None]
        self._missing = bool(missing)
        self._missing_packages = {w.partition("/")[0] for w in missing if is_ros_import(w)}

    def lookup(self, name: QualifiedName, kind: type[Kind]) -> list[Kind]:
        """The declarations called `name`; direct imports shadow indirect imports."""
        module = name.module.text if name.module else None
        found = [
            (imported, declaration)
            for imported, declaration in self._by_name.get(name.name.text, ())
            if module in (None, imported.name) and isinstance(declaration, kind)
        ]
        direct = [declaration for imported, declaration in found if imported in self.direct]
        if module is None and len(found) > 1 and direct:
            return direct
        return [declaration for _, declaration in found]

    @cached_property
    def _by_name(self) -> dict[str, list[tuple[Module, Declaration]]]:
        by_name: dict[str, list[tuple[Module, Declaration]]] = {}
        for imported in self._modules:
            for declaration in (*imported.declarations, *imported.aliases):
                by_name.setdefault(declaration.name, []).append((imported, declaration))
        return by_name

    def declarations(self, kind: type[Kind], module: str | None = None) -> list[Kind]:
        """All visible declarations of a kind, or those of one module."""
        return [
            declaration
            for imported in self._modules
            if module is None or imported.name == module
            for declaration in imported.declarations
            if isinstance(declaration, kind)
        ]

    def module_names(self) -> list[str]:
        """Names of all visible modules."""
        return [module.name for module in self._modules]

    def is_follow_on_error(self, name: QualifiedName, guess: str | None) -> bool:
        """Whether an unknown `name` is probably caused by an error that is already reported."""
        if name.name.text in self._declared_in_broken:
            return True
        if name.module and name.module.text in self._missing_packages:
            return True
        return self._missing and guess is None

    @cached_property
    def _declared_in_broken(self) -> frozenset[str]:
        """Names that files with syntax errors seem to declare."""
        found = (pair for source in self._broken for pair in _DECLARED.findall(source.text))
        return frozenset(a or b for a, b in found)
