"""Indexer of InnerModel files: the ids of the nodes."""

from __future__ import annotations

from collections.abc import Iterator
from pathlib import Path

from robocomp_dsl.check.innermodel.tags import TAGS
from robocomp_dsl.check.passes import check_innermodel
from robocomp_dsl.check.workspace.workspace import Workspace
from robocomp_dsl.diagnostics import Report
from robocomp_dsl.language_server.symbols.symbol import Occurrence, Symbol
from robocomp_dsl.model.innermodel import InnerModel, Node
from robocomp_dsl.source import Source, Span
from robocomp_dsl.syntax.ast.base import Text
from robocomp_dsl.syntax.ast.innermodel import Element
from robocomp_dsl.syntax.parse import parse_innermodel


def index_file(path: Path, workspace: Workspace) -> tuple[Source, bool, list[Occurrence]]:
    """The occurrences in the file at `path`. Raises `UnreadableSource`."""
    file = workspace.sources.parse(path, parse_innermodel)
    body = check_innermodel(path, workspace, Report())
    nodes = _nodes(body, file.source) if body else {}
    occurrences = [
        Occurrence(symbol.span, symbol, declares=True)
        for symbol in node_symbols(file.tree.root, nodes, path.stem)
    ]
    return file.source, file.tree.complete, occurrences


def node_symbols(root: Element | None, nodes: dict[int, Node], container: str) -> Iterator[Symbol]:
    """A symbol for every id; `nodes` has the nodes of the model by the offset of their tags."""
    for element in elements(root):
        own = element.get("id")
        if own and own.value.value and element.tag.text.lower() in TAGS:
            node = nodes.get(element.span.start)
            yield Symbol(own.value.value, "node", unquoted_span(own.value), node, container)


def elements(root: Element | None) -> Iterator[Element]:
    """`root` and all its descendants, in source order."""
    todo = [root] if root else []
    while todo:
        element = todo.pop()
        yield element
        todo.extend(reversed(element.children))


def unquoted_span(written: Text) -> Span:
    """The span of a string without its quotes."""
    span = written.span
    quoted = len(span.text) >= 2 and span.text[0] in "\"'" and span.text[-1] == span.text[0]
    return span.source.span(span.start + 1, span.end - 1) if quoted else span


def _nodes(body: InnerModel, source: Source) -> dict[int, Node]:
    return {node.span.start: node for node, _ in body.nodes() if node.span.source is source}
