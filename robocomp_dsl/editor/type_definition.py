"""Go to type definition: from a field to its struct, from a port to its interface."""

from __future__ import annotations

from lsprotocol import types as lsp

from robocomp_dsl.editor.asked import location, mentions_at
from robocomp_dsl.editor.session import Session
from robocomp_dsl.model import types
from robocomp_dsl.model.component import Port
from robocomp_dsl.model.deployment import Instance
from robocomp_dsl.model.interface import Operation, Param
from robocomp_dsl.source import Span


def type_definition(session: Session, params: lsp.TypeDefinitionParams) -> list[lsp.Location]:
    """Where the type of what is at the place is declared; nothing for a built-in type."""
    for one in mentions_at(session, params):
        thing = one.nearer.thing if one.nearer else one.symbol.thing
        span = _type_of(thing)
        if span:
            return [location(session, span)]
    return []


def _type_of(thing: object) -> Span | None:
    match thing:
        case Port():
            return thing.interface.span
        case Instance():
            return thing.component.span
        case (
            types.Field(type=types.Declaration() as found)
            | Param(type=types.Declaration() as found)
        ):
            return found.span
        case Operation(result=types.Declaration() as found):
            return found.span
        case types.Sequence(element=types.Declaration() as found):
            return found.span
    return None
