"""What an InnerModel text can have at a place: tags, attributes, values, ends of tags."""

from __future__ import annotations

import os
import re
from collections.abc import Iterator
from pathlib import Path

from lsprotocol import types as lsp

from robocomp_dsl.check.innermodel_tags import FLAG, UNITS
from robocomp_dsl.editor import complete_xml
from robocomp_dsl.editor import innermodel_words as known
from robocomp_dsl.editor.offer import Offer, words
from robocomp_dsl.editor.session import Session
from robocomp_dsl.editor.xml_cursor import XmlCursor

ROOT = "innerModel"
FILES = {
    "path": (".xml",),
    "file": (".3ds", ".dae", ".ive", ".obj", ".osg", ".osgt", ".ply", ".stl", ".txt", ".ini"),
    "texture": (".bmp", ".jpeg", ".jpg", ".png", ".ppm", ".tga"),
}
"""Attributes that name files, and what these end in."""
_NUMBER = re.compile(r"[+-]?(?:\d+\.?\d*|\.\d+)\s*")


def offers(session: Session, cursor: XmlCursor) -> Iterator[Offer]:
    """Everything that fits."""
    return complete_xml.offers(
        cursor,
        lambda before: _tags(cursor, before),
        lambda: _attributes(cursor),
        lambda: _values(session, cursor),
    )


def _tags(cursor: XmlCursor, before: str) -> Iterator[Offer]:
    names = known.tags_in(cursor.around[-1]) if cursor.around else (ROOT,)
    for name in names:
        kind, about = lsp.CompletionItemKind.Class, known.about_tag(name)
        yield Offer(before + name, kind, about.split("\n", 1)[0], about=about)


def _attributes(cursor: XmlCursor) -> Iterator[Offer]:
    for name, kind in known.attributes_of(cursor.tag).items():
        if name not in cursor.written:
            about = known.about_attribute(cursor.tag, name)
            detail = known.kind_words(kind)
            yield Offer(name, lsp.CompletionItemKind.Property, detail, about=about)


def _values(session: Session, cursor: XmlCursor) -> Iterator[Offer]:
    kind = known.attributes_of(cursor.tag).get(cursor.attribute)
    if kind is None:
        return
    written = cursor.source.text[cursor.start : cursor.offset]
    number = _NUMBER.fullmatch(written)
    if isinstance(kind, tuple):
        yield from words(*kind)
    elif kind == FLAG:
        yield from words("0", "1")
    elif cursor.attribute in FILES:
        yield from _files(session, cursor.path.parent, written, FILES[cursor.attribute])
    elif kind in UNITS and number:
        yield from words(*(f"{written.strip()} {unit}" for unit in UNITS[kind]))
    else:
        default = known.default_of(cursor.tag, cursor.attribute)
        yield from words(*([default] if default else []))
        if "`inf`" in kind:
            yield from words("inf", "-inf")


def _files(
    session: Session, home: Path, written: str, suffixes: tuple[str, ...]
) -> Iterator[Offer]:
    """Files that fit and folders, below the folder that is written already."""
    below = written.rpartition("/")[0]
    folder = home / below
    front = f"{below}/" if below or written.startswith("/") else ""
    for name in session.files.names_in(folder):
        if name.lower().endswith(suffixes):
            yield Offer(front + name, lsp.CompletionItemKind.File)
    for name in _folders(folder):
        yield Offer(f"{front}{name}/", lsp.CompletionItemKind.Folder)


def _folders(folder: Path) -> list[str]:
    try:
        found = [one.name for one in os.scandir(folder) if one.is_dir()]
    except (OSError, ValueError):
        return []
    return sorted(name for name in found if not name.startswith("."))
