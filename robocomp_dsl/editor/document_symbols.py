"""Document symbols: the outline of a file, also of a half-typed one.

In: a tree. Out: every node that has a name, inside the one around it.
"""

from __future__ import annotations

from collections.abc import Iterator

from lsprotocol import types as lsp

from robocomp_dsl.editor.positions import range_of
from robocomp_dsl.editor.session import Session
from robocomp_dsl.source import Span
from robocomp_dsl.syntax import ast_cdsl, ast_ddsl, ast_idsl, ast_innermodel, ast_pdsl, ast_smdsl
from robocomp_dsl.syntax.ast_base import Name, Node

KINDS: dict[type, lsp.SymbolKind] = {
    ast_idsl.Module: lsp.SymbolKind.Module,
    ast_idsl.Struct: lsp.SymbolKind.Struct,
    ast_idsl.ExceptionDecl: lsp.SymbolKind.Struct,
    ast_idsl.Enum: lsp.SymbolKind.Enum,
    ast_idsl.Enumerator: lsp.SymbolKind.EnumMember,
    ast_idsl.Sequence: lsp.SymbolKind.Array,
    ast_idsl.Dictionary: lsp.SymbolKind.Object,
    ast_idsl.Interface: lsp.SymbolKind.Interface,
    ast_idsl.Operation: lsp.SymbolKind.Method,
    ast_idsl.Field: lsp.SymbolKind.Field,
    ast_cdsl.Component: lsp.SymbolKind.Class,
    ast_cdsl.Port: lsp.SymbolKind.Property,
    ast_pdsl.ParameterSet: lsp.SymbolKind.Class,
    ast_pdsl.Group: lsp.SymbolKind.Struct,
    ast_pdsl.Parameter: lsp.SymbolKind.Property,
    ast_ddsl.Deployment: lsp.SymbolKind.Package,
    ast_ddsl.Group: lsp.SymbolKind.Namespace,
    ast_ddsl.Host: lsp.SymbolKind.Object,
    ast_ddsl.Instance: lsp.SymbolKind.Object,
    ast_ddsl.Connection: lsp.SymbolKind.Event,
    ast_innermodel.Element: lsp.SymbolKind.Object,
    ast_smdsl.Machine: lsp.SymbolKind.Class,
    ast_smdsl.Substates: lsp.SymbolKind.Namespace,
}


def document_symbols(
    session: Session, params: lsp.DocumentSymbolParams
) -> list[lsp.DocumentSymbol]:
    """The outline of a file."""
    session.source(params.text_document.uri)
    tree = session.parsed(session.path_of(params.text_document.uri)).tree
    return list(_outline(tree)) if isinstance(tree, Node) else []


def _outline(node: Node) -> Iterator[lsp.DocumentSymbol]:
    """The symbols in `node`, which is none itself."""
    fields: tuple[str, ...] = type(node).__match_args__
    inside = [
        one
        for field in fields
        for value in [getattr(node, field)]
        for one in (value if isinstance(value, tuple) else (value,))
        if isinstance(one, Node)
    ]
    for one in sorted(inside, key=lambda child: child.span.start):
        kind = KINDS.get(type(one))
        if kind is None:
            continue
        name, span = _name(one)
        yield lsp.DocumentSymbol(
            name=name or "?",
            detail=_detail(one),
            kind=kind,
            range=range_of(one.span.to(span)),
            selection_range=range_of(span),
            children=[*_outline(one), *_states(one)] or None,
        )


def _states(node: Node) -> Iterator[lsp.DocumentSymbol]:
    """The states of a block, in order of writing."""
    if not isinstance(node, ast_smdsl.Block):
        return
    parts = {id(node.initial): "initial", id(node.end): "end"}
    for one in sorted(node.all_states, key=lambda name: name.span.start):
        yield lsp.DocumentSymbol(
            name=one.text,
            detail=parts.get(id(one), ""),
            kind=lsp.SymbolKind.EnumMember,
            range=range_of(one.span),
            selection_range=range_of(one.span),
        )


def _name(node: Node) -> tuple[str, Span]:
    match node:
        case ast_cdsl.Port():
            said = node.alias or node.interface
            return said.text, said.span
        case ast_ddsl.Connection():
            ends = (node.source, node.target)
            words = [f"{end.instance.text}.{end.port.text}" for end in ends]
            return " → ".join(words), node.source.span
        case ast_innermodel.Element():
            own = node.get("id") or node.get("name")
            return (own.value.value, own.value.span) if own else (node.tag.text, node.tag.span)
    name: Name = getattr(node, "name")  # noqa: B009 - all others have one
    return name.text, name.span


def _detail(node: Node) -> str:
    said: Name | None = None
    match node:
        case ast_cdsl.Port():
            return node.role
        case ast_idsl.Field():
            return node.type.text
        case ast_idsl.Operation():
            return node.result.text if node.result else "void"
        case ast_pdsl.Parameter(type=Name() as said) | ast_ddsl.Instance(component=Name() as said):
            pass
        case ast_innermodel.Element():
            said = node.tag
        case ast_smdsl.Substates(parallel=True):
            return "parallel"
    return said.text if said else ""
