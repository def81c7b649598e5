"""Workspace symbols: declarations in all known files, by a part of the name."""

from __future__ import annotations

from lsprotocol import types as lsp

from robocomp_dsl.language_server.session import Session
from robocomp_dsl.language_server.symbols.lookup import location_of

MAX_SYMBOLS = 500
KINDS = {
    "module": lsp.SymbolKind.Module,
    "struct": lsp.SymbolKind.Struct,
    "exception": lsp.SymbolKind.Struct,
    "enum": lsp.SymbolKind.Enum,
    "sequence": lsp.SymbolKind.Array,
    "dictionary": lsp.SymbolKind.Object,
    "typedef": lsp.SymbolKind.Object,
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
    "bridge": lsp.SymbolKind.Class,
    "input": lsp.SymbolKind.Property,
    "hub": lsp.SymbolKind.Variable,
    "function": lsp.SymbolKind.Function,
    "output": lsp.SymbolKind.Property,
    "service": lsp.SymbolKind.Method,
    "action": lsp.SymbolKind.Method,
}
"""The kinds that are listed; fields and parameters appear only in the outline of their file."""


def workspace_symbols(
    session: Session, params: lsp.WorkspaceSymbolParams
) -> list[lsp.WorkspaceSymbol]:
    """The symbols whose names contain the letters of the query in order, with gaps allowed."""
    results: list[lsp.WorkspaceSymbol] = []
    for path in session.known_files():
        symbols = (o.symbol for o in session.occurrences_in(path) if o.declares)
        for symbol in symbols:
            if symbol.kind in KINDS and _matches(params.query, symbol.name):
                location = location_of(session, symbol.span)
                result = lsp.WorkspaceSymbol(location, symbol.name, KINDS[symbol.kind])
                result.container_name = symbol.container or None
                results.append(result)
        if len(results) >= MAX_SYMBOLS:
            break
    return results[:MAX_SYMBOLS]


def _matches(query: str, name: str) -> bool:
    letters = iter(name.lower())
    return all(letter in letters for letter in query.lower())
