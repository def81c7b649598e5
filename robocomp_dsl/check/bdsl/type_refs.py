"""Resolves types that a BDSL file writes: named, inline, and lists of them.

In: a `TypeRef`. Out: a type and its unit, or None and a finding.
"""

from __future__ import annotations

from robocomp_dsl.check.bdsl.context import BridgeContext
from robocomp_dsl.check.bdsl.types_module import camel_case
from robocomp_dsl.check.bdsl.units import declared_unit
from robocomp_dsl.check.codes import bridge as codes
from robocomp_dsl.check.codes import bridge_values as value_codes
from robocomp_dsl.check.names.duplicates import unique_by_name
from robocomp_dsl.check.names.type_names import TypeResolver
from robocomp_dsl.diagnostics import Edit, Fix, Note
from robocomp_dsl.model.interface import Interface, Param
from robocomp_dsl.model.types import Field, Sequence, Struct, Type
from robocomp_dsl.record import ValueRecord
from robocomp_dsl.syntax.ast import bdsl as ast
from robocomp_dsl.syntax.ast.base import Name, QualifiedName


class UnitType(ValueRecord):
    """A type and the unit of its numbers, "" for none."""

    type: Type
    unit: str


def resolve_type(ref: ast.TypeRef, name: str, context: BridgeContext) -> UnitType | None:
    """The type of `ref`; an inline struct is called `name`."""
    base = _base(ref, name, context)
    if base is None:
        return None
    type_ = base
    for length in ref.lengths:
        if _has_length(type_, context):
            _report_inner_length(ref, context)
            return None
        size = length.value if length else 0
        type_ = context.types.sequence(type_, int(size), ref.span)
    return UnitType(type_, declared_unit(ref.unit, type_, context.report))


def _has_length(type_: Type, context: BridgeContext) -> bool:
    """Whether the bridge declares the length of a list in values of the type."""
    if isinstance(type_, Struct):
        return any(_has_length(field.type, context) for field in type_.fields)
    return isinstance(type_, Sequence) and type_.size > 0 and type_.module == context.types.name


def _report_inner_length(ref: ast.TypeRef, context: BridgeContext) -> None:
    context.report.add(
        value_codes.VALUE_LENGTH,
        ref.span,
        "the lengths of lists in a list cannot be declared: they are not checked at run time",
        help="leave out the inner length, as in `double[][2]`",
    )


def resolve_parameters(
    fields: tuple[ast.ShapeField, ...], name: str, context: BridgeContext
) -> tuple[Param, ...] | None:
    """The parameters of a function; None if one is faulty."""
    unique = unique_by_name(fields, "parameter", context.report)
    params = []
    for node in unique:
        unit_type = resolve_type(node.type, f"{name}{camel_case(node.name.text)}", context)
        if unit_type:
            params.append(Param(node.name.text, unit_type.type, node.name.span, unit_type.unit))
    return tuple(params) if len(params) == len(fields) else None


def _base(ref: ast.TypeRef, name: str, context: BridgeContext) -> Type | None:
    """The type without its lists."""
    if ref.shape is not None:
        return _shape(ref, name, context)
    if ref.name is None:
        return None
    if ref.operation is not None:
        context.report.add(
            codes.BRIDGE_OPERATION,
            ref.span,
            f"`{ref.span.text}` is an operation, not a data type",
            help="an operation is the type of a whole input, output, service or call",
        )
        return None
    if _is_special(ref.name, context):
        return None
    names = TypeResolver(context.types.name, {}, lambda _: None, context.scope, context.report)
    return names.data(ref.name)


def _shape(ref: ast.TypeRef, name: str, context: BridgeContext) -> Struct | None:
    """`(double x [m], string name)`."""
    params = resolve_parameters(ref.shape or (), name, context)
    if params is None:
        return None
    fields = tuple(Field(p.name, p.type, p.span, unit=p.unit) for p in params)
    return context.types.struct(name, fields, ref.span)


def _is_special(name: QualifiedName, context: BridgeContext) -> bool:
    """Whether `name` is an interface or a ROS service, where data is expected; reports it."""
    interfaces = context.scope.lookup(name, Interface)
    structs = context.scope.lookup(name, Struct)
    if interfaces and not structs:
        operations = interfaces[0].operations
        first = operations[0].name if operations else "operation"
        suffix = f".{first}"
        end = name.span.subspan(name.span.end, name.span.end)
        context.report.add(
            codes.BRIDGE_OPERATION,
            name.span,
            f"`{name.text}` is an interface: name the operation, as in `{name.text}{suffix}`",
            notes=[Note(interfaces[0].span, "it is declared here")],
            fix=Fix(f"append `{suffix}`", (Edit(end, suffix),)) if len(operations) == 1 else None,
        )
        return True
    if not structs and context.scope.lookup(service_part(name, "Request"), Struct):
        context.report.add(
            codes.BRIDGE_OPERATION,
            name.span,
            f"`{name.text}` is a service, not a message",
            help=f"write `service` or `call`, or name one of its messages: `{name.text}_Request`",
        )
        return True
    return False


def service_part(name: QualifiedName, part: str) -> QualifiedName:
    """The name of the request or response of the ROS service `name`."""
    own = Name(name.name.span, f"{name.name.text}_{part}")
    return QualifiedName(name.span, own, name.module)
