"""Go to type definition: from a field to its struct, from a port to its interface."""

from __future__ import annotations

from lsprotocol import types as lsp

from robocomp_dsl.language_server.session import Session
from robocomp_dsl.language_server.symbols.lookup import location_of, occurrences_at
from robocomp_dsl.model import types
from robocomp_dsl.model.bridge_ports import BridgeFunction, BridgeInput
from robocomp_dsl.model.component import Port
from robocomp_dsl.model.deployment import External, Instance
from robocomp_dsl.model.interface import Operation, Param
from robocomp_dsl.source import Span


def type_definition(session: Session, params: lsp.TypeDefinitionParams) -> list[lsp.Location]:
    """The declaration of the type of the name at the position; none for a built-in type."""
    for occurrence in occurrences_at(session, params.text_document, params.position):
        symbol = occurrence.definition or occurrence.symbol
        span = _type_span(symbol.model_object)
        if span:
            return [location_of(session, span)]
    return []


def _type_span(model_object: object) -> Span | None:
    match model_object:
        case Port(interface=interface) | External(only_port=Port(interface=interface)):
            return interface.span
        case Instance():
            return model_object.component.span
        case (
            types.Field(type=types.Declaration() as declaration)
            | Param(type=types.Declaration() as declaration)
            | BridgeInput(type=types.Declaration() as declaration)
            | BridgeFunction(result=types.Declaration() as declaration)
        ):
            return declaration.span
        case Operation(result=types.Declaration() as declaration):
            return declaration.span
        case types.Sequence(element=types.Declaration() as declaration):
            return declaration.span
    return None
