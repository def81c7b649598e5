"""A loaded IDSL file: its tree, imports, modules and diagnostics."""

from __future__ import annotations

from collections.abc import Iterable, Iterator
from pathlib import Path

from robocomp_dsl.check.workspace.source_cache import Parsed
from robocomp_dsl.diagnostics import Diagnostic, Severity
from robocomp_dsl.model.interface import Module
from robocomp_dsl.record import Record
from robocomp_dsl.syntax.ast import idsl
from robocomp_dsl.syntax.ast.base import Import


class ResolvedImport(Record):
    """An import statement and its file; None if the file was not found or not loaded."""

    statement: Import
    path: Path | None
    loaded: LoadedModule | None


class LoadedModule(Record):
    """One IDSL file. `findings` are about this file only."""

    parsed: Parsed[idsl.File]
    imports: tuple[ResolvedImport, ...]
    modules: tuple[Module, ...]
    diagnostics: tuple[Diagnostic, ...]


def transitive_imports(links: Iterable[ResolvedImport]) -> Iterator[LoadedModule]:
    """The files that `links` import, directly or indirectly, each once."""
    seen: dict[int, LoadedModule] = {}
    todo = [imported.loaded for imported in links if imported.loaded]
    while todo:
        imported = todo.pop(0)
        if id(imported) not in seen:
            seen[id(imported)] = imported
            todo.extend(link.loaded for link in imported.imports if link.loaded)
    return iter(seen.values())


def transitive_errors(links: Iterable[ResolvedImport]) -> Iterator[Diagnostic]:
    """The errors in the imported files, directly or indirectly imported."""
    for file in transitive_imports(links):
        yield from (d for d in file.diagnostics if d.severity is Severity.ERROR)
