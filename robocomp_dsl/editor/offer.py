"""One thing that completion offers."""

from __future__ import annotations

from dataclasses import dataclass

from lsprotocol import types as lsp

from robocomp_dsl.diagnostics import Fix
from robocomp_dsl.editor.index import Symbol


@dataclass(frozen=True, slots=True)
class Offer:
    """`about` are words of Markdown on it where it is no `symbol`.

    `also` is an edit that goes with it, such as the import of what is offered.
    """

    label: str
    kind: lsp.CompletionItemKind
    detail: str = ""
    symbol: Symbol | None = None
    also: Fix | None = None
    about: str = ""


def words(*labels: str) -> list[Offer]:
    """Fixed words."""
    return [Offer(one, lsp.CompletionItemKind.Value) for one in labels]
