"""What fits at a place in XML, whatever the language: tags, their ends, attributes, values.

In: a cursor, and what a language offers at each kind of place. Out: offers.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable, Iterator

from lsprotocol import types as lsp

from robocomp_dsl.editor.offer import Offer
from robocomp_dsl.editor.xml_cursor import Place, XmlCursor


def offers(
    cursor: XmlCursor,
    tags: Callable[[str], Iterable[Offer]],
    attributes: Callable[[], Iterable[Offer]],
    values: Callable[[], Iterable[Offer]],
) -> Iterator[Offer]:
    """Everything that fits; `tags` takes what stands before a name."""
    match cursor.place:
        case Place.CONTENT:
            yield from tags("<")
            yield from ends(cursor, "</")
        case Place.TAG:
            yield from tags("")
            yield from ends(cursor, "/")
        case Place.CLOSING:
            yield from ends(cursor, "")
        case Place.ATTRIBUTE:
            yield from attributes()
        case Place.VALUE:
            yield from values()


def ends(cursor: XmlCursor, before: str) -> Iterator[Offer]:
    """The closing tag of what is open."""
    if cursor.around:
        end = "" if cursor.source.text[cursor.offset : cursor.offset + 1] == ">" else ">"
        label = f"{before}{cursor.around[-1]}{end}"
        yield Offer(label, lsp.CompletionItemKind.Class, "ends the tag")
