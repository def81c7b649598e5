"""Formatting: the changes of `rcgen fmt` as minimal edits.

In: a file, or a range of it. Out: edits of whitespace, so that the editor keeps cursors, marks and
folds. A file with syntax errors gets no edits.
"""

from __future__ import annotations

from lsprotocol import types as lsp
from pygls.exceptions import JsonRpcException

from robocomp_dsl.format.formatter import PARSERS, CannotFormat, changes, format_source
from robocomp_dsl.language_server.session import Session, UnsupportedDocument
from robocomp_dsl.source import Source, UnreadableSource


def formatting(session: Session, params: lsp.DocumentFormattingParams) -> list[lsp.TextEdit]:
    """The edits for a whole file. Raises `UnsupportedDocument`."""
    source = session.source(params.text_document.uri)
    return _edits(session, source, 0, len(source.text))


def range_formatting(
    session: Session, params: lsp.DocumentRangeFormattingParams
) -> list[lsp.TextEdit]:
    """The edits for the lines of a range. Raises `UnsupportedDocument` and `InvalidPosition`."""
    source = session.source(params.text_document.uri)
    requested = session.positions.span_of(source, params.range)
    first = source.text.rfind("\n", 0, requested.start) + 1
    # A selection that ends at the start of a line does not include that line.
    last = source.text.find("\n", max(requested.start, requested.end - 1))
    return _edits(session, source, first, last if last >= 0 else len(source.text))


def _edits(session: Session, source: Source, first: int, last: int) -> list[lsp.TextEdit]:
    """The edits that touch the characters [first, last]; none for a definition of ROS or YARP."""
    if source.path.suffix.lower() not in PARSERS:
        return []
    try:
        new = format_source(source, session.parsed(source.path).diagnostics)
    except UnreadableSource as error:
        raise UnsupportedDocument(f"cannot read `{source.path}`: {error}") from None
    except CannotFormat as error:
        message = f"`{source.path.name}` is not formatted: {error}"
        raise JsonRpcException(message, lsp.LSPErrorCodes.RequestFailed) from None
    if new is None or new == source.text:
        return []
    return [
        lsp.TextEdit(session.positions.range_of(source.span(start, end)), text)
        for start, end, text in changes(source, new)
        if start <= last and first <= end
    ]
