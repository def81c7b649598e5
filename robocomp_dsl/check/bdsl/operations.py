"""The operation that an input, output, service or call uses.

In: its type. Out: an imported operation, or one of an interface that the bridge declares for a data
type, a ROS message or a ROS service.
"""

from __future__ import annotations

from enum import Enum

from robocomp_dsl.check.bdsl.context import BridgeContext
from robocomp_dsl.check.bdsl.type_refs import UnitType, resolve_type, service_part
from robocomp_dsl.check.bdsl.types_module import camel_case
from robocomp_dsl.check.codes import bridge as codes
from robocomp_dsl.check.literals import join_names
from robocomp_dsl.check.names.interface_names import find_interface
from robocomp_dsl.check.workspace.imports import replace_fix
from robocomp_dsl.diagnostics import Note, nearest
from robocomp_dsl.model.component import Role
from robocomp_dsl.model.interface import Interface, Operation, Param, Pattern
from robocomp_dsl.model.types import Struct
from robocomp_dsl.record import Record
from robocomp_dsl.source import Span
from robocomp_dsl.syntax.ast import bdsl as ast
from robocomp_dsl.syntax.ast.base import Name, QualifiedName


class PortKind(Enum):
    """What a port of a bridge is for: its word, and its roles for a topic and for a service."""

    INPUT = ("input", Role.SUBSCRIBES, Role.IMPLEMENTS, "receive")
    OUTPUT = ("output", Role.PUBLISHES, Role.REQUIRES, "send")
    SERVICE = ("service", None, Role.IMPLEMENTS, "call")
    CALL = ("call", None, Role.REQUIRES, "call")

    def __init__(self, word: str, topic: Role | None, service: Role, operation: str) -> None:
        self.word = word
        self.topic = topic
        self.service = service
        self.operation = operation


class UsedOperation(Record):
    """An operation, its interface and the role of its port; `is_own`: the bridge declares it."""

    interface: Interface
    operation: Operation
    role: Role
    is_own: bool


def used_operation(
    kind: PortKind, name: Name, ref: ast.TypeRef, context: BridgeContext
) -> UsedOperation | None:
    """The operation of a port called `name`, or None and a finding."""
    if ref.operation is not None and ref.name is not None:
        return _imported(kind, ref.name, ref.operation, ref, context)
    if kind.topic is None:
        return _ros_service(kind, name, ref, context)
    unit_type = resolve_type(ref, camel_case(name.text), context)
    return own_topic(kind, name, unit_type, ref.span, context) if unit_type else None


def own_topic(
    kind: PortKind, name: Name, message: UnitType, span: Span, context: BridgeContext
) -> UsedOperation:
    """A topic of the bridge with one message."""
    param = Param("message", message.type, span, message.unit)
    stem = f"{camel_case(name.text)}Topic"
    interface = context.types.interface(stem, kind.operation, (param,), name.span, None)
    role = kind.topic or kind.service
    return UsedOperation(interface, interface.operations[0], role, is_own=True)


def _imported(
    kind: PortKind,
    name: QualifiedName,
    operation_name: Name,
    ref: ast.TypeRef,
    context: BridgeContext,
) -> UsedOperation | None:
    interface = find_interface(name, context.scope, context.report)
    if interface is None:
        return None
    operation = _operation(interface, operation_name, context)
    if operation is None or not _has_no_list(ref, context):
        return None
    is_topic = (
        all(o.pattern in (Pattern.PUBLISH, Pattern.UNMARKED) for o in interface.operations)
        and kind.topic is not None
    )
    if not _fits_kind(kind, operation, operation_name, context):
        return None
    role = kind.topic if is_topic and kind.topic else kind.service
    return UsedOperation(interface, operation, role, is_own=False)


def _operation(interface: Interface, name: Name, context: BridgeContext) -> Operation | None:
    names = [operation.name for operation in interface.operations]
    if name.text in names:
        return interface.operations[names.index(name.text)]
    guess = nearest(name.text, names)
    context.report.add(
        codes.BRIDGE_OPERATION,
        name.span,
        f"`{interface.name}` has no operation `{name.text}`",
        label=f"did you mean `{guess}`?" if guess else "",
        notes=[Note(interface.span, f"`{interface.name}` is declared here")],
        help="" if guess else f"it has {join_names(names) or 'none'}",
        fix=replace_fix(name.span, guess) if guess else None,
    )
    return None


