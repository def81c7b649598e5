"""Inlay hints: what was not written but follows.

In: a range of a file. Out: the pattern of operations without a mark, and to which component a
requirement is wired where no `connect` says it.
"""

from __future__ import annotations

from collections.abc import Iterator

from lsprotocol import types as lsp

from robocomp_dsl.editor.positions import position_at, span_of
from robocomp_dsl.editor.session import Session
from robocomp_dsl.editor.shapes import pattern_words
from robocomp_dsl.model.deployment import Connection, Deployment
from robocomp_dsl.model.interface import Operation
from robocomp_dsl.source import Span
from robocomp_dsl.syntax import ast_idsl


def inlay_hints(session: Session, params: lsp.InlayHintParams) -> list[lsp.InlayHint]:
    """The hints in the range. Raises `NoDescription` and `WrongPosition`."""
    asked = span_of(session.source(params.text_document.uri), params.range)
    path = session.path_of(params.text_document.uri)
    hints: list[tuple[int, lsp.InlayHint]] = []
    tree = session.parsed(path).tree
    if isinstance(tree, ast_idsl.File):
        things = {one.symbol.span.start: one.symbol.thing for one in session.index(path).mentions}
        hints = list(_patterns(tree, things))
    else:
        model = session.checked(path).model
        if isinstance(model, Deployment):
            hints = list(_wires(model))
    return [hint for offset, hint in hints if asked.start <= offset <= asked.end]


def _patterns(
    tree: ast_idsl.File, things: dict[int, object]
) -> Iterator[tuple[int, lsp.InlayHint]]:
    for module in tree.modules:
        for one in module.declarations:
            if isinstance(one, ast_idsl.Interface):
                for operation in one.operations:
                    made = things.get(operation.name.span.start)
                    if isinstance(made, Operation) and not made.marked:
                        tip = "the pattern that follows from the result and the parameters"
                        place = operation.span
                        hint = _hint(place, place.start, f"[{pattern_words(made)}]", tip)
                        hint.padding_right = True
                        yield place.start, hint


def _wires(model: Deployment) -> Iterator[tuple[int, lsp.InlayHint]]:
    by_source: dict[int, list[Connection]] = {}
    for one in model.connections:
        if one.implied:
            by_source.setdefault(one.source.span.start, []).append(one)
    for wires in by_source.values():
        span = wires[0].source.span
        ends = (f"{w.source_port.name} → {w.target.name}.{w.target_port.name}" for w in wires)
        hint = _hint(span, span.end, ", ".join(ends), "wired without a `connect`")
        hint.padding_left = True
        yield span.end, hint


def _hint(span: Span, offset: int, label: str, tip: str) -> lsp.InlayHint:
    return lsp.InlayHint(position_at(span.source, offset), label, tooltip=tip)
