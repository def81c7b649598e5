"""Hover: what a name means, with its resolved shape and its doc comment."""

from __future__ import annotations

from lsprotocol import types as lsp

from robocomp_dsl.editor.asked import mentions_at, place
from robocomp_dsl.editor.hover_innermodel import words_at
from robocomp_dsl.editor.index import Symbol
from robocomp_dsl.editor.positions import range_of
from robocomp_dsl.editor.session import Session
from robocomp_dsl.editor.shapes import doc_of, shape
from robocomp_dsl.syntax.ast_innermodel import File as XmlFile


def hover(session: Session, params: lsp.HoverParams) -> lsp.Hover | None:
    """What is at the place; None where there is no name, or one that is not understood."""
    found = mentions_at(session, params)
    if found:
        one = found[0]
        return lsp.Hover(markdown(one.nearer or one.symbol), range_of(one.span))
    path, offset = place(session, params)
    tree = session.parsed(path).tree
    said = words_at(tree, offset) if isinstance(tree, XmlFile) else None
    if said is None:
        return None
    return lsp.Hover(lsp.MarkupContent(lsp.MarkupKind.Markdown, said[1]), range_of(said[0]))


def markdown(symbol: Symbol) -> lsp.MarkupContent:
    """The shape in the language of the file that declares it, then the words about it."""
    language = symbol.span.source.path.suffix[1:].lower()
    said = shape(symbol.thing) or f"{symbol.kind} {symbol.name}"
    parts = [f"```{language}\n{said}\n```", doc_of(symbol.thing)]
    return lsp.MarkupContent(lsp.MarkupKind.Markdown, "\n\n".join(part for part in parts if part))
