"""Names that a PDSL file can use at a place."""

from __future__ import annotations

from collections.abc import Iterator

from robocomp_dsl.editor.cursor import Cursor
from robocomp_dsl.editor.offer import Offer, words
from robocomp_dsl.editor.session import Session


def names(session: Session, cursor: Cursor) -> Iterator[Offer]:  # noqa: ARG001 - as of all languages
    """The values of a truth value; all other names here are the user's own."""
    if cursor.last == "BOOL_TYPE":
        yield from words("true", "false")
