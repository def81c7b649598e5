"""Document symbols: the outline of a file, also of a half-typed one.

In: a tree. Out: a symbol for every named node, nested as the nodes are.
"""

from __future__ import annotations

from collections.abc import Iterator
from typing import TypeAlias

from lsprotocol import types as lsp

from robocomp_dsl.language_server.positions import PositionCodec
from robocomp_dsl.language_server.session import Session
from robocomp_dsl.source import Span
from robocomp_dsl.syntax.ast import bdsl, cdsl, ddsl, idsl, innermodel, pdsl, smdsl
from robocomp_dsl.syntax.ast.base import Name, Node

KINDS: dict[type, lsp.SymbolKind] = {
    idsl.Module: lsp.SymbolKind.Module,
    idsl.Struct: lsp.SymbolKind.Struct,
    idsl.ExceptionDecl: lsp.SymbolKind.Struct,
    idsl.Enum: lsp.SymbolKind.Enum,
    idsl.Enumerator: lsp.SymbolKind.EnumMember,
    idsl.Sequence: lsp.SymbolKind.Array,
    idsl.Dictionary: lsp.SymbolKind.Object,
    idsl.Alias: lsp.SymbolKind.Object,
    idsl.Interface: lsp.SymbolKind.Interface,
    idsl.Operation: lsp.SymbolKind.Method,
    idsl.Field: lsp.SymbolKind.Field,
    idsl.Constant: lsp.SymbolKind.Constant,
    cdsl.Component: lsp.SymbolKind.Class,
    cdsl.Port: lsp.SymbolKind.Property,
    pdsl.ParameterSet: lsp.SymbolKind.Class,
    pdsl.Group: lsp.SymbolKind.Struct,
    pdsl.Parameter: lsp.SymbolKind.Property,
    ddsl.Deployment: lsp.SymbolKind.Package,
    ddsl.Group: lsp.SymbolKind.Namespace,
    ddsl.Host: lsp.SymbolKind.Object,
    ddsl.Instance: lsp.SymbolKind.Object,
    ddsl.Connection: lsp.SymbolKind.Event,
    ddsl.External: lsp.SymbolKind.Object,
    ddsl.Arbitration: lsp.SymbolKind.Event,
    innermodel.Element: lsp.SymbolKind.Object,
    smdsl.Machine: lsp.SymbolKind.Class,
    smdsl.Substates: lsp.SymbolKind.Namespace,
    bdsl.Bridge: lsp.SymbolKind.Class,
    bdsl.Input: lsp.SymbolKind.Property,
    bdsl.Function: lsp.SymbolKind.Function,
    bdsl.Hub: lsp.SymbolKind.Variable,
    bdsl.Output: lsp.SymbolKind.Property,
    bdsl.Service: lsp.SymbolKind.Method,
    bdsl.Call: lsp.SymbolKind.Method,
    bdsl.Action: lsp.SymbolKind.Method,
    bdsl.Command: lsp.SymbolKind.Property,
}
_BridgePortNode: TypeAlias = (
    bdsl.Input | bdsl.Output | bdsl.Service | bdsl.Call | bdsl.Action | bdsl.Command
)


def document_symbols(
    session: Session, params: lsp.DocumentSymbolParams
) -> list[lsp.DocumentSymbol]:
    """The outline of a file."""
    session.source(params.text_document.uri)
    tree = session.parsed(session.path_of(params.text_document.uri)).tree
    return list(_outline(tree, session.positions)) if isinstance(tree, Node) else []


def _outline(node: Node, positions: PositionCodec) -> Iterator[lsp.DocumentSymbol]:
    """The symbols of the nodes in `node`."""
    fields: tuple[str, ...] = type(node).__match_args__
    children = [
        child
        for field in fields
        for value in [getattr(node, field)]
        for child in (value if isinstance(value, tuple) else (value,))
        if isinstance(child, Node)
    ]
    for child in sorted(children, key=lambda child: child.span.start):
        kind = KINDS.get(type(child))
        if kind is None or getattr(child, "is_implicit", False):
            continue
        name, span = _name(child)
        yield lsp.DocumentSymbol(
            name=name or "?",
            detail=_detail(child),
            kind=kind,
            range=positions.range_of(child.span.cover(span)),
            selection_range=positions.range_of(span),
            children=[*_outline(child, positions), *_states(child, positions)] or None,
        )


def _states(node: Node, positions: PositionCodec) -> Iterator[lsp.DocumentSymbol]:
    """The states of a block, in source order."""
    if not isinstance(node, smdsl.Block):
        return
    details = {id(node.initial): "initial", id(node.end): "end"}
    for state in sorted(node.all_states, key=lambda name: name.span.start):
        extent = positions.range_of(state.span)
        yield lsp.DocumentSymbol(
            name=state.text,
            detail=details.get(id(state), ""),
            kind=lsp.SymbolKind.EnumMember,
            range=extent,
            selection_range=extent,
        )


def _name(node: Node) -> tuple[str, Span]:
    match node:
        case cdsl.Port():
            port_name = node.alias or node.interface
            return port_name.text, port_name.span
        case ddsl.Connection():
            ends = (node.source, node.target)
            words = [f"{end.instance.text}.{end.port.text}" for end in ends]
            return " → ".join(words), node.source.span
        case ddsl.Arbitration(target=target):
            return f"{target.instance.text}.{target.port.text}", target.span
        case innermodel.Element():
            own = node.get("id") or node.get("name")
            return (own.value.value, own.value.span) if own else (node.tag.text, node.tag.span)
    name: Name = getattr(node, "name")  # noqa: B009 - all other nodes have one
    return name.text, name.span


def _detail(node: Node) -> str:
    name: Name | None = None
    match node:
        case cdsl.Port():
            return node.role
        case idsl.Field():
            return node.type.text
        case idsl.Operation():
            return node.result.text if node.result else "void"
        case ddsl.Instance(component=Name() as name):
            pass
        case innermodel.Element():
            name = node.tag
        case smdsl.Substates(parallel=True):
            return "parallel"
        case _ if isinstance(node, _BridgePortNode | pdsl.Parameter):
            return _type_detail(node)
        case bdsl.Hub(policy=name):
            pass
    return name.text if name else ""


def _type_detail(node: _BridgePortNode | pdsl.Parameter) -> str:
    """The type of a parameter, of a list with its length: `float[1:8]`; that of a port."""
    if not isinstance(node, pdsl.Parameter):
        return _port_detail(node)
    length = node.count.span.text if node.count else ""
    if isinstance(node.type, Name):
        return f"{node.type.text}{length}"
    return f"{node.type.span.text}{length}" if length else ""


def _port_detail(node: _BridgePortNode) -> str:
    """The type and middleware of a port of a bridge."""
    over = f"over {node.place.middleware.text}" if node.place.middleware else ""
    type_text = " ".join(node.type.span.text.split()) if node.type else ""
    return f"{type_text} {over}".strip()
