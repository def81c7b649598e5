"""Signatures of the parts of a bridge. In: objects of the model. Out: text."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from typing import Any

from robocomp_dsl.language_server.signatures.signatures_block import format_block
from robocomp_dsl.language_server.signatures.signatures_idsl import referenced_signature, type_name
from robocomp_dsl.model import types
from robocomp_dsl.model.bridge import Bridge, BridgeOutput, BridgeService
from robocomp_dsl.model.bridge_actions import BridgeAction
from robocomp_dsl.model.bridge_ports import (
    BridgeFunction,
    BridgeInput,
    BridgePort,
    ItemsType,
    TimeType,
    ValueType,
)
from robocomp_dsl.model.bridge_values import BridgeCall, BridgeHub, HubPolicy
from robocomp_dsl.model.interface import Param


def value_text(type_: ValueType | None, unit: str = "") -> str:
    """A type with its unit as users write it; the items of a hub one after the other."""
    match type_:
        case ItemsType(groups=groups):
            parts = []
            for group in groups:
                text = value_text(group.type, group.unit)
                count = "n" if group.count is None else str(group.count)
                parts.append(text if group.count == 1 else f"{count} × {text}")
            return f"{{ {', '.join(parts)} }}"
        case TimeType():
            return "time"
        case types.Struct(fields=fields, span=span) if span.text.startswith("("):
            inside = (f"{value_text(f.type)} {f.name}{_unit(f.unit)}" for f in fields)
            base = f"({', '.join(inside)})"
        case types.Sequence(element=element, size=size):
            base = f"{value_text(element)}[{size or ''}]"
        case _:
            base = type_name(type_)
    return f"{base}{_unit(unit)}"


def _unit(unit: str) -> str:
    return f" [{unit}]" if unit else ""


def format_function(function: BridgeFunction) -> str:
    """A function as it is declared."""
    parameters = ", ".join(map(format_parameter, function.parameters))
    result = value_text(function.result, function.unit)
    return f"function {function.name}({parameters}) -> {result};"


def format_parameter(parameter: Param) -> str:
    """A parameter of a function."""
    return f"{value_text(parameter.type)} {parameter.name}{_unit(parameter.unit)}"


def _place(port: BridgePort) -> str:
    at = f' at "{port.address}"' if port.address else ""
    return f"over {port.middleware}{at};"


def _message(parameters: Sequence[Param]) -> str:
    """The type of a message: its only parameter, or all of them."""
    if len(parameters) == 1:
        return value_text(parameters[0].type, parameters[0].unit)
    return f"({', '.join(map(format_parameter, parameters))})"


def _fields(parameters: Sequence[Param]) -> str:
    """The structs among the types of a message, on the lines below."""
    return "".join(_below(parameter.type) for parameter in parameters)


def _below(type_: types.Type) -> str:
    """The declaration of a type or of its items, on the next line; none of an inline type."""
    while isinstance(type_, types.Sequence):
        type_ = type_.element
    inline = isinstance(type_, types.Struct) and type_.span.text.startswith("(")
    return "" if inline else referenced_signature(type_)


def _input(value: BridgeInput) -> str:
    head = f"input {value.name} : {_message(value.parameters)} {_place(value.port)}"
    return head + _fields(value.parameters)


def _hub(hub: BridgeHub) -> str:
    within = f" within {hub.tolerance_s * 1000:g} ms"
    policy = f"policy {hub.policy.value}{within if hub.policy is HubPolicy.SYNCHRONISED else ''}"
    inputs = ", ".join(value.name for value in hub.inputs)
    return f"hub {hub.name};    // {value_text(hub.type)}, {policy}, of {inputs}"


def _output(output: BridgeOutput) -> str:
    parameters = output.port.operation.inputs
    rate = f"    // {output.rate_hz:g} Hz" if output.rate_hz else ""
    head = f"output {output.name} : {_message(parameters)} {_place(output.port)}{rate}"
    return head + _fields(parameters)


def _operation_port(word: str, name: str, port: BridgePort) -> str:
    operation = port.operation
    results = [*([operation.result] if operation.result else [])]
    results += [parameter.type for parameter in operation.outputs]
    result = ", ".join(map(value_text, results)) or "void"
    head = f"{word} {name}({', '.join(map(format_parameter, operation.inputs))}) -> {result}"
    below = "".join(map(_below, results))
    return f"{head} {_place(port)}{_fields(operation.inputs)}{below}"


def _service(service: BridgeService) -> str:
    return _operation_port("service", service.name, service.port)


def _action(action: BridgeAction) -> str:
    message = action.goal.type
    if not isinstance(message, types.Struct):
        return f"action {action.name}"
    name = message.name.removesuffix("ActionGoal")
    address = action.goal.port.address.removesuffix("/goal")
    head = f'action {action.name} : {name} over {action.goal.port.middleware} at "{address}"'
    goal = next((f.type for f in message.fields if f.name == "goal"), None)
    return head + (f"\n{referenced_signature(goal)}" if goal else "")


def _call(call: BridgeCall) -> str:
    return _operation_port("call", call.name, call.port)


def _bridge(bridge: Bridge) -> str:
    lines = [f"input {value.name} {_place(value.port)}" for value in bridge.inputs]
    lines += [f"output {value.name} {_place(value.port)}" for value in bridge.outputs]
    lines += [f"service {value.name} {_place(value.port)}" for value in bridge.services]
    return format_block(f"Bridge {bridge.name}", lines)


SIGNATURES: dict[type, Callable[[Any], str]] = {
    Bridge: _bridge,
    BridgeInput: _input,
    BridgeHub: _hub,
    BridgeFunction: format_function,
    BridgeOutput: _output,
    BridgeService: _service,
    BridgeAction: _action,
    BridgeCall: _call,
}
