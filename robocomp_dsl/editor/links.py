"""Document links: the files that a description names, by import or otherwise.

In: a file. Out: the place of each path in it, and the file that it leads to.
"""

from __future__ import annotations

from collections.abc import Iterator
from pathlib import Path

from lsprotocol import types as lsp

from robocomp_dsl.check.imports import locate
from robocomp_dsl.check.search import base_name
from robocomp_dsl.editor.complete_innermodel import FILES
from robocomp_dsl.editor.innermodel_words import attributes_of
from robocomp_dsl.editor.names_innermodel import elements, inside_quotes
from robocomp_dsl.editor.positions import range_of
from robocomp_dsl.editor.session import Session
from robocomp_dsl.source import Span
from robocomp_dsl.syntax import ast_cdsl, ast_ddsl, ast_idsl, ast_innermodel
from robocomp_dsl.syntax.ast_base import Text


def document_links(session: Session, params: lsp.DocumentLinkParams) -> list[lsp.DocumentLink]:
    """The paths in a file that lead somewhere."""
    path = session.path_of(params.text_document.uri)
    session.source(params.text_document.uri)
    return [
        lsp.DocumentLink(range_of(span), session.uri_of(target))
        for span, target in links_of(session, path)
    ]


def links_of(session: Session, path: Path) -> Iterator[tuple[Span, Path]]:
    """The span between the quotes of every path that leads to a file, and that file."""
    tree = session.parsed(path).tree
    if isinstance(tree, ast_idsl.File | ast_cdsl.File):
        for one in tree.imports:
            found = locate(one, path, session.workspace.search)
            if found:
                yield inside_quotes(one.path), found
    for written in _beside(tree):
        target = path.parent / written.value
        if session.files.exists(target):
            yield inside_quotes(written), target
    if isinstance(tree, ast_innermodel.File):
        yield from _in_body(session, tree, path)


def _in_body(
    session: Session, tree: ast_innermodel.File, path: Path
) -> Iterator[tuple[Span, Path]]:
    """Included files, meshes and images: as written, or by their last part beside the file."""
    for element in elements(tree.root):
        for name in FILES:
            said = element.get(name) if name in attributes_of(element.tag.text) else None
            if said is None:
                continue
            written = said.value.value
            for target in (path.parent / written, path.parent / base_name(written)):
                if written and session.files.exists(target):
                    yield inside_quotes(said.value), target
                    break


def _beside(tree: object) -> Iterator[Text]:
    """Paths that are relative to the file that they stand in."""
    match tree:
        case ast_cdsl.File(component=ast_cdsl.Component() as component):
            if component.parameters:
                yield component.parameters
            if component.statemachine:
                yield component.statemachine.path
        case ast_ddsl.File(deployment=ast_ddsl.Deployment() as deployment):
            yield from (one.path for one in tree.imports)
            yield from (one.config for one in deployment.instances if one.config)
