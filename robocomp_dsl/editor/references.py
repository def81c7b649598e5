"""Find references, and highlight the other places of a name in its file."""

from __future__ import annotations

from lsprotocol import types as lsp

from robocomp_dsl.check.files import identity
from robocomp_dsl.editor.asked import everywhere, location, mentions_at, place
from robocomp_dsl.editor.positions import range_of
from robocomp_dsl.editor.session import Session


def references(session: Session, params: lsp.ReferenceParams) -> list[lsp.Location]:
    """Every mention of the symbol at the place, in open files and in the workspace folders."""
    found = mentions_at(session, params)
    if not found:
        return []
    mentions = everywhere(session, found[0].symbol.key)
    declared = params.context.include_declaration
    places = {
        (identity(one.span.source.path), one.span.start): one.span
        for one in mentions
        if declared or not one.declares
    }
    return [location(session, span) for span in places.values()]


def highlights(
    session: Session, params: lsp.DocumentHighlightParams
) -> list[lsp.DocumentHighlight]:
    """The mentions of the same symbol in the same file."""
    path, offset = place(session, params)
    index = session.index(path)
    keys = {one.symbol.key for one in index.at(offset)}
    spans = {one.span.start: one for one in index.mentions if one.symbol.key in keys}
    return [
        lsp.DocumentHighlight(
            range_of(one.span),
            lsp.DocumentHighlightKind.Write if one.declares else lsp.DocumentHighlightKind.Read,
        )
        for one in spans.values()
    ]
