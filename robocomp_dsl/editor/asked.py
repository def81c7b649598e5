"""What a question about a place in a file is about.

In: a document and a position of the protocol. Out: the file, the offset, the names there.
"""

from __future__ import annotations

from collections.abc import Iterator
from pathlib import Path
from typing import Protocol

from lsprotocol import types as lsp

from robocomp_dsl.editor.index import Mention
from robocomp_dsl.editor.positions import offset_at, range_of
from robocomp_dsl.editor.session import Session
from robocomp_dsl.source import Span


class Asked(Protocol):
    """The parameters of any question about a place."""

    @property
    def text_document(self) -> lsp.TextDocumentIdentifier:
        """The file."""

    @property
    def position(self) -> lsp.Position:
        """The place in it."""


def place(session: Session, params: Asked) -> tuple[Path, int]:
    """The file and the offset in it. Raises `NoDescription` and `WrongPosition`."""
    path = session.path_of(params.text_document.uri)
    return path, offset_at(session.source(params.text_document.uri), params.position)


def mentions_at(session: Session, params: Asked) -> list[Mention]:
    """The names at the place."""
    path, offset = place(session, params)
    return list(session.index(path).at(offset))


def location(session: Session, span: Span) -> lsp.Location:
    """Where `span` is, for the client."""
    return lsp.Location(session.uri_of(span.source.path), range_of(span))


def everywhere(session: Session, key: tuple[str, int]) -> Iterator[Mention]:
    """Every mention of a symbol, in all files that are known."""
    for path in session.every_file():
        for one in session.index_or_nothing(path):
            if one.symbol.key == key:
                yield one
