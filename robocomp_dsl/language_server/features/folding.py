"""Folding ranges: blocks, multi-line comments and groups of imports.

In: the text of a file. Out: ranges of lines. Files with syntax errors fold as well, because only
braces and comments matter.
"""

from __future__ import annotations

import re
from collections.abc import Iterable, Iterator

from lsprotocol import types as lsp

from robocomp_dsl.language_server.positions import PositionCodec
from robocomp_dsl.language_server.session import Session
from robocomp_dsl.language_server.symbols.symbols_innermodel import elements
from robocomp_dsl.source import Source, Span
from robocomp_dsl.syntax.ast.innermodel import File as XmlFile

_PART = re.compile(
    r"""(?P<comment>/\*.*?\*/|(?://[^\n]*\n[ \t]*)*//[^\n]*)|"[^"\n]*"|(?P<open>\{)|(?P<close>\})"""
    r"""|(?P<imports>^[ \t]*\#?import\b[^\n]*(?:\n\s*\#?import\b[^\n]*)*)""",
    re.DOTALL | re.MULTILINE | re.IGNORECASE,
)


def folding_ranges(session: Session, params: lsp.FoldingRangeParams) -> list[lsp.FoldingRange]:
    """The folding ranges of a file."""
    source = session.source(params.text_document.uri)
    tree = session.parsed(session.path_of(params.text_document.uri)).tree
    parts: Iterable[tuple[Span, lsp.FoldingRangeKind | None]] = _parts(source)
    if isinstance(tree, XmlFile):
        parts = ((element.span, None) for element in elements(tree.root))
    ranges = (_range(session.positions, span, kind) for span, kind in parts)
    return [folding for folding in ranges if folding]


def _parts(source: Source) -> Iterator[tuple[Span, lsp.FoldingRangeKind | None]]:
    opened: list[int] = []
    for match in _PART.finditer(source.text):
        if match["comment"]:
            yield source.span(*match.span()), lsp.FoldingRangeKind.Comment
        elif match["imports"]:
            yield source.span(*match.span()), lsp.FoldingRangeKind.Imports
        elif match["open"]:
            opened.append(match.start())
        elif match["close"] and opened:
            yield source.span(opened.pop(), match.start()), None


def _range(
    positions: PositionCodec, span: Span, kind: lsp.FoldingRangeKind | None
) -> lsp.FoldingRange | None:
    first = positions.position_at(span.source, span.start).line
    last = positions.position_at(span.source, span.end).line
    # The line of a closing brace stays visible.
    last -= kind is None
    return lsp.FoldingRange(first, last, kind=kind) if last > first else None
