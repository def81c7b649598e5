"""Loads IDSL files with their imports and caches them until one of the texts changes.

In: a path. Out: `LoadedModule`; its `modules` are shared by all importing files, so that each
declaration is one object.
"""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path

from robocomp_dsl.check.causes import report_causes
from robocomp_dsl.check.codes import names as codes
from robocomp_dsl.check.idsl.resolve import resolve_idsl
from robocomp_dsl.check.idsl.rules import check_idsl_rules
from robocomp_dsl.check.names.import_scope import ImportScope, Tree
from robocomp_dsl.check.names.suggest import ImportSuggestion, suggest_import
from robocomp_dsl.check.workspace.import_resolver import ImportResolver
from robocomp_dsl.check.workspace.imports import (
    find_import,
    locate_import,
    report_cycle,
    report_duplicate_imports,
)
from robocomp_dsl.check.workspace.loaded import LoadedModule, ResolvedImport
from robocomp_dsl.check.workspace.source_cache import Parsed, SourceCache, canonical_path
from robocomp_dsl.diagnostics import Report
from robocomp_dsl.model.interface import Module
from robocomp_dsl.source import UnreadableSource
from robocomp_dsl.syntax.ast.base import Import, QualifiedName
from robocomp_dsl.syntax.ast.idsl import File
from robocomp_dsl.syntax.parse import DEFINITIONS, parse_idsl

MAX_DEPTH = 50
"""Maximum depth of nested imports; more would exhaust the stack."""


class ModuleLoader:
    """The cache of all IDSL files of a workspace."""

    def __init__(self, files: SourceCache, search: ImportResolver) -> None:
        self._files = files
        self._search = search
        self._loaded: dict[str, LoadedModule] = {}
        self._fresh: set[str] = set()
        self._open: list[tuple[str, Import | None]] = []
        self._in_cycle: set[str] = set()
        self._root = Path()

    def start_run(self, root: Path) -> None:
        """Start checking the file `root`: imports are also searched from its folder."""
        self._root = root
        self._search.start_run()
        self._fresh.clear()
        for key in self._in_cycle:
            self._loaded.pop(key, None)
        self._in_cycle.clear()

    def load(self, path: Path, statement: Import | None = None) -> LoadedModule:
        """Load the file at `path`, imported by `statement`. Raises `UnreadableSource`."""
        key = canonical_path(path)
        cached = self._loaded.get(key)
        if cached is not None and self._is_fresh(key, cached, path):
            return cached
        self._open.append((key, statement))
        try:
            loaded = self._resolve(path)
        finally:
            self._open.pop()
        self._loaded[key] = loaded
        self._fresh.add(key)
        return loaded

    def resolve_imports(
        self, statements: tuple[Import, ...], report: Report
    ) -> list[ResolvedImport]:
        """Resolve import statements; failures are reported."""
        links = [self._resolve_import(statement, report) for statement in statements]
        report_duplicate_imports(statements, [link.path for link in links], report)
        return links

    def _resolve_import(self, statement: Import, report: Report) -> ResolvedImport:
        path = find_import(statement, self._root, self._search, report)
        if path is None or self._closes_cycle(path, statement, report):
            return ResolvedImport(statement, path, None)
        try:
            return ResolvedImport(statement, path, self.load(path, statement))
        except UnreadableSource as error:
            span = statement.path.span
            report.add(codes.UNREADABLE_IMPORT, span, f"cannot read `{path}`: {error}")
            return ResolvedImport(statement, path, None)

    def _closes_cycle(self, path: Path, statement: Import, report: Report) -> bool:
        """Whether `path` is being loaded already; reports the cycle."""
        keys = [key for key, _ in self._open]
        key = canonical_path(path)
        if key not in keys:
            if len(keys) >= MAX_DEPTH:
                report.add(
                    codes.IMPORTS_TOO_DEEP,
                    statement.path.span,
                    f"imports are nested more than {MAX_DEPTH} deep",
                )
            return len(keys) >= MAX_DEPTH
        members = self._open[keys.index(key) :]
        into = [via for _, via in members[1:] if via is not None]
        self._in_cycle.update(member for member, _ in members)
        report_cycle(
            [(member, via) for (member, _), via in zip(members, (*into, statement), strict=True)],
            report,
        )
        return True

    def _resolve(self, path: Path) -> LoadedModule:
        parser = DEFINITIONS.get(path.suffix.lower(), parse_idsl)
        parsed = self._files.parse(path, parser)
        report = Report()
        report.extend(parsed.diagnostics)
        links = tuple(self.resolve_imports(parsed.tree.imports, report))

        def resolve(file: Parsed[File], report: Report) -> tuple[Module, ...]:
            modules: list[Module] = []
            for tree in file.tree.modules:
                scope = self.import_scope(file, links, modules)
                resolved = resolve_idsl(tree, path, scope, report)
                check_idsl_rules(resolved, report)
                modules.append(resolved.module)
            return tuple(modules)

        modules = resolve(parsed, report)
        report_causes(report, parsed, parser, resolve)
        return LoadedModule(parsed, links, modules, tuple(report))

    def import_scope(
        self, file: Parsed[Tree], links: Sequence[ResolvedImport], earlier: Sequence[Module] = ()
    ) -> ImportScope:
        """The scope of the names in `file`."""
        statements = [link.statement for link in links]

        offers: dict[str, ImportSuggestion | None] = {}

        def offer(name: QualifiedName) -> ImportSuggestion | None:
            if name.text not in offers:
                offers[name.text] = suggest_import(
                    name, file.source, statements, self._files, self._search
                )
            return offers[name.text]

        return ImportScope(file, links, offer, earlier)

    def _is_fresh(self, key: str, cached: LoadedModule, path: Path) -> bool:
        """Whether the file, its imports and their files are unchanged."""
        if key in self._fresh:
            return True
        if self._files.read(path) is not cached.parsed.source:
            return False
        if not all(self._is_unchanged(link) for link in cached.imports):
            return False
        self._fresh.add(key)
        return True

    def _is_unchanged(self, link: ResolvedImport) -> bool:
        found = locate_import(link.statement, self._root, self._search)
        if found is None or link.loaded is None:
            return False  # the diagnostic lists the searched folders
        key = canonical_path(found)
        same = found == link.path and self._loaded.get(key) is link.loaded
        return same and self._is_fresh(key, link.loaded, found)
