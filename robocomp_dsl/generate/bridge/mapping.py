"""The content of `mapping.py`: how a bridge builds its messages.

In: a bridge and its names. Out: functions as plain data for the template: for each hub, output and
service, and for time stamps and lengths of received messages. Each statement is one line; the
template's renderer breaks long ones.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence

from robocomp_dsl.generate.bridge.action_functions import action_functions
from robocomp_dsl.generate.bridge.bridge_names import (
    BridgeNames,
    array_annotation,
    primitive_dtype,
)
from robocomp_dsl.generate.bridge.built_values import BuiltLines, value_lines
from robocomp_dsl.generate.bridge.expressions import ExpressionPrinter
from robocomp_dsl.generate.bridge.places import place
from robocomp_dsl.generate.bridge.received_messages import (
    CONTEXT,
    MappingFunction,
    annotation_of,
    check_function,
    input_locals,
    own_checks,
    stamp_function,
)
from robocomp_dsl.generate.literals import printable, quoted
from robocomp_dsl.generate.names import unique
from robocomp_dsl.model.bridge import Bridge, BridgeOutput, BridgeService
from robocomp_dsl.model.bridge_values import BridgeHub, Expression, ListExpression
from robocomp_dsl.model.interface import Operation, Param
from robocomp_dsl.model.types import Type
from robocomp_dsl.record import ValueRecord


class MappingCode(ValueRecord):
    """The module. `imports` are the names of `interfaces` that it uses."""

    source: str
    title: str
    functions: tuple[MappingFunction, ...]
    imports: tuple[str, ...]
    uses_numpy: bool
    uses_copy: bool
    uses_values: bool
    uses_runtime_types: bool

    def function(self, name: str) -> MappingFunction:
        """The function called `name`."""
        return next(f for f in self.functions if f.name == name)


def mapping_code(bridge: Bridge, names: BridgeNames) -> MappingCode:
    """The data of the template of `mapping.py`."""
    names.used.clear()
    functions = tuple(_functions(bridge, names))
    body = [line for function in functions for line in function.lines]
    return MappingCode(
        printable(bridge.path.name),
        bridge.name,
        functions,
        tuple(sorted(names.used)),
        any("np." in line for line in body),
        any("copy(" in line for line in body),
        any("values." in line for line in body),
        any("rt." in f"{f.parameters} {f.returns}" for f in functions),
    )


def _functions(bridge: Bridge, names: BridgeNames) -> Iterator[MappingFunction]:
    for item in bridge.received:
        if own_checks(item):
            yield check_function(item, names)
        if item.stamp_path:
            yield stamp_function(item, names)
    for hub in bridge.hubs:
        yield _hub(hub, names)
    for output in bridge.outputs:
        yield _output(output, names)
    for service in bridge.services:
        yield _service(service, names)
    for action in bridge.actions:
        yield from action_functions(action, names)


def _hub(hub: BridgeHub, names: BridgeNames) -> MappingFunction:
    local_names, lines = input_locals(hub.inputs, names)
    printer = ExpressionPrinter(names, local_names)
    parts = [part for value in hub.values for part in _hub_parts(value, printer)]
    number = hub.type.number
    dtype = primitive_dtype(number) if number else ""
    if dtype:
        result = f"values.joined({', '.join((dtype, *parts))})"
    else:
        result = f"values.listed({', '.join(parts)})"
    if hub.length is not None:
        result = f"values.with_length({result}, {hub.length}, {hub.length})"
    parameters = [f"{names.variables[i.name]}: {annotation_of(i, names)}" for i in hub.inputs]
    return MappingFunction(
        f"hub_{hub.name}",
        ", ".join(parameters),
        array_annotation(number) if number else "list[Any]",
        f"The items of the hub `{hub.name}` ({place(hub.span)}).",
        (*lines, f"return {result}"),
    )


def _hub_parts(value: Expression, printer: ExpressionPrinter) -> Iterator[str]:
    """One value of a hub; the items of a list expression are not joined any further."""
    if not isinstance(value, ListExpression):
        yield printer.statement(value)
        return
    for item in value.items:
        text = printer.statement(item)
        yield f"[{text}]" if item.is_list else text


def _output(output: BridgeOutput, names: BridgeNames) -> MappingFunction:
    uses = output.uses
    local_names, unpack = input_locals(uses.inputs, names)
    printer = ExpressionPrinter(names, local_names)
    parameters = list(CONTEXT)
    lines = []
    for item in uses.inputs:
        variable = names.variables[item.name]
        parameters.append(f"{variable}_set: tuple[{annotation_of(item, names)}]")
        lines.append(f"({variable},) = {variable}_set")
    lines += unpack
    for hub in uses.hubs:
        variable = names.variables[hub.name]
        parameters.append(f"{variable}_set: tuple[Any, ...]")
        lines += [
            f"at.field = {quoted(f'hub {hub.name}')}",
            f"{variable} = hub_{hub.name}(*{variable}_set)",
        ]
    parameters += [f"{names.variables[i.name]}_stamp: tuple[Any, ...]" for i in uses.stamps]
    operation = output.port.operation
    variables = ("message",) if len(output.arguments) == 1 else _argument_names(operation.inputs)
    places = [("", place(output.port.span))]
    built = BuiltLines(printer, names, single=len(output.arguments) == 1)
    results = []
    for argument, variable in zip(output.arguments, variables, strict=True):
        results.append(value_lines(argument, variable, built))
    lines += built.lines
    places += [(f"hub {hub.name}", place(hub.span)) for hub in uses.hubs]
    places += built.places
    kinds = [names.annotation(parameter.type) for parameter in operation.inputs]
    comma = "," * (len(results) == 1)
    return MappingFunction(
        f"output_{output.name}",
        ", ".join(parameters),
        f"tuple[{', '.join(kinds) or '()'}]",
        f"The message of the output `{output.name}` ({place(output.port.span)}).",
        (*lines, f"return ({', '.join(results)}{comma})"),
        tuple(dict(places).items()),
    )


def _argument_names(parameters: Sequence[Param]) -> tuple[str, ...]:
    return unique([f"argument_{parameter.name}" for parameter in parameters])


def _service(service: BridgeService, names: BridgeNames) -> MappingFunction:
    operation = service.port.operation
    requested = unique([p.name for p in operation.inputs], {"at", "user", "values", "np"})
    local_names = {("", p.name): n for p, n in zip(operation.inputs, requested, strict=True)}
    for call in service.calls:
        variable = names.variables[call.name]
        local_names |= {
            (call.name, name): f"{variable}_{name}" for name, _ in _results(call.port.operation)
        }
    printer = ExpressionPrinter(names, local_names)
    places = [("", place(service.port.span))]
    lines: list[str] = []
    for call in service.calls:
        variable = names.variables[call.name]
        built = BuiltLines(printer, names, single=False, prefix=f"{call.name}.")
        arguments = [
            value_lines(argument, f"{variable}_{argument.param.name}_argument", built)
            for argument in call.arguments
        ]
        lines += built.lines
        places += [*built.places, (call.name, place(call.port.span))]
        targets = [f"{variable}_{name}" for name, _ in _results(call.port.operation)]
        text = f"user.{names.call(call.port)}({', '.join(arguments)})"
        lines.append(f"at.field = {quoted(call.name)}")
        lines.append(f"{', '.join(targets)} = {text}" if targets else text)
    built = BuiltLines(printer, names, single=len(service.reply) == 1)
    replies = [
        value_lines(reply, "message" if len(service.reply) == 1 else f"reply_{index}", built)
        for index, reply in enumerate(service.reply)
    ]
    lines += built.lines
    places += built.places
    if replies:
        lines.append(f"return {', '.join(replies)}")
    parameters = [
        f"{n}: {names.annotation(p.type)}" for p, n in zip(operation.inputs, requested, strict=True)
    ]
    kinds = [names.annotation(type_) for _, type_ in _results(operation)]
    several = f"tuple[{', '.join(kinds)}]" if len(kinds) > 1 else "None"
    return MappingFunction(
        f"service_{service.name}",
        ", ".join((*CONTEXT, *parameters)),
        kinds[0] if len(kinds) == 1 else several,
        f"The reply of the service `{service.name}` ({place(service.port.span)}).",
        tuple(lines) or ("return None",),
        tuple(dict(places).items()),
    )


def _results(operation: Operation) -> list[tuple[str, Type]]:
    """The results of a call by name: its result, then its out parameters."""
    outputs = [(p.name, p.type) for p in operation.outputs]
    return [*([("result", operation.result)] if operation.result is not None else []), *outputs]
