"""Completion of CDSL files."""

from __future__ import annotations

from collections.abc import Iterator

from lsprotocol import types as lsp

from robocomp_dsl.check.names.suggest import add_import
from robocomp_dsl.check.workspace.import_resolver import base_name
from robocomp_dsl.language_server.completion.candidates import (
    CompletionCandidate,
    middleware_candidates,
    value_candidates,
)
from robocomp_dsl.language_server.completion.complete_idsl import declaration_candidates
from robocomp_dsl.language_server.completion.context import CompletionContext
from robocomp_dsl.language_server.session import Session
from robocomp_dsl.model.component import Component
from robocomp_dsl.model.interface import Interface
from robocomp_dsl.source import UnreadableSource
from robocomp_dsl.syntax.ast import cdsl as ast
from robocomp_dsl.syntax.ast import idsl
from robocomp_dsl.syntax.parse import parse_idsl

ROLES = ("IMPLEMENTS", "REQUIRES", "SUBSCRIBES", "PUBLISHES")
LANGUAGES = ("Python", "Cpp", "Cpp11")


def candidates(session: Session, context: CompletionContext) -> Iterator[CompletionCandidate]:
    """Interfaces for ports, and the values of settings."""
    kinds = [token.kind for token in context.statement]
    models = [checked.model for checked in session.checks_for_completion(context.path)]
    direct = [m for model in models if isinstance(model, Component) for m in model.modules]
    modules = [module for imported in direct for module in imported.closure()]
    previous = context.previous_kind
    if previous == "LANGUAGE":
        yield from value_candidates(*LANGUAGES)
    elif previous == "MIDDLEWARE" or (kinds and kinds[0] in ROLES and _in_mark(kinds)):
        yield from middleware_candidates(session.workspace.middlewares)
    elif previous == "_SCOPE":
        yield from declaration_candidates(modules, (Interface,), module=context.statement[-2].text)
    elif previous in (*ROLES, "COMMA") and kinds[0] in ROLES:
        yield from declaration_candidates(modules, (Interface,))
        yield from _importable(session, context)


def _in_mark(kinds: list[str]) -> bool:
    """Whether a name in the parentheses of a port is expected next."""
    last_mark = max((i for i, kind in enumerate(kinds) if kind == "LPAR"), default=-1)
    return last_mark >= 0 and "RPAR" not in kinds[last_mark:] and kinds[-1] in ("LPAR", "COMMA")


def _importable(session: Session, context: CompletionContext) -> Iterator[CompletionCandidate]:
    """Interfaces of files that are not imported yet, each with a fix that imports its file."""
    tree = session.parsed(context.path).tree
    imports = tree.imports if isinstance(tree, ast.File) else ()
    imported = {base_name(statement.path.value) for statement in imports}
    search = session.workspace.import_resolver
    for file in search.importable_files(context.path):
        path = search.find(file, context.path)
        if path is None or file in imported:
            continue
        try:
            modules = session.files.parse(path, parse_idsl).tree.modules
        except UnreadableSource:
            continue
        fix = add_import(file, context.source, imports)
        for module in modules:
            for declaration in module.declarations:
                if isinstance(declaration, idsl.Interface):
                    name, kind = declaration.name.text, lsp.CompletionItemKind.Interface
                    detail = f"from {file}, not imported yet"
                    yield CompletionCandidate(name, kind, detail, additional_fix=fix)
