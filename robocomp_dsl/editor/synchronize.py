"""Open, change and close: the client's texts become the session's.

In: the notifications of the protocol. Out: buffers that hold what the client shows, whatever it
sent: a place behind the end of the text means that end.
"""

from __future__ import annotations

from lsprotocol import types as lsp

from robocomp_dsl.editor.positions import edit_offset
from robocomp_dsl.editor.session import Document, NoDescription, Session
from robocomp_dsl.source import Source


def did_open(session: Session, params: lsp.DidOpenTextDocumentParams) -> Document | None:
    """Take over the text of a document; None for a language that is not ours."""
    opened = params.text_document
    try:
        return session.open(opened.uri, opened.text, opened.version)
    except NoDescription:
        return None


def did_change(session: Session, params: lsp.DidChangeTextDocumentParams) -> Document:
    """Apply the changes, one after the other. Raises `NoDescription` for what is not open."""
    document = session.document(params.text_document.uri)
    source = session.files.read(document.path)
    for change in params.content_changes:
        source = Source(document.path, changed(source, change))
    document.version = params.text_document.version
    session.files.open_buffer(document.path, source.text)
    return document


def did_close(session: Session, params: lsp.DidCloseTextDocumentParams) -> Document | None:
    """Forget the text of a document; None for one that was not open."""
    try:
        document = session.document(params.text_document.uri)
    except NoDescription:
        return None
    session.close(document)
    return document


def changed(source: Source, change: lsp.TextDocumentContentChangeEvent) -> str:
    """The text of `source` after one change."""
    if not isinstance(change, lsp.TextDocumentContentChangePartial):
        return change.text
    one = edit_offset(source, change.range.start)
    other = edit_offset(source, change.range.end)
    start, end = min(one, other), max(one, other)
    return source.text[:start] + change.text + source.text[end:]
