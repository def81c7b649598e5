"""The graph of `<include>` between InnerModel files.

In: a file. Out: the files that form one world with it. Files that include it are found only among
the open documents, because an XML file in a folder may be in another language.
"""

from __future__ import annotations

from pathlib import Path

from robocomp_dsl.check.innermodel.tags import INCLUDE
from robocomp_dsl.check.workspace.source_cache import canonical_path
from robocomp_dsl.language_server.features.document_links import links_of
from robocomp_dsl.language_server.session import Session
from robocomp_dsl.language_server.symbols.symbols_innermodel import elements
from robocomp_dsl.source import UnreadableSource
from robocomp_dsl.syntax.ast.innermodel import File


def connected_files(session: Session, path: Path) -> list[Path]:
    """`path` and the files that form one world with it."""
    paths = [document.path for document in session.documents.values()]
    files = included_files(session, path)
    key = canonical_path(path)
    for root in (path for path in paths if path.suffix.lower() == ".xml"):
        included = included_files(session, root)
        if key in included:
            files |= included
    return list(files.values())


def included_files(session: Session, path: Path) -> dict[str, Path]:
    """`path` and the files that it includes, directly or indirectly, by canonical path."""
    files: dict[str, Path] = {}
    todo = [path]
    while todo:
        file = todo.pop()
        if canonical_path(file) not in files:
            files[canonical_path(file)] = file
            todo += _direct_includes(session, file)
    return files


def _direct_includes(session: Session, path: Path) -> list[Path]:
    try:
        tree = session.parsed(path).tree
    except UnreadableSource:
        return []
    if not isinstance(tree, File):
        return []
    spans = {
        element.span.start: element.span
        for element in elements(tree.root)
        if element.tag.text.lower() == INCLUDE
    }
    return [
        target
        for span, target in links_of(session, path)
        if any(include.start <= span.start < include.end for include in spans.values())
    ]
