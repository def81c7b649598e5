"""Completion candidates."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass

from lsprotocol import types as lsp

from robocomp_dsl.check.workspace.middlewares import KnownMiddlewares
from robocomp_dsl.diagnostics import Fix
from robocomp_dsl.language_server.symbols.symbol import Symbol


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
