"""Semantic tokens: the colours of names, which a grammar of regular expressions cannot know.

In: the index of a file. Out: the protocol's five numbers for every name.
"""

from __future__ import annotations

from collections.abc import Sequence

from lsprotocol import types as lsp

from robocomp_dsl.editor.index import Mention
from robocomp_dsl.editor.positions import length_of, position_at, span_of
from robocomp_dsl.editor.session import Session

TYPES = {
    "module": "namespace",
    "struct": "struct",
    "exception": "struct",
    "enum": "enum",
    "enumerator": "enumMember",
    "sequence": "type",
    "dictionary": "type",
    "interface": "interface",
    "operation": "method",
    "field": "property",
    "parameter": "parameter",
    "component": "class",
    "parameters": "class",
    "port": "property",
    "deployment": "class",
    "group": "namespace",
    "instance": "variable",
    "host": "variable",
    "statemachine": "class",
    "state": "enumMember",
    "event": "event",
    "node": "variable",
}
"""Kinds of symbols to the names that editors have colours for."""

_NAMES = list(dict.fromkeys(TYPES.values()))
LEGEND = lsp.SemanticTokensLegend(_NAMES, ["declaration"])


def semantic_tokens(session: Session, params: lsp.SemanticTokensParams) -> lsp.SemanticTokens:
    """The names of a whole file."""
    session.source(params.text_document.uri)
    return _tokens(session.index(session.path_of(params.text_document.uri)).mentions)


def tokens_in_range(session: Session, params: lsp.SemanticTokensRangeParams) -> lsp.SemanticTokens:
    """The names of a part of a file. Raises `NoDescription` and `WrongPosition`."""
    asked = span_of(session.source(params.text_document.uri), params.range)
    mentions = session.index(session.path_of(params.text_document.uri)).mentions
    return _tokens([m for m in mentions if m.span.start <= asked.end and asked.start <= m.span.end])


def _tokens(mentions: Sequence[Mention]) -> lsp.SemanticTokens:
    """The protocol's five numbers for each, relative to the one before."""
    data: list[int] = []
    line = column = 0
    # Of two meanings of one word the declared one counts.
    for one in {m.span.start: m for m in sorted(mentions, key=_order)}.values():
        at = position_at(one.span.source, one.span.start)
        column = at.character - column if at.line == line else at.character
        kind = _NAMES.index(TYPES[one.symbol.kind])
        data += [at.line - line, column, length_of(one.span), kind, int(one.declares)]
        line, column = at.line, at.character
    return lsp.SemanticTokens(data)


def _order(one: Mention) -> tuple[int, bool]:
    return one.span.start, one.declares
