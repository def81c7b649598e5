"""The content of `bridge_worker.py`: the specification of a bridge, and a method for each event.

In: a bridge, its names, wiring and mapping. Out: plain data for the template.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator

from robocomp_dsl.generate import literals, names
from robocomp_dsl.generate.bridge.action_code import action_code
from robocomp_dsl.generate.bridge.bridge_names import BridgeNames
from robocomp_dsl.generate.bridge.mapping import MappingCode
from robocomp_dsl.generate.bridge.methods import (
    BridgeMethod,
    function_method,
    handler_method,
    parameter_hooks,
    service_method,
)
from robocomp_dsl.generate.bridge.places import place, places_text, tuple_text
from robocomp_dsl.generate.bridge.received_messages import own_checks
from robocomp_dsl.generate.bridge.wiring import BridgeWiring
from robocomp_dsl.generate.literals import python_value, quoted
from robocomp_dsl.generate.python.layout import INNER
from robocomp_dsl.model.bridge import Bridge, BridgeOutput, BridgeService
from robocomp_dsl.model.bridge_ports import BridgeInput
from robocomp_dsl.model.bridge_values import (
    BridgeHub,
    BuiltValue,
    Expression,
    HubPolicy,
    StampOf,
)
from robocomp_dsl.record import ValueRecord


class SpecificationCode(ValueRecord):
    """The module. `inputs`, `hubs`, `outputs` and `services` are calls of their classes."""

    source: str
    title: str
    package: str
    doc: str
    params: str
    inputs: tuple[str, ...]
    hubs: tuple[str, ...]
    outputs: tuple[str, ...]
    services: tuple[str, ...]
    actions: tuple[str, ...]
    spec: str
    publish: str
    settings: tuple[str, ...]
    methods: tuple[BridgeMethod, ...]
    functions: tuple[BridgeMethod, ...]
    uses_runtime_types: bool
    imports: tuple[str, ...]
    classes: tuple[str, ...]


def specification_code(
    bridge: Bridge, bridge_names: BridgeNames, wiring: BridgeWiring, mapping: MappingCode
) -> SpecificationCode:
    """The data of the template of `bridge_worker.py`."""
    bridge_names.used.clear()
    stamped = set(_stamped(bridge))
    groups = _group_attributes(bridge)
    methods = [
        *(handler_method(item, bridge_names) for item in bridge.received),
        *(service_method(service, bridge_names) for service in bridge.services),
        *parameter_hooks(bridge, groups),
    ]
    functions = tuple(function_method(f, bridge_names) for f in bridge.functions)
    inputs = tuple(_input(item, stamped) for item in bridge.received)
    hubs = tuple(_hubs(bridge))
    outputs = tuple(_output(output, bridge_names, mapping) for output in bridge.outputs)
    services = tuple(_service(service, mapping) for service in bridge.services)
    actions = tuple(action_code(action, bridge_names, mapping) for action in bridge.actions)
    sent = [(o.name, o.port) for o in bridge.outputs]
    sent += [(p.name, p) for action in bridge.actions for p in action.sent]
    publish = ", ".join(f"{quoted(name)}: self.{bridge_names.call(port)}" for name, port in sent)
    lists = {
        "InputSpec": inputs,
        "HubSpec": hubs,
        "OutputSpec": outputs,
        "ServiceSpec": services,
        "ActionSpec": actions,
        "ActionTopicSpec": actions,
        "CommandSpec": actions,
    }
    return SpecificationCode(
        literals.printable(bridge.path.name),
        bridge.name,
        bridge_names.python.package,
        literals.docstring(bridge.doc, INNER, f"The bridge {bridge.name}."),
        bridge_names.python.params,
        inputs,
        hubs,
        outputs,
        services,
        actions,
        _spec(wiring),
        f"{{{publish}}}",
        tuple(_settings(bridge, groups)),
        tuple(methods),
        functions,
        any("rt." in f"{m.head}{m.lines}" for m in (*methods, *functions)),
        tuple(sorted(bridge_names.used)),
        tuple(sorted(["BridgeSpec", *(name for name, rows in lists.items() if rows)])),
    )


def _spec(wiring: BridgeWiring) -> str:
    """The default connections that `GenericWorker` lacks; "" if there are none."""
    parts = [
        f"{key}={tuple_text(map(quoted, values))}"
        for key, values in (
            ("connections", wiring.connections),
            ("addresses", wiring.addresses),
            ("qualities", wiring.qualities),
        )
        if values
    ]
    return f"replace(GenericWorker.SPEC, {', '.join(parts)})" if parts else ""


def _stamped(bridge: Bridge) -> Iterator[str]:
    """The inputs whose time stamps are used."""
    for hub in bridge.hubs:
        if hub.policy is HubPolicy.SYNCHRONISED:
            yield from (item.name for item in hub.inputs)
    for output in bridge.outputs:
        yield from (item.name for item in output.uses.stamps)
    built = [value for output in bridge.outputs for value in output.arguments]
    for service in bridge.services:
        built += [*service.reply, *(value for call in service.calls for value in call.arguments)]
    for node in nodes_of(built):
        if isinstance(node, StampOf):
            yield node.input.name


def nodes_of(built: Iterable[BuiltValue]) -> Iterator[Expression]:
    """All nodes of the expressions of some values."""
    for value in built:
        expressions = [assignment.value for assignment in value.assignments]
        if value.value is not None:
            expressions.append(value.value)
        for expression in expressions:
            yield from expression.walk()


def _input(item: BridgeInput, stamped: set[str]) -> str:
    port = item.port
    parts = [*map(quoted, (item.name, port.name, port.operation.name, place(port.span)))]
    if item.name in stamped:
        parts += [f"stamp=mapping.stamp_{item.name}"] if item.stamp_path else []
        parts += ["needs_stamp=True"]
    if own_checks(item):
        parts.append(f"check=mapping.check_{item.name}")
    return f"InputSpec({', '.join(parts)})"


def _hubs(bridge: Bridge) -> Iterator[str]:
    """The hubs, and one for each input that an output uses without a hub."""
    for hub in bridge.hubs:
        yield _hub(hub)
    used = dict.fromkeys(item for output in bridge.outputs for item in output.uses.inputs)
    stamps = dict.fromkeys(item for output in bridge.outputs for item in output.uses.stamps)
    for item in used:
        name, where = quoted(item.name), quoted(place(item.port.span))
        yield f"HubSpec({name}, ({name},), {where})"
    for item in stamps:
        name, where = quoted(stamp_hub(item)), quoted(place(item.port.span))
        yield f"HubSpec({name}, ({quoted(item.name)},), {where}, is_passive=True)"


def stamp_hub(item: BridgeInput) -> str:
    """The name of the hub of an input of which only the time stamp is used."""
    return f"stamp({item.name})"


def _hub(hub: BridgeHub) -> str:
    inputs = tuple_text(quoted(item.name) for item in hub.inputs)
    parts = [quoted(hub.name), inputs, quoted(place(hub.span))]
    if hub.policy is not HubPolicy.LATEST:
        parts.append(quoted(hub.policy.value))
    values = {"tolerance": hub.tolerance_s, "max_age": hub.max_age_s}
    parts += [f"{key}={python_value(float(value))}" for key, value in values.items() if value]
    return f"HubSpec({', '.join(parts)})"


def _output(output: BridgeOutput, bridge_names: BridgeNames, mapping: MappingCode) -> str:
    port, uses = output.port, output.uses
    hubs = tuple_text(
        quoted(name)
        for name in (
            *(item.name for item in uses.inputs),
            *(hub.name for hub in uses.hubs),
            *map(stamp_hub, uses.stamps),
        )
    )
    function = mapping.function(f"output_{output.name}")
    del bridge_names
    parts = [*map(quoted, (output.name, port.name, port.operation.name)), hubs]
    parts += [f"mapping.{function.name}", places_text(function.places)]
    parts += [f"rate={python_value(float(output.rate_hz))}"] if output.rate_hz else []
    return f"OutputSpec({', '.join(parts)})"


def _service(service: BridgeService, mapping: MappingCode) -> str:
    port = service.port
    function = mapping.function(f"service_{service.name}")
    parts = [*map(quoted, (service.name, port.name, port.operation.name))]
    parts += [f"mapping.{function.name}", places_text(function.places)]
    return f"ServiceSpec({', '.join(parts)})"


def _group_attributes(bridge: Bridge) -> dict[str, str]:
    """The attributes of the parameter groups in `params`, by their names."""
    declared = [*(o.name for o in bridge.outputs), *(hub.name for hub in bridge.hubs)]
    attributes = names.unique(declared, names.PARAMETER_MEMBERS | names.ANNOTATION)
    return dict(zip(declared, attributes, strict=True))


def _settings(bridge: Bridge, groups: dict[str, str]) -> Iterator[str]:
    """The statements of `initialize` that apply the parameters."""
    for output in bridge.outputs:
        yield f"self.bridge.set_rate({quoted(output.name)}, params.{groups[output.name]}.rate)"
    for hub in bridge.hubs:
        yield f"self.bridge.set_max_age({quoted(hub.name)}, params.{groups[hub.name]}.max_age)"
        if hub.policy is HubPolicy.SYNCHRONISED:
            value = f"params.{groups[hub.name]}.tolerance"
            yield f"self.bridge.set_tolerance({quoted(hub.name)}, {value})"
