"""Go to definition: from a name to where it is declared, from a path to the file."""

from __future__ import annotations

from lsprotocol import types as lsp

from robocomp_dsl.editor.asked import location, mentions_at, place
from robocomp_dsl.editor.links import links_of
from robocomp_dsl.editor.session import Session


def definition(session: Session, params: lsp.DefinitionParams) -> list[lsp.Location]:
    """Where the name at the place is declared; of a file its beginning."""
    path, offset = place(session, params)
    for span, target in links_of(session, path):
        if span.start <= offset <= span.end:
            start = lsp.Position(0, 0)
            return [lsp.Location(session.uri_of(target), lsp.Range(start, start))]
    found = mentions_at(session, params)
    # The name of an instance that is also that of its component: the component says more.
    used = [one for one in found if not one.declares] or found
    return [location(session, (one.nearer or one.symbol).span) for one in used[:1]]
