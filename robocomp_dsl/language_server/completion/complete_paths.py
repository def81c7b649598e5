"""Completion of paths in strings: imports, parameters, state machines and configurations."""

from __future__ import annotations

import os
from collections.abc import Iterator

from lsprotocol import types as lsp

from robocomp_dsl.check.workspace.yarp_definitions import declares_types_only
from robocomp_dsl.language_server.completion.candidates import CompletionCandidate
from robocomp_dsl.language_server.completion.context import CompletionContext
from robocomp_dsl.language_server.session import Session

SUFFIXES = {
    "PARAMETERS": (".pdsl",),
    "STATEMACHINE": (".smdsl", ".scxml"),
    "MONITOR": (".py",),
    "CONFIG": (".yaml", ".yml", ".toml"),
}
"""Keyword before the string to the suffixes of the files that it accepts."""
IMPORTED_BY_DDSL = (".cdsl", ".ddsl")


def candidates(session: Session, context: CompletionContext) -> Iterator[CompletionCandidate]:
    """The paths of the accepted files, as they are written in the file."""
    if context.previous_kind == "IMPORT":
        paths = _imports(session, context)
    elif context.statement and context.statement[0].kind == "FILES":
        paths = _entries_around(context)
    else:
        paths = _files_in_folder(session, context, SUFFIXES.get(context.previous_kind, ()))
    for path in paths:
        yield CompletionCandidate(path, lsp.CompletionItemKind.File)


def _imports(session: Session, context: CompletionContext) -> Iterator[str]:
    if context.path.suffix.lower() != ".ddsl":
        known = session.workspace.import_resolver.importable_files(context.path)
        yield from (name for name in known if name != context.path.name)
        resolver = session.workspace.import_resolver
        is_component = context.path.suffix.lower() == ".cdsl"
        if not is_component:
            yield from resolver.ros.importable(context.path, context.path)
        for name in resolver.yarp.importable(context.path, context.path):
            if not (is_component and declares_types_only(name)):
                yield name
        return
    others = _files_in_folder(session, context, IMPORTED_BY_DDSL)
    yield from (name for name in others if name != context.path.name)
    for path in session.known_files():
        if path.suffix.lower() in IMPORTED_BY_DDSL and path != context.path:
            yield os.path.relpath(path, context.path.parent).replace(os.sep, "/")


def _entries_around(context: CompletionContext) -> Iterator[str]:
    """Files and folders beside the file and beside its folder."""
    for above in ("", "../"):
        try:
            names = sorted(os.listdir(context.path.parent / above))  # noqa: PTH208 - names only
        except OSError:
            continue
        yield from (f"{above}{name}" for name in names if not name.startswith("."))


def _files_in_folder(
    session: Session, context: CompletionContext, suffixes: tuple[str, ...]
) -> Iterator[str]:
    """Files in the folder of the file and in its `etc` folder."""
    for below in ("", "etc"):
        for name in session.files.names_in(context.path.parent / below):
            if name.lower().endswith(suffixes) and suffixes:
                yield f"{below}/{name}".lstrip("/")
