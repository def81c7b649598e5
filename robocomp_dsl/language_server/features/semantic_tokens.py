"""Semantic tokens: the kinds of names, which the editor's grammar cannot determine.

In: the index of a file. Out: the five numbers of the protocol for every occurrence.
"""

from __future__ import annotations

from collections.abc import Sequence

from lsprotocol import types as lsp

from robocomp_dsl.language_server.positions import PositionCodec
from robocomp_dsl.language_server.session import Session
from robocomp_dsl.language_server.symbols.symbol import Occurrence

TYPES = {
    "module": "namespace",
    "struct": "struct",
    "exception": "struct",
    "enum": "enum",
    "enumerator": "enumMember",
    "sequence": "type",
    "dictionary": "type",
    "typedef": "type",
    "interface": "interface",
    "operation": "method",
    "field": "property",
    "constant": "enumMember",
    "parameter": "parameter",
    "component": "class",
    "parameters": "class",
    "port": "property",
    "deployment": "class",
    "group": "namespace",
    "instance": "variable",
    "host": "variable",
    "label": "enumMember",
    "statemachine": "class",
    "state": "enumMember",
    "event": "event",
    "node": "variable",
    "bridge": "class",
    "input": "variable",
    "hub": "variable",
    "function": "function",
    "output": "property",
    "service": "method",
    "action": "method",
    "call": "variable",
}
"""Kind of symbol to the token type of the protocol."""

_NAMES = list(dict.fromkeys(TYPES.values()))
LEGEND = lsp.SemanticTokensLegend(_NAMES, ["declaration"])


def semantic_tokens(session: Session, params: lsp.SemanticTokensParams) -> lsp.SemanticTokens:
    """The tokens of a whole file."""
    session.source(params.text_document.uri)
    index = session.index(session.path_of(params.text_document.uri))
    return _tokens(index.occurrences, session.positions)


def tokens_in_range(session: Session, params: lsp.SemanticTokensRangeParams) -> lsp.SemanticTokens:
    """The tokens of a part of a file. Raises `UnsupportedDocument` and `InvalidPosition`."""
    requested = session.positions.span_of(session.source(params.text_document.uri), params.range)
    occurrences = session.index(session.path_of(params.text_document.uri)).occurrences
    selected = [
        o for o in occurrences if o.span.start <= requested.end and requested.start <= o.span.end
    ]
    return _tokens(selected, session.positions)


def _tokens(occurrences: Sequence[Occurrence], positions: PositionCodec) -> lsp.SemanticTokens:
    """Five numbers for each occurrence, relative to the previous one."""
    data: list[int] = []
    line = column = 0
    # If a name has two occurrences, the declaring one counts.
    unique = {o.span.start: o for o in sorted(occurrences, key=_order)}
    for occurrence in unique.values():
        start = positions.position_at(occurrence.span.source, occurrence.span.start)
        column = start.character - column if start.line == line else start.character
        kind = _NAMES.index(TYPES[occurrence.symbol.kind])
        length = positions.length_of(occurrence.span)
        data += [start.line - line, column, length, kind, int(occurrence.declares)]
        line, column = start.line, start.character
    return lsp.SemanticTokens(data)


def _order(occurrence: Occurrence) -> tuple[int, bool]:
    return occurrence.span.start, occurrence.declares
