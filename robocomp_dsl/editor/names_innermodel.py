"""The names in an InnerModel file: the ids of its nodes."""

from __future__ import annotations

from collections.abc import Iterator
from pathlib import Path

from robocomp_dsl.check import check_innermodel
from robocomp_dsl.check.innermodel_tags import TAGS
from robocomp_dsl.check.workspace import Workspace
from robocomp_dsl.diagnostics import Report
from robocomp_dsl.editor.index import Mention, Symbol
from robocomp_dsl.model.body import Body, Node
from robocomp_dsl.source import Source, Span
from robocomp_dsl.syntax import parse_innermodel
from robocomp_dsl.syntax.ast_base import Text
from robocomp_dsl.syntax.ast_innermodel import Element


def read(path: Path, workspace: Workspace) -> tuple[Source, bool, list[Mention]]:
    """The names in the file at `path`. Raises `UnreadableSource`."""
    file = workspace.files.parse(path, parse_innermodel)
    body = check_innermodel(path, workspace, Report())
    nodes = _nodes(body, file.source) if body else {}
    mentions = [
        Mention(made.span, made, declares=True)
        for made in symbols(file.tree.root, nodes, path.stem)
    ]
    return file.source, file.tree.complete, mentions


def symbols(root: Element | None, nodes: dict[int, Node], container: str) -> Iterator[Symbol]:
    """A symbol for every id, with its node where `nodes` has it by the offset of its tag."""
    for element in elements(root):
        own = element.get("id")
        if own and own.value.value and element.tag.text.lower() in TAGS:
            node = nodes.get(element.span.start)
            yield Symbol(own.value.value, "node", inside_quotes(own.value), node, container)


def elements(root: Element | None) -> Iterator[Element]:
    """`root` and everything in it, in order of writing."""
    todo = [root] if root else []
    while todo:
        one = todo.pop()
        yield one
        todo.extend(reversed(one.children))


def inside_quotes(written: Text) -> Span:
    """The characters of a text without its quotes."""
    span = written.span
    quoted = len(span.text) >= 2 and span.text[0] in "\"'" and span.text[-1] == span.text[0]
    return span.source.span(span.start + 1, span.end - 1) if quoted else span


def _nodes(body: Body, source: Source) -> dict[int, Node]:
    return {node.span.start: node for node, _ in body.nodes() if node.span.source is source}