def _has_no_list(ref: ast.TypeRef, context: BridgeContext) -> bool:
    """Whether an operation is written without lengths and unit; reports others."""
    if not ref.lengths and ref.unit is None:
        return True
    context.report.add(
        codes.BRIDGE_OPERATION,
        ref.span,
        "an operation has no length or unit: its parameters have",
        help="remove the brackets",
    )
    return False


def _fits_kind(kind: PortKind, operation: Operation, name: Name, context: BridgeContext) -> bool:
    returns = bool(operation.result or operation.outputs)
    if kind.topic is not None and returns:
        help_ = "one that returns something is the type of a `service`, or of a `call` in a service"
        message = f"`{operation.name}` returns something: {kind.word}s have one-way operations"
    elif kind.topic is None and operation.pattern is Pattern.PUBLISH:
        help_ = "it is the type of an `input` or `output`"
        message = f"`{operation.name}` is a topic, which no {kind.word} can have"
    else:
        return True
    context.report.add(
        codes.BRIDGE_OPERATION,
        name.span,
        message,
        notes=[Note(operation.span, f"`{operation.name}` is declared here")],
        help=help_,
    )
    return False


def _ros_service(
    kind: PortKind, name: Name, ref: ast.TypeRef, context: BridgeContext
) -> UsedOperation | None:
    """The request and response of a ROS service."""
    if ref.name is None or ref.lengths or ref.unit is not None:
        message = f"the type of a {kind.word} is a ROS service, or an operation of an interface"
        help_ = "write such as `std_srvs::SetBool`, or `Module::Interface.operation`"
        context.report.add(codes.BRIDGE_OPERATION, ref.span, message, help=help_)
        return None
    parts = [_part(ref.name, part, context) for part in ("Request", "Response")]
    structs = [part for part in parts if part is not None]
    if len(structs) != len(parts):
        _report_no_service(kind, ref.name, context)
        return None
    request = Param("request", structs[0], ref.span)
    stem = f"{camel_case(name.text)}Service"
    interface = context.types.interface(stem, "call", (request,), name.span, structs[1])
    return UsedOperation(interface, interface.operations[0], kind.service, is_own=True)


def _part(name: QualifiedName, part: str, context: BridgeContext) -> Struct | None:
    found = context.scope.lookup(service_part(name, part), Struct)
    return found[0] if found else None


def _report_no_service(kind: PortKind, name: QualifiedName, context: BridgeContext) -> None:
    interfaces = context.scope.lookup(name, Interface)
    structs = context.scope.lookup(name, Struct)
    if interfaces:
        operations = [f"{name.text}.{o.name}" for o in interfaces[0].operations]
        context.report.add(
            codes.BRIDGE_OPERATION,
            name.span,
            f"`{name.text}` is an interface: name the operation",
            notes=[Note(interfaces[0].span, "it is declared here")],
            help=f"write {join_names(operations, most=3)}",
        )
    elif structs:
        context.report.add(
            codes.BRIDGE_OPERATION,
            name.span,
            f"`{name.text}` is data: a {kind.word} has a request and a response",
            help="its type is a ROS service, or an operation `Module::Interface.operation`",
        )
    elif not context.scope.is_follow_on_error(name, None):
        _report_unknown_service(name, context)


def _report_unknown_service(name: QualifiedName, context: BridgeContext) -> None:
    known = [
        declared.qualified.removesuffix("_Request")
        for declared in context.scope.declarations(Struct)
        if declared.name.endswith("_Request")
    ]
    guess = nearest(name.text, known)
    offer = context.scope.suggest_import(service_part(name, "Request"))
    fix = offer.fix if offer else replace_fix(name.span, guess) if guess else None
    context.report.add(
        codes.BRIDGE_OPERATION,
        name.span,
        f"no import declares the service `{name.text}`",
        label=f"did you mean `{guess}`?" if guess and not offer else "",
        help=offer.help if offer else "a service comes from an imported `.srv` file",
        fix=fix,
    )
