"""The index of a file: what each name in it refers to. Most features start here.

In: a file and the workspace. Out: an `Index` with every resolved name, in source order. The checks
report the names that do not resolve; the index leaves them out.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable
from pathlib import Path

from robocomp_dsl.check.workspace.workspace import Workspace
from robocomp_dsl.language_server.symbols import (
    symbols_bdsl,
    symbols_cdsl,
    symbols_ddsl,
    symbols_idsl,
    symbols_innermodel,
    symbols_pdsl,
    symbols_scxml,
    symbols_smdsl,
)
from robocomp_dsl.language_server.symbols.symbol import Index, Occurrence
from robocomp_dsl.source import Source
from robocomp_dsl.syntax.definitions import DEFINITION_SUFFIXES

Indexer = Callable[[Path, Workspace], tuple[Source, bool, Iterable[Occurrence]]]
"""Returns the source of a file, whether it has no syntax errors, and its occurrences."""

INDEXERS: dict[str, Indexer] = {
    ".idsl": symbols_idsl.index_file,
    **dict.fromkeys(DEFINITION_SUFFIXES, symbols_idsl.index_file),
    ".cdsl": symbols_cdsl.index_file,
    ".pdsl": symbols_pdsl.index_file,
    ".ddsl": symbols_ddsl.index_file,
    ".smdsl": symbols_smdsl.index_file,
    ".bdsl": symbols_bdsl.index_file,
    ".scxml": symbols_scxml.index_file,
    ".xml": symbols_innermodel.index_file,
}
"""File suffix (lower case) to the indexer of its language."""


def build_index(path: Path, workspace: Workspace) -> Index:
    """The index of the file at `path`. Raises `UnreadableSource`."""
    indexer = INDEXERS.get(path.suffix.lower())
    if indexer is None:
        return Index(workspace.sources.read(path), complete=True, occurrences=())
    source, complete, occurrences = indexer(path, workspace)
    ordered = sorted(occurrences, key=lambda occurrence: occurrence.span.start)
    return Index(source, complete, tuple(ordered))
