"""Occurrences of what a bridge refers to: members of messages, operations and enumerators."""

from __future__ import annotations

from collections.abc import Iterator

from robocomp_dsl.language_server.symbols.bridge_declarations import expressions_of
from robocomp_dsl.language_server.symbols.bridge_types import BridgeMember
from robocomp_dsl.language_server.symbols.symbol import Occurrence, Symbol
from robocomp_dsl.model import types
from robocomp_dsl.model.bridge import Bridge
from robocomp_dsl.model.bridge_values import ConstantValue
from robocomp_dsl.model.interface import Interface, Operation
from robocomp_dsl.syntax.ast.base import Name


def member_symbol(member: BridgeMember) -> Symbol:
    """The symbol of a field, a parameter, or of the operation whose result it is."""
    kind = "parameter"
    if isinstance(member.model_object, types.Field) or member.model_object is None:
        kind = "field"
    elif isinstance(member.model_object, Operation):
        kind = "operation"
    name = member.span.text
    return Symbol(name, kind, member.span, member.model_object, member.container)


def member_occurrence(name: Name, members: Iterator[BridgeMember]) -> Iterator[Occurrence]:
    """The occurrence of the member called `name`, if there is one."""
    member = next((m for m in members if m.name == name.text), None)
    if member:
        yield occurrence_of(name, member)


def occurrence_of(name: Name, member: BridgeMember) -> Occurrence:
    """The occurrence of a member; `result` stays when its operation is renamed."""
    template = "{}" if member.span.text == name.text else name.text
    return Occurrence(name.span, member_symbol(member), rename_template=template)


def enumerators(bridge: Bridge) -> Iterator[Occurrence]:
    """The enumerators in expressions."""
    for value in expressions_of(bridge):
        if isinstance(value, ConstantValue) and isinstance(value.type, types.Enum):
            for enumerator in value.type.enumerators:
                if enumerator.name == value.span.text:
                    name, span = enumerator.name, enumerator.span
                    symbol = Symbol(name, "enumerator", span, enumerator, value.type.name)
                    yield Occurrence(value.span, symbol)


def operation_occurrence(name: Name, interface: Interface) -> Iterator[Occurrence]:
    """The occurrence of an operation, if the interface has it."""
    for operation in interface.operations:
        if operation.name == name.text:
            symbol = Symbol(name.text, "operation", operation.span, operation, interface.name)
            yield Occurrence(name.span, symbol)
