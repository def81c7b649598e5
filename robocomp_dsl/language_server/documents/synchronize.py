"""Document synchronisation: open, change and close.

In: the notifications of the protocol. Out: buffers with the client's text. A position after the end
of the text means that end.
"""

from __future__ import annotations

from lsprotocol import types as lsp

from robocomp_dsl.language_server.positions import PositionCodec
from robocomp_dsl.language_server.session import Document, Session, UnsupportedDocument
from robocomp_dsl.source import Source


def did_open(session: Session, params: lsp.DidOpenTextDocumentParams) -> Document | None:
    """Store the text of a document; None for a language that the server does not support."""
    opened = params.text_document
    try:
        return session.open(opened.uri, opened.text, opened.version)
    except UnsupportedDocument:
        return None


def did_change(session: Session, params: lsp.DidChangeTextDocumentParams) -> Document:
    """Apply the changes in order. Raises `UnsupportedDocument` if the document is not open."""
    document = session.document(params.text_document.uri)
    source = session.files.read(document.path)
    for change in params.content_changes:
        source = Source(document.path, apply_change(source, change, session.positions))
    document.version = params.text_document.version
    session.files.set_overlay(document.path, source.text)
    return document


def did_close(session: Session, params: lsp.DidCloseTextDocumentParams) -> Document | None:
    """Remove the text of a document; None if it was not open."""
    try:
        document = session.document(params.text_document.uri)
    except UnsupportedDocument:
        return None
    session.close(document)
    return document


def apply_change(
    source: Source, change: lsp.TextDocumentContentChangeEvent, positions: PositionCodec
) -> str:
    """The text of `source` after one change."""
    if not isinstance(change, lsp.TextDocumentContentChangePartial):
        return change.text
    first = positions.edit_offset(source, change.range.start)
    second = positions.edit_offset(source, change.range.end)
    start, end = min(first, second), max(first, second)
    return source.text[:start] + change.text + source.text[end:]
