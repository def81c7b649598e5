"""Workspace symbols: what is declared anywhere, by a part of its name."""

from __future__ import annotations

from lsprotocol import types as lsp

from robocomp_dsl.editor.asked import location
from robocomp_dsl.editor.session import Session

MOST = 500
KINDS = {
    "module": lsp.SymbolKind.Module,
    "struct": lsp.SymbolKind.Struct,
    "exception": lsp.SymbolKind.Struct,
    "enum": lsp.SymbolKind.Enum,
    "sequence": lsp.SymbolKind.Array,
    "dictionary": lsp.SymbolKind.Object,
    "interface": lsp.SymbolKind.Interface,
    "operation": lsp.SymbolKind.Method,
    "component": lsp.SymbolKind.Class,
    "parameters": lsp.SymbolKind.Class,
    "deployment": lsp.SymbolKind.Package,
    "instance": lsp.SymbolKind.Object,
    "host": lsp.SymbolKind.Object,
    "group": lsp.SymbolKind.Namespace,
    "statemachine": lsp.SymbolKind.Class,
    "node": lsp.SymbolKind.Object,
    "state": lsp.SymbolKind.EnumMember,
}
"""Those worth finding from afar; fields and the like are found in the outline of their file."""


def workspace_symbols(
    session: Session, params: lsp.WorkspaceSymbolParams
) -> list[lsp.WorkspaceSymbol]:
    """The symbols that have the letters of the query in their order, whatever stands between."""
    found: list[lsp.WorkspaceSymbol] = []
    for path in session.every_file():
        for one in session.index_or_nothing(path):
            symbol = one.symbol
            if one.declares and symbol.kind in KINDS and _fits(params.query, symbol.name):
                kind, place = KINDS[symbol.kind], location(session, symbol.span)
                made = lsp.WorkspaceSymbol(place, symbol.name, kind)
                made.container_name = symbol.container or None
                found.append(made)
        if len(found) >= MOST:
            break
    return found[:MOST]


def _fits(query: str, name: str) -> bool:
    letters = iter(name.lower())
    return all(letter in letters for letter in query.lower())
