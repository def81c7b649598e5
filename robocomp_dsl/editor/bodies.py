"""Which InnerModel files make up one body: those that include a file, and those that these include.

In: a file. Out: files. Of files that are not open only included ones are known, since any XML file
in a folder may be something else.
"""

from __future__ import annotations

from pathlib import Path

from robocomp_dsl.check.files import identity
from robocomp_dsl.check.innermodel_tags import INCLUDE
from robocomp_dsl.editor.links import links_of
from robocomp_dsl.editor.names_innermodel import elements
from robocomp_dsl.editor.session import Session
from robocomp_dsl.source import UnreadableSource
from robocomp_dsl.syntax.ast_innermodel import File


def related_files(session: Session, path: Path) -> list[Path]:
    """`path` and the files that are in a body with it."""
    roots = [one.path for one in session.documents.values() if one.path.suffix.lower() == ".xml"]
    found = included(session, path)
    key = identity(path)
    for root in roots:
        below = included(session, root)
        if key in below:
            found |= below
    return list(found.values())


def included(session: Session, path: Path) -> dict[str, Path]:
    """`path` and all that it includes, directly or not, by their identities."""
    found: dict[str, Path] = {}
    todo = [path]
    while todo:
        one = todo.pop()
        if identity(one) not in found:
            found[identity(one)] = one
            todo += _included_by(session, one)
    return found


def _included_by(session: Session, path: Path) -> list[Path]:
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
        if any(one.start <= span.start < one.end for one in spans.values())
    ]
