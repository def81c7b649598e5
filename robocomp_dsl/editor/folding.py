"""Folding: blocks, comments of several lines, rows of imports.

In: the characters of a file. Out: ranges of lines. A half-typed file folds, too: only braces and
comments count.
"""

from __future__ import annotations

import re
from collections.abc import Iterable, Iterator

from lsprotocol import types as lsp

from robocomp_dsl.editor.names_innermodel import elements
from robocomp_dsl.editor.positions import position_at
from robocomp_dsl.editor.session import Session
from robocomp_dsl.source import Source, Span
from robocomp_dsl.syntax.ast_innermodel import Element
from robocomp_dsl.syntax.ast_innermodel import File as XmlFile

_PART = re.compile(
    r"""(?P<comment>/\*.*?\*/|(?://[^\n]*\n[ \t]*)*//[^\n]*)|"[^"\n]*"|(?P<open>\{)|(?P<close>\})"""
    r"""|(?P<imports>^[ \t]*\#?import\b[^\n]*(?:\n\s*\#?import\b[^\n]*)*)""",
    re.DOTALL | re.MULTILINE | re.IGNORECASE,
)


def folding_ranges(session: Session, params: lsp.FoldingRangeParams) -> list[lsp.FoldingRange]:
    """What can be folded in a file."""
    source = session.source(params.text_document.uri)
    tree = session.parsed(session.path_of(params.text_document.uri)).tree
    found: Iterable[tuple[Span, lsp.FoldingRangeKind | None]] = _parts(source)
    if isinstance(tree, XmlFile):
        found = ((span, None) for span in (_elements(tree.root) if tree.root else ()))
    return [made for span, kind in found if (made := _range(span, kind))]


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


def _elements(root: Element) -> Iterator[Span]:
    return (one.span for one in elements(root))


def _range(span: Span, kind: lsp.FoldingRangeKind | None) -> lsp.FoldingRange | None:
    first = position_at(span.source, span.start).line
    last = position_at(span.source, span.end).line
    # The line of a closing brace stays to be seen.
    last -= kind is None
    return lsp.FoldingRange(first, last, kind=kind) if last > first else None
