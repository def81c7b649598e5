"""Completion of groups: names of definitions, their exports, and keys of `set`."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from typing import TypeVar

from lsprotocol import types as lsp

from robocomp_dsl.check.ddsl.definitions import DefinitionFile, DefinitionFiles
from robocomp_dsl.check.passes import check_cdsl
from robocomp_dsl.check.workspace.source_cache import Parsed
from robocomp_dsl.diagnostics import Report
from robocomp_dsl.language_server.completion.candidates import (
    CompletionCandidate,
    parameter_candidates,
)
from robocomp_dsl.language_server.completion.context import CompletionContext
from robocomp_dsl.language_server.session import Session
from robocomp_dsl.language_server.symbols.group_symbols import GroupSymbols
from robocomp_dsl.syntax.ast import ddsl as ast
from robocomp_dsl.syntax.grammar.lexer import Token

_Member = TypeVar("_Member", ast.Instance, ast.Group)


def in_group(context: CompletionContext) -> bool:
    """Whether a definition, or the key of a `set` of a group, is expected."""
    first = context.statement[0].kind if context.statement else ""
    if first == "GROUP":
        return context.previous_kind == "COLON"
    is_key = first == "SET" and all(token.kind != "EQUAL" for token in context.statement)
    return is_key and bool(context.block) and context.block[0].kind == "GROUP"


def candidates(
    session: Session, context: CompletionContext, files: Sequence[ast.File]
) -> Iterator[CompletionCandidate]:
    """Definitions after the colon of a group, members and parameters in a `set` of a group."""
    if context.statement[0].kind == "SET":
        name = next((t.text for t in context.block if t.kind == "ID"), "")
        yield from _member_settings(session, files, name, context.statement[1:])
        return
    names = {name: None for _, file in _definition_files(session, files) for name in file.visible}
    for name in names:
        yield CompletionCandidate(name, lsp.CompletionItemKind.Class, "group")


def exports(
    session: Session, files: Sequence[ast.File], group: str
) -> Iterator[CompletionCandidate]:
    """The exports of the group of that name."""
    for definitions, tree in _groups_called(session, files, group):
        for export in GroupSymbols(definitions).expanded(tree).exports:
            detail = f"from {export.target.instance.text}"
            kind = lsp.CompletionItemKind.Property
            yield CompletionCandidate(export.port.text, kind, detail)


def group_names(files: Sequence[ast.File]) -> Iterator[CompletionCandidate]:
    """The names of groups."""
    for file in files:
        for group in _all_groups(file):
            yield CompletionCandidate(group.name.text, lsp.CompletionItemKind.Module, "group")


def _member_settings(
    session: Session, files: Sequence[ast.File], group: str, key: Sequence[Token]
) -> Iterator[CompletionCandidate]:
    """What may continue the key of a `set` of a group: its members, then their parameters."""
    written = [token.text for token in key if token.kind == "ID"]
    for definitions, tree in _groups_called(session, files, group):
        symbols = GroupSymbols(definitions)
        block, steps = symbols.expanded(tree), list(written)
        while steps and (inner := _find(block.groups, steps[0])):
            block, steps = symbols.expanded(inner), steps[1:]
        member = _find(block.instances, steps[0]) if steps else None
        component = symbols.component_of(member) if member else None
        if component and component.parameters:
            # A name and a dot for each member that was written.
            rest = key[2 * (len(written) - len(steps) + 1) :]
            yield from parameter_candidates(component.parameters.parameters, rest)
        elif not steps:
            kind = lsp.CompletionItemKind.Variable
            names = [each.name.text for each in block.instances]
            for name in (*names, *(each.name.text for each in block.groups)):
                yield CompletionCandidate(name, kind, "")


def _find(nodes: Sequence[_Member], name: str) -> _Member | None:
    return next((node for node in nodes if node.name.text == name), None)


def _definition_files(
    session: Session, files: Sequence[ast.File]
) -> Iterator[tuple[DefinitionFiles, DefinitionFile]]:
    """The definitions that are visible in each version of the file."""
    for file in files:
        definitions = DefinitionFiles(session.workspace, check_cdsl)
        yield definitions, definitions.load(Parsed(file.span.source, file, ()), Report())


def _groups_called(
    session: Session, files: Sequence[ast.File], name: str
) -> Iterator[tuple[DefinitionFiles, ast.Group]]:
    for definitions, file in _definition_files(session, files):
        for group in _all_groups(file.tree):
            if group.name.text == name:
                yield definitions, group


def _all_groups(file: ast.File) -> Iterator[ast.Group]:
    """All groups of a file, definitions included."""
    todo: list[ast.Deployment | ast.Group] = [*file.groups]
    todo += [file.deployment] if file.deployment else []
    while todo:
        block = todo.pop()
        if isinstance(block, ast.Group):
            yield block
        todo.extend(block.groups)
