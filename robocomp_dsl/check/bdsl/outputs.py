"""Outputs: the message of each, from a value, from fields, or from items.

In: the tree nodes, the resolved inputs and hubs. Out: `BridgeOutput` values, and findings.
"""

from __future__ import annotations

from collections.abc import Iterable

from robocomp_dsl.check.bdsl.assignments import build_values
from robocomp_dsl.check.bdsl.context import BridgeContext, FaultyExpression
from robocomp_dsl.check.bdsl.expressions import fitted, typed, value_for
from robocomp_dsl.check.bdsl.message_types import item_type
from robocomp_dsl.check.bdsl.operations import (
    PortKind,
    UsedOperation,
    own_topic,
    used_operation,
)
from robocomp_dsl.check.bdsl.ports import bridge_port
from robocomp_dsl.check.bdsl.scopes import Scope
from robocomp_dsl.check.bdsl.target import ValueTarget
from robocomp_dsl.check.bdsl.type_refs import UnitType
from robocomp_dsl.check.bdsl.types_module import camel_case
from robocomp_dsl.check.codes import bridge as codes
from robocomp_dsl.model.bridge import BridgeOutput
from robocomp_dsl.model.bridge_ports import BridgeInput
from robocomp_dsl.model.bridge_values import (
    BridgeHub,
    BuiltValue,
    Expression,
    ExpressionUse,
    HubValue,
    InputValue,
    StampOf,
)
from robocomp_dsl.model.interface import Param
from robocomp_dsl.model.types import Struct
from robocomp_dsl.syntax.ast import bdsl as ast

MAX_RATE = 10_000.0
"""Hz; no transport sends more often."""


def resolve_output(
    tree: ast.Output, default_rate: float | None, scope: Scope
) -> BridgeOutput | None:
    """An output; None if it is faulty."""
    context = scope.context
    rate_hz = rate_of(tree.rate, context) if tree.rate else default_rate
    resolved = message_of(tree, scope)
    if resolved is None:
        return None
    used, arguments = resolved
    port = bridge_port(PortKind.OUTPUT, tree.name, tree.place, used, context, tree.qos)
    if arguments is None or port is None:
        return None
    uses = expression_use(arguments)
    _check_trigger(tree, rate_hz, uses, context)
    return BridgeOutput(tree.name.text, port, rate_hz, arguments, uses, tree.doc)


def message_of(
    tree: ast.Output, scope: Scope
) -> tuple[UsedOperation, tuple[BuiltValue, ...] | None] | None:
    """The operation of an output and its arguments, None if these are faulty; or None."""
    if tree.type is None:
        return _untyped(tree, scope)
    used = used_operation(PortKind.OUTPUT, tree.name, tree.type, scope.context)
    return (used, _arguments(tree, used.operation.inputs, scope)) if used else None


def rate_of(rate: ast.Rate | None, context: BridgeContext) -> float | None:
    """The rate in Hz; None for none, or one that is out of range."""
    if rate is None:
        return None
    if 0 < rate.hertz <= MAX_RATE:
        return rate.hertz
    if rate.hertz > MAX_RATE:
        context.report.add(
            codes.BRIDGE_RATE,
            rate.span,
            f"{rate.span.text} is above {MAX_RATE:.0f} Hz",
            help="without a rate an output is sent as soon as what it reads has arrived",
        )
    return None


def expression_use(arguments: Iterable[BuiltValue]) -> ExpressionUse:
    """What the expressions of a message read, each once, in order of first use."""
    inputs: dict[BridgeInput, None] = {}
    hubs: dict[BridgeHub, None] = {}
    stamps: dict[BridgeInput, None] = {}
    for argument in arguments:
        own = [argument.value] if argument.value else []
        for root in (*own, *(assignment.value for assignment in argument.assignments)):
            for node in root.walk():
                match node:
                    case InputValue():
                        inputs.setdefault(node.input)
                    case HubValue():
                        hubs.setdefault(node.hub)
                    case StampOf():
                        stamps.setdefault(node.input)
    received = {*inputs, *(source for hub in hubs for source in hub.inputs)}
    only_stamps = tuple(source for source in stamps if source not in received)
    return ExpressionUse(tuple(inputs), tuple(hubs), only_stamps)


def _check_trigger(
    tree: ast.Output, rate_hz: float | None, uses: ExpressionUse, context: BridgeContext
) -> None:
    if rate_hz is None and tree.rate is None and not uses.inputs and not uses.hubs:
        context.report.add(
            codes.BRIDGE_TRIGGER,
            tree.name.span,
            f"`{tree.name.text}` is never sent: it has no rate, and reads no message",
            help="write such as `rate 10 Hz;` in its braces",
        )


