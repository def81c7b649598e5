"""References of a symbol in all files, and highlights of its occurrences in one file."""

from __future__ import annotations

from lsprotocol import types as lsp

from robocomp_dsl.check.workspace.source_cache import canonical_path
from robocomp_dsl.language_server.session import Session
from robocomp_dsl.language_server.symbols.lookup import (
    find_occurrences,
    location_of,
    occurrences_at,
    resolve_position,
)


def references(session: Session, params: lsp.ReferenceParams) -> list[lsp.Location]:
    """The occurrences of the symbol at the position, in open files and workspace folders."""
    selected = occurrences_at(session, params.text_document, params.position)
    if not selected:
        return []
    include_declaration = params.context.include_declaration
    spans = {
        (canonical_path(occurrence.span.source.path), occurrence.span.start): occurrence.span
        for occurrence in find_occurrences(session, selected[0].symbol.key)
        if include_declaration or not occurrence.declares
    }
    return [location_of(session, span) for span in spans.values()]


def highlights(
    session: Session, params: lsp.DocumentHighlightParams
) -> list[lsp.DocumentHighlight]:
    """The occurrences of the same symbol in the same file."""
    path, offset = resolve_position(session, params.text_document, params.position)
    index = session.index(path)
    keys = {occurrence.symbol.key for occurrence in index.occurrences_at(offset)}
    by_offset = {o.span.start: o for o in index.occurrences if o.symbol.key in keys}
    return [
        lsp.DocumentHighlight(
            session.positions.range_of(occurrence.span),
            lsp.DocumentHighlightKind.Write
            if occurrence.declares
            else lsp.DocumentHighlightKind.Read,
        )
        for occurrence in by_offset.values()
    ]
