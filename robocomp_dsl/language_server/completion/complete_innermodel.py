"""Completion of InnerModel files: tags, attributes and values."""

from __future__ import annotations

import os
import re
from collections.abc import Iterator
from pathlib import Path

from lsprotocol import types as lsp

from robocomp_dsl.check.innermodel.tags import FLAG, UNITS
from robocomp_dsl.language_server.completion import complete_xml
from robocomp_dsl.language_server.completion import innermodel_reference as known
from robocomp_dsl.language_server.completion.candidates import CompletionCandidate, value_candidates
from robocomp_dsl.language_server.completion.xml_context import XmlContext
from robocomp_dsl.language_server.session import Session

ROOT = "innerModel"
FILES = {
    "path": (".xml",),
    "file": (".3ds", ".dae", ".ive", ".obj", ".osg", ".osgt", ".ply", ".stl", ".txt", ".ini"),
    "texture": (".bmp", ".jpeg", ".jpg", ".png", ".ppm", ".tga"),
}
"""Attribute that names a file to the suffixes of such files."""
_NUMBER = re.compile(r"[+-]?(?:\d+\.?\d*|\.\d+)\s*")


def candidates(session: Session, context: XmlContext) -> Iterator[CompletionCandidate]:
    """All candidates for the position."""
    return complete_xml.candidates(
        context,
        lambda before: _tags(context, before),
        lambda: _attributes(context),
        lambda: _values(session, context),
    )


def _tags(context: XmlContext, before: str) -> Iterator[CompletionCandidate]:
    names = known.allowed_tags(context.open_tags[-1]) if context.open_tags else (ROOT,)
    for name in names:
        kind, description = lsp.CompletionItemKind.Class, known.describe_tag(name)
        yield CompletionCandidate(
            before + name, kind, description.split("\n", 1)[0], documentation=description
        )


def _attributes(context: XmlContext) -> Iterator[CompletionCandidate]:
    for name, kind in known.attributes_of(context.tag).items():
        if name not in context.existing_attributes:
            description = known.describe_attribute(context.tag, name)
            detail = known.describe_kind(kind)
            yield CompletionCandidate(
                name, lsp.CompletionItemKind.Property, detail, documentation=description
            )


def _values(session: Session, context: XmlContext) -> Iterator[CompletionCandidate]:
    kind = known.attributes_of(context.tag).get(context.attribute)
    if kind is None:
        return
    prefix = context.source.text[context.start : context.offset]
    number = _NUMBER.fullmatch(prefix)
    if isinstance(kind, tuple):
        yield from value_candidates(*kind)
    elif kind == FLAG:
        yield from value_candidates("0", "1")
    elif context.attribute in FILES:
        yield from _files(session, context.path.parent, prefix, FILES[context.attribute])
    elif kind in UNITS and number:
        yield from value_candidates(*(f"{prefix.strip()} {unit}" for unit in UNITS[kind]))
    else:
        default = known.default_of(context.tag, context.attribute)
        yield from value_candidates(*([default] if default else []))
        if "`inf`" in kind:
            yield from value_candidates("inf", "-inf")


def _files(
    session: Session, home: Path, prefix: str, suffixes: tuple[str, ...]
) -> Iterator[CompletionCandidate]:
    """The files with one of the suffixes, and the folders, in the folder that `prefix` names."""
    parent = prefix.rpartition("/")[0]
    folder = home / parent
    start = f"{parent}/" if parent or prefix.startswith("/") else ""
    for name in session.files.names_in(folder):
        if name.lower().endswith(suffixes):
            yield CompletionCandidate(start + name, lsp.CompletionItemKind.File)
    for name in _folders(folder):
        yield CompletionCandidate(f"{start}{name}/", lsp.CompletionItemKind.Folder)


def _folders(folder: Path) -> list[str]:
    try:
        names = [entry.name for entry in os.scandir(folder) if entry.is_dir()]
    except (OSError, ValueError):
        return []
    return sorted(name for name in names if not name.startswith("."))
