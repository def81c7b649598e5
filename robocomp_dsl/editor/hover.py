"""Hover: what a name means, with its resolved shape and its doc comment."""

from __future__ import annotations

from lsprotocol import types as lsp

from robocomp_dsl.editor.asked import mentions_at
from robocomp_dsl.editor.index import Symbol
from robocomp_dsl.editor.positions import range_of
from robocomp_dsl.editor.session import Session
from robocomp_dsl.editor.shapes import doc_of, shape


def hover(session: Session, params: lsp.HoverParams) -> lsp.Hover | None:
    """What is at the place; None where there is no name, or one that is not understood."""
    found = mentions_at(session, params)
    if not found:
        return None
    one = found[0]
    return lsp.Hover(markdown(one.nearer or one.symbol), range_of(one.span))


def markdown(symbol: Symbol) -> lsp.MarkupContent:
    """The shape in the language of the file that declares it, then the words about it."""
    language = symbol.span.source.path.suffix[1:].lower()
    said = shape(symbol.thing) or f"{symbol.kind} {symbol.name}"
    parts = [f"```{language}\n{said}\n```", doc_of(symbol.thing)]
    return lsp.MarkupContent(lsp.MarkupKind.Markdown, "\n\n".join(part for part in parts if part))
