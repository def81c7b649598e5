"""Go to definition: from a name to where it is declared, from a path to the file."""

from __future__ import annotations

from lsprotocol import types as lsp

from robocomp_dsl.language_server.features.document_links import links_of
from robocomp_dsl.language_server.session import Session
from robocomp_dsl.language_server.symbols.lookup import (
    location_of,
    occurrences_at,
    resolve_position,
)


def definition(session: Session, params: lsp.DefinitionParams) -> list[lsp.Location]:
    """The declaration of the name at the position; for a path, the start of the file."""
    path, offset = resolve_position(session, params.text_document, params.position)
    for span, target in links_of(session, path):
        if span.start <= offset <= span.end:
            start = lsp.Position(0, 0)
            return [lsp.Location(session.uri_of(target), lsp.Range(start, start))]
    occurrences = occurrences_at(session, params.text_document, params.position)
    # The name of an instance may also be that of its component: open the component.
    references = [o for o in occurrences if not o.declares] or occurrences
    return [location_of(session, (o.definition or o.symbol).span) for o in references[:1]]
