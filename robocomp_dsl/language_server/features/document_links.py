"""Document links: the paths in a description file, in imports and elsewhere.

In: a file. Out: the span of each path in it, and its target file.
"""

from __future__ import annotations

from collections.abc import Iterator
from pathlib import Path

from lsprotocol import types as lsp

from robocomp_dsl.check.workspace.import_resolver import base_name
from robocomp_dsl.check.workspace.imports import locate_import
from robocomp_dsl.language_server.completion.complete_innermodel import FILES
from robocomp_dsl.language_server.completion.innermodel_reference import attributes_of
from robocomp_dsl.language_server.session import Session
from robocomp_dsl.language_server.symbols.symbols_innermodel import elements, unquoted_span
from robocomp_dsl.source import Span
from robocomp_dsl.syntax.ast import bdsl, cdsl, ddsl, idsl, innermodel
from robocomp_dsl.syntax.ast.base import Text


def document_links(session: Session, params: lsp.DocumentLinkParams) -> list[lsp.DocumentLink]:
    """The links in a file to existing files."""
    path = session.path_of(params.text_document.uri)
    session.source(params.text_document.uri)
    return [
        lsp.DocumentLink(session.positions.range_of(span), session.uri_of(target))
        for span, target in links_of(session, path)
    ]


def links_of(session: Session, path: Path) -> Iterator[tuple[Span, Path]]:
    """The span (without quotes) and the target of every path to an existing file."""
    tree = session.parsed(path).tree
    if isinstance(tree, idsl.File | cdsl.File | bdsl.File):
        for statement in tree.imports:
            imported = locate_import(statement, path, session.workspace.import_resolver)
            if imported:
                yield unquoted_span(statement.path), imported
    for relative in _relative_paths(tree):
        target = path.parent / relative.value
        if session.files.exists(target):
            yield unquoted_span(relative), target
    if isinstance(tree, innermodel.File):
        yield from _innermodel_links(session, tree, path)


def _innermodel_links(
    session: Session, tree: innermodel.File, path: Path
) -> Iterator[tuple[Span, Path]]:
    """Included files, meshes and images, at the path as written or beside the file."""
    for element in elements(tree.root):
        for name in FILES:
            attribute = element.get(name) if name in attributes_of(element.tag.text) else None
            if attribute is None:
                continue
            value = attribute.value.value
            for target in (path.parent / value, path.parent / base_name(value)):
                if value and session.files.exists(target):
                    yield unquoted_span(attribute.value), target
                    break


def _relative_paths(tree: object) -> Iterator[Text]:
    """The paths that are relative to the folder of the file."""
    match tree:
        case cdsl.File(component=cdsl.Component() as component):
            if component.parameters:
                yield component.parameters
            if component.statemachine:
                yield component.statemachine.path
        case ddsl.File():
            yield from (statement.path for statement in tree.imports)
            blocks: list[ddsl.Deployment | ddsl.Group] = [*tree.groups]
            blocks += [tree.deployment] if tree.deployment else []
            while blocks:
                block = blocks.pop()
                blocks.extend(block.groups)
                yield from (i.config for i in block.instances if i.config)
                yield from (m.file for wire in block.connections for m in wire.monitors)
