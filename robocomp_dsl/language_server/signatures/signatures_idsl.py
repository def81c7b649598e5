"""Signatures of modules, types, interfaces and operations. In: objects of the model. Out: text."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from typing import Any

from robocomp_dsl.language_server.signatures.signatures_block import format_block
from robocomp_dsl.model import types
from robocomp_dsl.model.interface import Interface, Module, Operation, Param, Pattern


def type_name(type_: types.Type | None) -> str:
    """A type as users write it."""
    if type_ is None:
        return "void"
    return type_.name if isinstance(type_, types.Primitive) else type_.qualified


def format_operation(operation: Operation) -> str:
    """An operation with its pattern, explicit or inferred."""
    inputs = [_typed(p.type, p.name, p.unit) + _default(p) for p in operation.inputs]
    outputs = [f"out {_typed(p.type, p.name, p.unit)}" for p in operation.outputs]
    exceptions = ", ".join(exception.qualified for exception in operation.throws)
    throws = f" throws {exceptions}" if exceptions else ""
    modifier = "idempotent " if operation.idempotent else ""
    result = type_name(operation.result)
    head = f"[{format_pattern(operation)}] {modifier}{result} {operation.name}"
    return f"{head}({', '.join([*inputs, *outputs])}){throws};"


def format_pattern(operation: Operation) -> str:
    """The pattern, such as `query`; `query | publish` if it depends on the port."""
    if operation.pattern is Pattern.UNMARKED:
        return f"{operation.as_service()} | {operation.as_topic()}"
    return operation.pattern


def format_interface(interface: Interface) -> str:
    """An interface with its operations."""
    operations = [format_operation(operation) for operation in interface.operations]
    return format_block(f"interface {interface.qualified}", operations)


def _struct(struct: types.Struct) -> str:
    constants = [f"{_constant(constant)};" for constant in struct.constants]
    return format_block(f"struct {struct.qualified}", [*constants, *_fields(struct.fields)])


def _constant(constant: types.Constant) -> str:
    return f"const {constant.type.name} {constant.name} = {_shown(constant.value)}"


def _exception(exception: types.ExceptionType) -> str:
    return format_block(f"exception {exception.qualified}", _fields(exception.fields))


def _enum(enum: types.Enum) -> str:
    values = [f"{value.name} = {value.value}," for value in enum.enumerators]
    return format_block(f"enum {enum.qualified}", values)


def _enumerator(value: types.Enumerator) -> str:
    return f"{value.name} = {value.value}"


def _sequence(sequence: types.Sequence) -> str:
    bound = f", {sequence.bound}" if sequence.bound else ""
    head = f"sequence<{type_name(sequence.element)}{bound}> {sequence.qualified};"
    if sequence.is_anonymous:
        return referenced_signature(sequence.element).lstrip()
    return head + referenced_signature(sequence.element)


def _dictionary(dictionary: types.Dictionary) -> str:
    arguments = f"{type_name(dictionary.key)}, {type_name(dictionary.value)}"
    head = f"dictionary<{arguments}> {dictionary.qualified};"
    return head + referenced_signature(dictionary.value)


def _alias(alias: types.Alias) -> str:
    return f"typedef {type_name(alias.target)} {alias.name};" + referenced_signature(alias.target)


def _module(module: Module) -> str:
    names = [declaration.name for declaration in module.declarations]
    return format_block(f"module {module.name}", names)


def _member(member: types.Field | Param) -> str:
    return _typed(member.type, member.name, member.unit) + referenced_signature(member.type)


def _fields(fields: Sequence[types.Field]) -> list[str]:
    return [_typed(field.type, field.name, field.unit) + _default(field) + ";" for field in fields]


def _default(field: types.Field | Param) -> str:
    if isinstance(field, types.Field) and field.items:
        return f" = [{', '.join(map(_shown, field.items))}]"
    return "" if field.default is None else f" = {_shown(field.default)}"


def _shown(value: types.Literal) -> str:
    return repr(value).replace("'", '"')


def _typed(type_: types.Type, name: str, unit: str) -> str:
    suffix = f" [{unit}]" if unit else ""
    if isinstance(type_, types.Sequence) and type_.is_anonymous and type_.size:
        return f"{type_name(type_.element)} {name}[{type_.size}]{suffix}"
    return f"{type_name(type_)} {name}{suffix}"


def referenced_signature(type_: types.Type) -> str:
    """The signature of a type that is used by name, on the lines below."""
    if isinstance(type_, types.Primitive):
        return ""
    return f"\n{SIGNATURES.get(type(type_), lambda _: '')(type_)}"


SIGNATURES: dict[type, Callable[[Any], str]] = {
    types.Struct: _struct,
    types.ExceptionType: _exception,
    types.Enum: _enum,
    types.Enumerator: _enumerator,
    types.Sequence: _sequence,
    types.Dictionary: _dictionary,
    types.Alias: _alias,
    types.Field: _member,
    types.Constant: _constant,
    Param: _member,
    Interface: format_interface,
    Operation: format_operation,
    Module: _module,
}
