"""The methods of `bridge_worker.py`: for messages, requests, live parameters and user functions.

In: parts of a bridge and its names. Out: `BridgeMethod`s, plain data for the template.
"""

from __future__ import annotations

from collections.abc import Iterator

from robocomp_dsl.generate import literals, names
from robocomp_dsl.generate.bridge.bridge_names import BridgeNames
from robocomp_dsl.generate.bridge.places import place
from robocomp_dsl.generate.literals import quoted
from robocomp_dsl.generate.python.layout import BODY
from robocomp_dsl.model.bridge import Bridge, BridgeService
from robocomp_dsl.model.bridge_ports import BridgeFunction, BridgeInput
from robocomp_dsl.model.bridge_values import HubPolicy
from robocomp_dsl.record import ValueRecord


class BridgeMethod(ValueRecord):
    """One method of the class: its head, docstring and lines."""

    head: str
    doc: str
    lines: tuple[str, ...]


def parameter_hooks(bridge: Bridge, groups: dict[str, str]) -> Iterator[BridgeMethod]:
    """The hooks that apply changed parameters; `groups` are attributes of `params`."""
    for output in bridge.outputs:
        value = f"self.params.{groups[output.name]}.rate"
        yield _hook(
            f"{output.name}_rate",
            "rate",
            (f"self.set_period(self.bridge.set_rate({quoted(output.name)}, {value}))",),
        )
    for hub in bridge.hubs:
        value = f"self.params.{groups[hub.name]}.max_age"
        line = f"self.bridge.set_max_age({quoted(hub.name)}, {value})"
        yield _hook(f"{hub.name}_max_age", "maximum age", (line,))
        if hub.policy is HubPolicy.SYNCHRONISED:
            value = f"self.params.{groups[hub.name]}.tolerance"
            line = f"self.bridge.set_tolerance({quoted(hub.name)}, {value})"
            yield _hook(f"{hub.name}_tolerance", "tolerance", (line,))


def _hook(name: str, what: str, lines: tuple[str, ...]) -> BridgeMethod:
    head = f"def did_set_{name}(self, old: float) -> None:"
    return BridgeMethod(head, f'"""Set the {what}."""', lines)


def handler_method(item: BridgeInput, bridge_names: BridgeNames) -> BridgeMethod:
    """The method that receives the messages of an input."""
    arguments = _arguments(item.port.name, item.port.operation.name, bridge_names)
    value = ", ".join(name for name, _ in arguments)
    value = value if len(arguments) == 1 else f"({value})"
    return BridgeMethod(
        _head(bridge_names.handler(item.port), arguments, "None"),
        literals.docstring(f"Receive a message of the input `{item.name}`.", BODY),
        (f"self.bridge.inputs[{quoted(item.name)}].receive({value})",),
    )


def service_method(service: BridgeService, bridge_names: BridgeNames) -> BridgeMethod:
    """The method that answers the requests of a service."""
    port = service.port
    arguments = _arguments(port.name, port.operation.name, bridge_names)
    types = bridge_names.python.types
    component_port = next(p for p, _ in bridge_names.python.handlers if p.name == port.name)
    operation = next(
        o for o in component_port.interface.operations if o.name == port.operation.name
    )
    returns = types.returns(operation)
    names_used = [d for d in types.names.values() if d in returns.replace("[", " ").split()]
    bridge_names.used |= {n for n in types.names.values() if n in {returns, *names_used}}
    call = (
        f"self.bridge.services[{quoted(service.name)}].answer({', '.join(n for n, _ in arguments)})"
    )
    lines = (call,) if returns == "None" else (f"reply: {returns} = {call}", "return reply")
    return BridgeMethod(
        _head(bridge_names.handler(port), arguments, returns),
        literals.docstring(f"Answer a request of the service `{service.name}`.", BODY),
        lines,
    )


def _arguments(port: str, operation: str, bridge_names: BridgeNames) -> list[tuple[str, str]]:
    """The arguments of a handler with their annotations; the types are imported."""
    python = bridge_names.python
    own, found = next((p, o) for p, o in python.handlers if p.name == port and o.name == operation)
    del own
    arguments = python.types.arguments(found)
    known = set(python.types.names.values())
    bridge_names.used |= {annotation for _, annotation in arguments if annotation in known}
    return arguments


def _head(name: str, arguments: list[tuple[str, str]], returns: str) -> str:
    parameters = ", ".join(["self", *(f"{a}: {t}" for a, t in arguments)])
    return f"def {name}({parameters}) -> {returns}:"


def function_arguments(
    function: BridgeFunction, bridge_names: BridgeNames
) -> tuple[list[tuple[str, str]], str]:
    """The arguments of a user's function with their annotations, and that of the result."""
    argument_names = names.unique([p.name for p in function.parameters], names.ARGUMENTS)
    arguments = [
        (name, bridge_names.annotation(p.type))
        for name, p in zip(argument_names, function.parameters, strict=True)
    ]
    return arguments, bridge_names.annotation(function.result)


def function_method(function: BridgeFunction, bridge_names: BridgeNames) -> BridgeMethod:
    """The method that the user overrides."""
    arguments, returns = function_arguments(function, bridge_names)
    name = bridge_names.variables[function.name]
    return BridgeMethod(
        _head(name, arguments, returns),
        literals.docstring(function_doc(function), BODY),
        (f"raise rt.NotImplementedOperation({quoted(name)})",),
    )


def function_doc(function: BridgeFunction) -> str:
    """The documentation of a user's function: its comment and units."""
    units = [f"{p.name} in {p.unit}" for p in function.parameters if p.unit]
    units += [f"the result in {function.unit}"] if function.unit else []
    title = function.doc or f"The function `{function.name}` ({place(function.span)})."
    return f"{title}\n\nUnits: {', '.join(units)}." if units else title
