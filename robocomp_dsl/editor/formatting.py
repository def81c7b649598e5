"""Formatting: what `rcgen fmt` would do, as the small edits that do it.

In: a file, or a range of it. Out: edits of blanks; everything else stays where it is for the
editor, and with it cursors, marks and folds. A file with errors of form gets none.
"""

from __future__ import annotations

from lsprotocol import types as lsp
from pygls.exceptions import JsonRpcException

from robocomp_dsl.editor.positions import range_of, span_of
from robocomp_dsl.editor.session import NoDescription, Session
from robocomp_dsl.format import CannotFormat, changes, formatted
from robocomp_dsl.source import Source, UnreadableSource


def formatting(session: Session, params: lsp.DocumentFormattingParams) -> list[lsp.TextEdit]:
    """The edits for a whole file. Raises `NoDescription`."""
    source = session.source(params.text_document.uri)
    return _edits(session, source, 0, len(source.text))


def range_formatting(
    session: Session, params: lsp.DocumentRangeFormattingParams
) -> list[lsp.TextEdit]:
    """The edits for the lines that a range is in. Raises `NoDescription` and `WrongPosition`."""
    source = session.source(params.text_document.uri)
    asked = span_of(source, params.range)
    first = source.text.rfind("\n", 0, asked.start) + 1
    # A selection that ends at the beginning of a line has nothing of that line.
    last = source.text.find("\n", max(asked.start, asked.end - 1))
    return _edits(session, source, first, last if last >= 0 else len(source.text))


def _edits(session: Session, source: Source, first: int, last: int) -> list[lsp.TextEdit]:
    """The edits that touch the characters [first, last]."""
    try:
        new = formatted(source, session.parsed(source.path).findings)
    except UnreadableSource as error:
        raise NoDescription(f"cannot read `{source.path}`: {error}") from None
    except CannotFormat as error:
        said = f"`{source.path.name}` stays as it is: {error}"
        raise JsonRpcException(said, lsp.LSPErrorCodes.RequestFailed) from None
    if new is None or new == source.text:
        return []
    return [
        lsp.TextEdit(range_of(source.span(start, end)), text)
        for start, end, text in changes(source, new)
        if start <= last and first <= end
    ]
