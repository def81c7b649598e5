"""Lookup of the occurrences at a position of the protocol, and of all occurrences of a symbol."""

from __future__ import annotations

from collections.abc import Iterator
from pathlib import Path

from lsprotocol import types as lsp

from robocomp_dsl.language_server.session import Session
from robocomp_dsl.language_server.symbols.symbol import Occurrence
from robocomp_dsl.source import Span


def resolve_position(
    session: Session, document: lsp.TextDocumentIdentifier, position: lsp.Position
) -> tuple[Path, int]:
    """The file and the offset in it. Raises `UnsupportedDocument` and `InvalidPosition`."""
    path = session.path_of(document.uri)
    return path, session.positions.offset_at(session.source(document.uri), position)


def occurrences_at(
    session: Session, document: lsp.TextDocumentIdentifier, position: lsp.Position
) -> list[Occurrence]:
    """The occurrences at a position. Raises `UnsupportedDocument` and `InvalidPosition`."""
    path, offset = resolve_position(session, document, position)
    return list(session.index(path).occurrences_at(offset))


def location_of(session: Session, span: Span) -> lsp.Location:
    """The location of `span` in the client's terms."""
    uri = session.uri_of(span.source.path)
    return lsp.Location(uri, session.positions.range_of(span))


def find_occurrences(session: Session, key: tuple[str, int]) -> Iterator[Occurrence]:
    """All occurrences of the symbol with that key, in all known files."""
    for path in session.known_files():
        for occurrence in session.occurrences_in(path):
            if occurrence.symbol.key == key:
                yield occurrence
