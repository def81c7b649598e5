"""Files that can be named between quotes: imports, parameters, state machines, configurations."""

from __future__ import annotations

import os
from collections.abc import Iterator

from lsprotocol import types as lsp

from robocomp_dsl.editor.cursor import Cursor
from robocomp_dsl.editor.offer import Offer
from robocomp_dsl.editor.session import Session

BESIDE = {
    "PARAMETERS": (".pdsl",),
    "STATEMACHINE": (".smdsl", ".scxml"),
    "CONFIG": (".yaml", ".yml", ".toml"),
}
"""Keyword in front of the quotes to suffixes of the files it wants."""


def paths(session: Session, cursor: Cursor) -> Iterator[Offer]:
    """The files that fit, as they are to be written."""
    if cursor.last == "IMPORT":
        found = _imports(session, cursor)
    else:
        found = _beside(session, cursor, BESIDE.get(cursor.last, ()))
    for path in found:
        yield Offer(path, lsp.CompletionItemKind.File)


def _imports(session: Session, cursor: Cursor) -> Iterator[str]:
    if cursor.path.suffix.lower() != ".ddsl":
        known = session.workspace.search.known(cursor.path)
        yield from (name for name in known if name != cursor.path.name)
        return
    yield from _beside(session, cursor, (".cdsl",))
    for path in session.every_file():
        if path.suffix.lower() == ".cdsl":
            yield os.path.relpath(path, cursor.path.parent).replace(os.sep, "/")


def _beside(session: Session, cursor: Cursor, suffixes: tuple[str, ...]) -> Iterator[str]:
    """Files in the folder of the file and in its `etc`."""
    for below in ("", "etc"):
        for name in session.files.names_in(cursor.path.parent / below):
            if name.lower().endswith(suffixes) and suffixes:
                yield f"{below}/{name}".lstrip("/")
