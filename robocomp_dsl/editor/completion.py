"""Completion: the keywords that may stand here, and the names that mean something here.

In: a place in a file, mostly a half-typed one. Out: items. Keywords come from the parse tables,
names from what the file and its imports say now or said when the file was last whole.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator

from lsprotocol import types as lsp

from robocomp_dsl.check.units import KNOWN
from robocomp_dsl.editor import (
    complete_cdsl,
    complete_ddsl,
    complete_idsl,
    complete_innermodel,
    complete_paths,
    complete_pdsl,
    complete_scxml,
    complete_smdsl,
)
from robocomp_dsl.editor.asked import place
from robocomp_dsl.editor.cursor import Cursor, cursor_at
from robocomp_dsl.editor.hover import markdown
from robocomp_dsl.editor.offer import Offer, words
from robocomp_dsl.editor.positions import range_of
from robocomp_dsl.editor.session import Session
from robocomp_dsl.editor.xml_cursor import XmlCursor, xml_cursor_at

TRIGGERS = ['"', ":", ".", "[", "<", "/"]

_LEGACY = frozenset(
    (
        "EXTENDS",
        "NO_GUI",
        "USEQT",
        "QTVERSION",
        "WORKER",
        "ROBOCOMPCLASSES",
        "ROBOCOMPMODULES",
        "OLD_TRANSITIONS",
    )
)
"""Keywords that only serve to understand old files and mistakes."""
_PORTS = frozenset(("IMPLEMENTS", "REQUIRES", "SUBSCRIBES", "PUBLISHES"))
_NOT_IN = {
    "COMPONENT": _PORTS,
    "MODULE": frozenset(("IDEMPOTENT", "OUT")),
    "STRUCT": frozenset(("SEQUENCE", "DICTIONARY")),
    "EXCEPTION": frozenset(("SEQUENCE", "DICTIONARY")),
    "INTERFACE": frozenset(("SEQUENCE", "DICTIONARY")),
}
"""Keywords that the parser takes in a block only to say that they belong elsewhere."""


PATTERNS = ("command", "query", "publish")

_NAMES: dict[str, Callable[[Session, Cursor], Iterator[Offer]]] = {
    "idsl": complete_idsl.names,
    "cdsl": complete_cdsl.names,
    "ddsl": complete_ddsl.names,
    "pdsl": complete_pdsl.names,
    "smdsl": complete_smdsl.names,
}

_XML: dict[str, Callable[[Session, XmlCursor], Iterator[Offer]]] = {
    ".scxml": complete_scxml.offers,
    ".xml": complete_innermodel.offers,
}


def completion(session: Session, params: lsp.CompletionParams) -> list[lsp.CompletionItem]:
    """What can be typed at the place."""
    path, offset = place(session, params)
    source = session.source(params.text_document.uri)
    cursor: Cursor | XmlCursor | None = None
    found: Iterator[Offer] = iter(())
    if path.suffix.lower() in _XML:
        if cursor := xml_cursor_at(path, source, offset):
            found = _XML[path.suffix.lower()](session, cursor)
    elif path.suffix[1:].lower() in _NAMES and (cursor := cursor_at(path, source, offset)):
        found = _offers(session, cursor)
    if cursor is None:
        return []
    place_of_word = range_of(source.span(cursor.start, offset))
    offers: dict[str, Offer] = {}
    for one in found:
        offers.setdefault(one.label, one)
    return [_item(place_of_word, one, number) for number, one in enumerate(offers.values())]


def _offers(session: Session, cursor: Cursor) -> Iterator[Offer]:
    """Names first, then keywords."""
    if cursor.quoted:
        yield from complete_paths.paths(session, cursor)
    elif cursor.bracketed:
        begins = cursor.inside == "INTERFACE" and not cursor.statement
        yield from words(*(PATTERNS if begins else sorted(KNOWN)))
    else:
        if cursor.accepted & {"ID", "BRACKETED"}:
            yield from _NAMES[cursor.tables.language](session, cursor)
        yield from _keywords(cursor)


def _keywords(cursor: Cursor) -> Iterator[Offer]:
    hidden = _LEGACY | _NOT_IN.get(cursor.inside, frozenset())
    if cursor.tables.language == "idsl" and not cursor.block and not cursor.statement:
        hidden |= cursor.tables.words - {"IMPORT", "MODULE"}
    if cursor.last == "COMMA":  # one too many is forgiven, not asked for
        hidden |= {"ON", "AFTER"}
    for kind in sorted((cursor.accepted & cursor.tables.words) - hidden):
        yield Offer(cursor.tables.texts[kind], lsp.CompletionItemKind.Keyword)


def _item(place_of_word: lsp.Range, offer: Offer, number: int) -> lsp.CompletionItem:
    also = offer.also.edits if offer.also else ()
    return lsp.CompletionItem(
        offer.label,
        kind=offer.kind,
        detail=offer.detail or None,
        documentation=_about(offer),
        sort_text=f"{number:05}",
        text_edit=lsp.TextEdit(place_of_word, offer.label),
        additional_text_edits=[lsp.TextEdit(range_of(one.span), one.text) for one in also] or None,
    )


def _about(offer: Offer) -> lsp.MarkupContent | None:
    if offer.symbol:
        return markdown(offer.symbol)
    return lsp.MarkupContent(lsp.MarkupKind.Markdown, offer.about) if offer.about else None
