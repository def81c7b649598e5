"""Names that a CDSL file can use at a place."""

from __future__ import annotations

from collections.abc import Iterator

from lsprotocol import types as lsp

from robocomp_dsl.check.search import base_name
from robocomp_dsl.check.suggest import add_import
from robocomp_dsl.editor.complete_idsl import declared
from robocomp_dsl.editor.cursor import Cursor
from robocomp_dsl.editor.offer import Offer, words
from robocomp_dsl.editor.session import Session
from robocomp_dsl.model.component import Component
from robocomp_dsl.model.interface import Interface
from robocomp_dsl.source import UnreadableSource
from robocomp_dsl.syntax import ast_cdsl as ast
from robocomp_dsl.syntax import ast_idsl, parse_idsl

ROLES = ("IMPLEMENTS", "REQUIRES", "SUBSCRIBES", "PUBLISHES")
LANGUAGES = ("Python", "Cpp", "Cpp11")


def names(session: Session, cursor: Cursor) -> Iterator[Offer]:
    """Interfaces for ports, and the words that settings take."""
    kinds = [token.kind for token in cursor.statement]
    models = [one.model for one in session.checks_to_complete(cursor.path)]
    direct = [m for model in models if isinstance(model, Component) for m in model.modules]
    modules = [one for module in direct for one in module.closure()]
    if cursor.last == "LANGUAGE":
        yield from words(*LANGUAGES)
    elif cursor.last == "MIDDLEWARE" or (cursor.last == "LPAR" and kinds[0] in ROLES):
        yield from words(*session.workspace.middlewares)
    elif cursor.last == "_SCOPE":
        yield from declared(modules, (Interface,), module=cursor.statement[-2].text)
    elif cursor.last in (*ROLES, "COMMA") and kinds[0] in ROLES:
        yield from declared(modules, (Interface,))
        yield from _importable(session, cursor)


def _importable(session: Session, cursor: Cursor) -> Iterator[Offer]:
    """Interfaces of files that are not imported yet; the import comes along."""
    tree = session.parsed(cursor.path).tree
    imports = tree.imports if isinstance(tree, ast.File) else ()
    imported = {base_name(one.path.value) for one in imports}
    search = session.workspace.search
    for file in search.known(cursor.path):
        path = search.find(file, cursor.path)
        if path is None or file in imported:
            continue
        try:
            modules = session.files.parse(path, parse_idsl).tree.modules
        except UnreadableSource:
            continue
        fix = add_import(file, cursor.source, imports)
        for module in modules:
            for one in module.declarations:
                if isinstance(one, ast_idsl.Interface):
                    kind = lsp.CompletionItemKind.Interface
                    yield Offer(one.name.text, kind, f"from {file}, not imported yet", also=fix)
