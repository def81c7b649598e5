"""Completion candidates."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from itertools import takewhile

from lsprotocol import types as lsp

from robocomp_dsl.check.workspace.middlewares import KnownMiddlewares
from robocomp_dsl.diagnostics import Fix
from robocomp_dsl.language_server.symbols.symbol import Symbol
from robocomp_dsl.language_server.symbols.symbols_pdsl import parameter_symbol
from robocomp_dsl.model.parameter import Parameter
from robocomp_dsl.syntax.grammar.lexer import Token


@dataclass(frozen=True, slots=True)
class CompletionCandidate:
    """A name or keyword that may be inserted.

    `documentation` is Markdown, used if there is no `symbol`. `additional_fix` holds further edits,
    such as the import of the candidate.
    """

    label: str
    kind: lsp.CompletionItemKind
    detail: str = ""
    symbol: Symbol | None = None
    additional_fix: Fix | None = None
    documentation: str = ""


def value_candidates(*labels: str) -> list[CompletionCandidate]:
    """Candidates for fixed words."""
    return [CompletionCandidate(label, lsp.CompletionItemKind.Value) for label in labels]


def middleware_candidates(middlewares: KnownMiddlewares) -> Iterator[CompletionCandidate]:
    """All middlewares with their summaries."""
    for name in middlewares.names():
        description = middlewares.describe(name)
        summary = description.summary if description else ""
        yield CompletionCandidate(name, lsp.CompletionItemKind.Value, summary)


def parameter_candidates(
    parameters: Sequence[Parameter], key: Sequence[Token]
) -> Iterator[CompletionCandidate]:
    """The parameters that may continue a dotted key."""
    container = ""
    for part in takewhile(lambda token: token.kind != "EQUAL", key):
        if part.kind == "ID":
            group = next((p for p in parameters if p.name == part.text), None)
            if group is None:
                return
            parameters, container = group.members, group.name
    kind = lsp.CompletionItemKind.Property
    for parameter in parameters:
        symbol = parameter_symbol(parameter, container)
        length = f", {parameter.describe_length()}" if parameter.is_list else ""
        yield CompletionCandidate(parameter.name, kind, f"{parameter.type_name}{length}", symbol)
