"""Resolved things as a few lines of their own language: what hover and completion show.

In: objects of the model. Out: text.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from typing import Any

from robocomp_dsl.editor import shapes_innermodel, shapes_smdsl
from robocomp_dsl.editor.shapes_block import block
from robocomp_dsl.model import types
from robocomp_dsl.model.component import Component, Port
from robocomp_dsl.model.deployment import Deployment, Host, Instance
from robocomp_dsl.model.interface import Interface, Module, Operation, Param, Pattern
from robocomp_dsl.model.parameter import Kind, Parameter, ParameterSet


def shape(thing: object) -> str:
    """What `thing` is, or an empty text for what is not known."""
    return _SHAPES.get(type(thing), lambda _: "")(thing)


def doc_of(thing: object) -> str:
    """The doc comment of `thing`; an instance without one has that of its component."""
    doc: str = getattr(thing, "doc", "")
    match thing:
        case Instance() if not doc:
            return thing.component.doc
        case Port():
            return thing.interface.doc
    return doc


def type_name(type_: types.Type | None) -> str:
    """A type as users write it."""
    if type_ is None:
        return "void"
    return type_.name if isinstance(type_, types.Primitive) else type_.qualified


def operation(one: Operation) -> str:
    """An operation with its pattern, whether that was written or not."""
    inputs = [_typed(p.type, p.name, p.unit) for p in one.inputs]
    outputs = [f"out {_typed(p.type, p.name, p.unit)}" for p in one.outputs]
    throws = f" throws {', '.join(e.qualified for e in one.throws)}" if one.throws else ""
    again = "idempotent " if one.idempotent else ""
    head = f"[{pattern_words(one)}] {again}{type_name(one.result)} {one.name}"
    return f"{head}({', '.join([*inputs, *outputs])}){throws};"


def pattern_words(one: Operation) -> str:
    """`query`; `query | publish` where that depends on the port."""
    if one.pattern is Pattern.UNMARKED:
        return f"{one.as_service()} | {one.as_topic()}"
    return one.pattern


def parameter(one: Parameter) -> str:
    """A parameter as it would be written."""
    if one.kind is Kind.GROUP:
        count = "" if one.single else f"[{_range(one)}]"
        return block(f"{one.name}{count}", [parameter(member) for member in one.members])
    kind = f"{{{', '.join(one.choices)}}}" if one.kind is Kind.CHOICE else one.kind.value
    default = "" if one.default is None else _literal(one)
    unit = f"[{one.unit}]" if one.unit else ""
    parts = [one.name, kind, default, unit, _range(one), "live" if one.live else ""]
    return " ".join(part for part in parts if part) + ";"


def _struct(one: types.Struct) -> str:
    return block(f"struct {one.qualified}", _fields(one.fields))


def _exception(one: types.ExceptionType) -> str:
    return block(f"exception {one.qualified}", _fields(one.fields))


def _enum(one: types.Enum) -> str:
    values = [f"{value.name} = {value.value}," for value in one.enumerators]
    return block(f"enum {one.qualified}", values)


def _sequence(one: types.Sequence) -> str:
    return f"sequence<{type_name(one.element)}> {one.qualified};{_behind(one.element)}"


def _dictionary(one: types.Dictionary) -> str:
    words = f"{type_name(one.key)}, {type_name(one.value)}"
    return f"dictionary<{words}> {one.qualified};{_behind(one.value)}"


def _interface(one: Interface) -> str:
    return block(f"interface {one.qualified}", [operation(o) for o in one.operations])


def _module(one: Module) -> str:
    return block(f"module {one.name}", [declared.name for declared in one.declarations])


def _value(one: types.Enumerator) -> str:
    return f"{one.name} = {one.value}"


def _member(one: types.Field | Param) -> str:
    return _typed(one.type, one.name, one.unit) + _behind(one.type)


def _parameters(one: ParameterSet) -> str:
    return block(f"ComponentParams {one.name}", [parameter(p) for p in one.parameters])


def _component(one: Component) -> str:
    lines = [_port(port) for port in one.ports]
    lines += [f"period {one.period};", f"middleware {one.middleware};"]
    return block(f"Component {one.name}", lines)


def _port(port: Port) -> str:
    name = "" if port.name == port.interface.name else f" as {port.name}"
    middleware = f"({port.middleware})" if port.middleware else ""
    return f"{port.role} {port.interface.qualified}{middleware}{name};"


def _port_with_interface(port: Port) -> str:
    return f"{_port(port)}\n{_interface(port.interface)}"


def _instance(one: Instance) -> str:
    host = f" on {one.host.name}" if one.host.name else ""
    head = f"component {one.name} : {one.component.name}{host}\n"
    return head + _prefixed(one) + _component(one.component)


def _prefixed(one: Instance) -> str:
    return f'prefix "{one.prefix}";    // runs as {one.whole_name}\n' if one.prefix else ""


def _host(one: Host) -> str:
    return f'host {one.name} {{ address "{one.address}"; }};'


def _deployment(one: Deployment) -> str:
    wires = [
        f"connect {w.source.name}.{w.source_port.name} -> {w.target.name}.{w.target_port.name};"
        for w in one.connections
    ]
    parts = [f"component {part.name} : {part.component.name};" for part in one.instances]
    return block(f"Deployment {one.name}", parts + wires)


def _fields(fields: Sequence[types.Field]) -> list[str]:
    return [
        _typed(one.type, one.name, one.unit)
        + ("" if one.default is None else f" = {one.default!r}".replace("'", '"'))
        + ";"
        for one in fields
    ]


def _typed(type_: types.Type, name: str, unit: str) -> str:
    return f"{type_name(type_)} {name}{f' [{unit}]' if unit else ''}"


def _behind(type_: types.Type) -> str:
    """The shape of a type that was only named, below what named it."""
    return "" if isinstance(type_, types.Primitive) else f"\n{shape(type_)}"


def _literal(one: Parameter) -> str:
    if isinstance(one.default, bool):
        return str(one.default).lower()
    return f'"{one.default}"' if one.kind is Kind.STRING else str(one.default)


def _range(one: Parameter) -> str:
    if one.low is None and one.high is None:
        return ""
    low = "" if one.low is None else f"{one.low:g}"
    high = "" if one.high is None else f"{one.high:g}"
    return f"{low}:{high}"


_SHAPES: dict[type, Callable[[Any], str]] = {
    types.Struct: _struct,
    types.ExceptionType: _exception,
    types.Enum: _enum,
    types.Enumerator: _value,
    types.Sequence: _sequence,
    types.Dictionary: _dictionary,
    types.Field: _member,
    Param: _member,
    Interface: _interface,
    Operation: operation,
    Module: _module,
    Parameter: parameter,
    ParameterSet: _parameters,
    Component: _component,
    Port: _port_with_interface,
    Instance: _instance,
    Host: _host,
    Deployment: _deployment,
    **shapes_smdsl.SHAPES,
    **shapes_innermodel.SHAPES,
}
