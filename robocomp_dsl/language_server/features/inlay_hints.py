"""Inlay hints: inferred patterns, implicit connections and unit conversions.

In: a range of a file. Out: the pattern of each operation without an explicit one, the target of
each required port that has no `connect` statement, and the factor of each unit conversion.
"""

from __future__ import annotations

from collections.abc import Iterator

from lsprotocol import types as lsp

from robocomp_dsl.language_server.features.conversions import conversion_hints
from robocomp_dsl.language_server.positions import PositionCodec
from robocomp_dsl.language_server.session import Session
from robocomp_dsl.language_server.signatures.signatures_idsl import format_pattern
from robocomp_dsl.model.bridge import Bridge
from robocomp_dsl.model.deployment import Connection, Deployment
from robocomp_dsl.model.interface import Operation
from robocomp_dsl.syntax.ast import idsl


def inlay_hints(session: Session, params: lsp.InlayHintParams) -> list[lsp.InlayHint]:
    """The hints in the range. Raises `UnsupportedDocument` and `InvalidPosition`."""
    requested = session.positions.span_of(session.source(params.text_document.uri), params.range)
    path = session.path_of(params.text_document.uri)
    hints: list[tuple[int, lsp.InlayHint]] = []
    tree = session.parsed(path).tree
    if isinstance(tree, idsl.File):
        symbols = [occurrence.symbol for occurrence in session.index(path).occurrences]
        objects = {symbol.span.start: symbol.model_object for symbol in symbols}
        hints = list(_pattern_hints(tree, objects, session.positions))
    else:
        model = session.checked(path).model
        if isinstance(model, Deployment):
            hints = list(_connection_hints(model, session.positions))
        elif isinstance(model, Bridge):
            hints = list(conversion_hints(model, session.positions))
    return [hint for offset, hint in hints if requested.start <= offset <= requested.end]


def _pattern_hints(
    tree: idsl.File, objects: dict[int, object], positions: PositionCodec
) -> Iterator[tuple[int, lsp.InlayHint]]:
    declarations = [d for module in tree.modules for d in module.declarations]
    interfaces = [d for d in declarations if isinstance(d, idsl.Interface)]
    for statement in (statement for each in interfaces for statement in each.operations):
        operation = objects.get(statement.name.span.start)
        if isinstance(operation, Operation) and not operation.marked:
            span = statement.span
            position = positions.position_at(span.source, span.start)
            tip = "the pattern follows from the result and the parameters"
            label = f"[{format_pattern(operation)}]"
            yield span.start, lsp.InlayHint(position, label, tooltip=tip, padding_right=True)


def _connection_hints(
    model: Deployment, positions: PositionCodec
) -> Iterator[tuple[int, lsp.InlayHint]]:
    by_source: dict[int, list[Connection]] = {}
    for connection in model.connections:
        if connection.implied:
            by_source.setdefault(connection.source.span.start, []).append(connection)
    for connections in by_source.values():
        span = connections[0].source.span
        ends = (f"{c.source_port.name} → {c.target.name}.{c.target_port.name}" for c in connections)
        position = positions.position_at(span.source, span.end)
        tip = "implicit connection, without `connect`"
        yield span.end, lsp.InlayHint(position, ", ".join(ends), tooltip=tip, padding_left=True)
