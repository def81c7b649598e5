"""What an SCXML text can have at a place: elements, attributes, states, ends of tags."""

from __future__ import annotations

from collections.abc import Iterator

from lsprotocol import types as lsp

from robocomp_dsl.check.scxml_form import local
from robocomp_dsl.check.scxml_tags import STATES, TAGS
from robocomp_dsl.editor import complete_xml
from robocomp_dsl.editor.names_innermodel import elements
from robocomp_dsl.editor.names_scxml import LEADS, words
from robocomp_dsl.editor.offer import Offer
from robocomp_dsl.editor.session import Session
from robocomp_dsl.editor.xml_cursor import XmlCursor
from robocomp_dsl.syntax.ast_innermodel import File

_ROOT = "scxml"


def offers(session: Session, cursor: XmlCursor) -> Iterator[Offer]:
    """Everything that fits."""
    return complete_xml.offers(
        cursor,
        lambda before: _tags(cursor, before),
        lambda: _attributes(cursor),
        lambda: _values(session, cursor),
    )


def _attributes(cursor: XmlCursor) -> Iterator[Offer]:
    known = TAGS.get(cursor.tag)
    for name in known.attributes if known else ():
        if name not in cursor.written:
            yield Offer(name, lsp.CompletionItemKind.Property)


def _values(session: Session, cursor: XmlCursor) -> Iterator[Offer]:
    if cursor.attribute in LEADS.get(cursor.tag, ()):
        yield from _states(session, cursor)


def _tags(cursor: XmlCursor, before: str) -> Iterator[Offer]:
    around = TAGS.get(cursor.around[-1]) if cursor.around else None
    names = around.holds if around else () if cursor.around else (_ROOT,)
    for name in names:
        yield Offer(before + name, lsp.CompletionItemKind.Class, TAGS[name].unused)


def _states(session: Session, cursor: XmlCursor) -> Iterator[Offer]:
    """The states of the file, behind those that the attribute lists already."""
    written = cursor.source.text[cursor.start : cursor.offset]
    front = written[: len(written) - len(written.split(" ")[-1])]
    for checked in session.checks_to_complete(cursor.path):
        root = checked.tree.root if isinstance(checked.tree, File) else None
        for element in elements(root):
            if local(element) in STATES:
                for _, name in words(element, "id"):
                    kind = lsp.CompletionItemKind.EnumMember
                    yield Offer(front + name, kind, local(element))