def _arguments(
    tree: ast.Output, params: tuple[Param, ...], scope: Scope
) -> tuple[BuiltValue, ...] | None:
    """The values of the parameters of a typed output."""
    items = [field for field in tree.fields if isinstance(field, ast.Item)]
    fields = [field for field in tree.fields if isinstance(field, ast.Assignment)]
    if items:
        _report_items(tree, items[0], params, scope.context)
        return None
    if tree.value is None and not fields and params:
        _report_empty(tree, params, scope.context)
        return None
    whole = None
    if tree.value is not None:
        whole = _whole(tree, tree.value, params, scope)
        if whole is None:
            build_values(params, fields, scope)  # for its findings
            return None
    return build_values(params, fields, scope, whole)


def _whole(
    tree: ast.Output, value: ast.Expression, params: tuple[Param, ...], scope: Scope
) -> Expression | None:
    """`= value` of an output with one parameter."""
    if len(params) == 1:
        target = ValueTarget(f"the message of `{tree.name.text}`", params[0].type, params[0].unit)
        return value_for(value, target, scope)
    names = " ".join(f"{param.name} = …;" for param in params)
    scope.context.report.add(
        codes.OUTPUT_FORM,
        value.span,
        f"the operation has {len(params)} parameters, which one value cannot give",
        help=f"write `{{ {names} }}`",
    )
    return None


def _report_items(
    tree: ast.Output, item: ast.Item, params: tuple[Param, ...], context: BridgeContext
) -> None:
    is_struct = len(params) == 1 and isinstance(params[0].type, Struct)
    context.report.add(
        codes.OUTPUT_FORM,
        item.span,
        f"`{tree.name.text}` has a type, so its message is not built item by item",
        help="assign its fields: `field = value;`" if is_struct else "write `= { a, b }` after it",
    )


def _report_empty(tree: ast.Output, params: tuple[Param, ...], context: BridgeContext) -> None:
    first = params[0]
    is_struct = len(params) == 1 and isinstance(first.type, Struct)
    context.report.add(
        codes.EMPTY_BRIDGE,
        tree.name.span,
        f"`{tree.name.text}` has no content",
        help="assign its fields in braces: `{ field = value; }`, or a whole message: `= value`"
        if is_struct
        else "write `= value` after its address",
    )


def _untyped(
    tree: ast.Output, scope: Scope
) -> tuple[UsedOperation, tuple[BuiltValue, ...] | None] | None:
    """An output without a type: that of its items, or of its value."""
    context = scope.context
    fields = [field for field in tree.fields if isinstance(field, ast.Assignment)]
    items = [field.value for field in tree.fields if isinstance(field, ast.Item)]
    if fields:
        context.report.add(
            codes.OUTPUT_FORM,
            fields[0].path.span,
            f"`{tree.name.text}` has no type, so it has no field `{fields[0].path.text}`",
            help=f"write `output {tree.name.text} : Type`, or `item value;` for each item",
        )
        return None
    if tree.value is not None and items:
        context.report.add(
            codes.OUTPUT_FORM,
            tree.value.span,
            f"`{tree.name.text}` has a value and items",
            help="write all as items, or only the value",
        )
        return None
    if tree.value is None and not items:
        context.report.add(
            codes.EMPTY_BRIDGE,
            tree.name.span,
            f"`{tree.name.text}` has no content",
            help="write `item value;` for each item of its message",
        )
        return None
    node = ast.ListValue(tree.span, tuple(items)) if tree.value is None else tree.value
    return _of_value(tree, node, scope)


def _of_value(
    tree: ast.Output, node: ast.Expression, scope: Scope
) -> tuple[UsedOperation, tuple[BuiltValue, ...] | None] | None:
    context = scope.context
    try:
        value = typed(node, scope)
        message = item_type(value, camel_case(tree.name.text), context)
    except FaultyExpression:
        return None
    unit = "" if isinstance(message, Struct) else value.unit
    used = own_topic(PortKind.OUTPUT, tree.name, UnitType(message, unit), tree.span, context)
    param = used.operation.inputs[0]
    target = ValueTarget(f"the message of `{tree.name.text}`", message, unit)
    built = fitted(node, value, target, scope)
    return used, (BuiltValue(param, built),) if built else None
