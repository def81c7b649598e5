"""The page of a bridge: its inputs, hubs, outputs and services, and how messages are built.

In: model and site. Out: a page. Expressions are shown as they are written.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence

from robocomp_dsl.generate.doc.bridge_figure import bridge_figure
from robocomp_dsl.generate.doc.nodes import (
    Block,
    DocumentationPage,
    FactTable,
    Heading,
    Inlines,
    TableRow,
    data_table,
    inline_code,
    join_inlines,
    plain_text,
)
from robocomp_dsl.generate.doc.prose import flatten_doc, parse_prose
from robocomp_dsl.generate.doc.site import DocumentationSite
from robocomp_dsl.model.bridge import Bridge, BridgeOutput, BridgeService
from robocomp_dsl.model.bridge_actions import BridgeAction
from robocomp_dsl.model.bridge_ports import BridgeFunction, BridgeInput, BridgePort
from robocomp_dsl.model.bridge_values import (
    BridgeHub,
    BuiltValue,
    Converted,
    Expression,
    HubPolicy,
)
from robocomp_dsl.model.interface import Param
from robocomp_dsl.model.qos_text import qos_statements
from robocomp_dsl.model.types import Field

_INPUTS = ("input", "message", "over", "address", "quality", "what it is")
_HUBS = ("hub", "items", "policy", "what it is")
_OUTPUTS = ("output", "message", "over", "address", "sent", "quality", "what it is")
_MESSAGES = ("output", "field", "value", "conversion")
_SERVICES = ("service", "operation", "over", "address", "what it is")
_CALLS = ("service", "field", "value", "conversion")
_ACTIONS = ("action", "goal", "over", "address", "timeout", "what it is")
_GOALS = ("action", "field", "value", "conversion")
_FUNCTIONS = ("function", "takes", "returns", "what it is")


def bridge_page(bridge: Bridge, site: DocumentationSite) -> DocumentationPage:
    """All of a bridge, with a drawing of what flows from where to where."""
    return DocumentationPage(site.page(bridge), bridge.name, "Bridge", tuple(_blocks(bridge, site)))


def _blocks(bridge: Bridge, site: DocumentationSite) -> Iterator[Block]:
    file = ("File", inline_code(bridge.path.name))
    yield FactTable((file, ("Middleware", inline_code(bridge.middleware))))
    yield from parse_prose(bridge.doc)
    if bridge.ports:
        yield bridge_figure(bridge, site)
    yield from _section(
        "Inputs",
        _INPUTS,
        [_input(item, site) for item in bridge.inputs],
    )
    yield from _section("Hubs", _HUBS, [_hub(hub) for hub in bridge.hubs])
    yield from _section(
        "Outputs",
        _OUTPUTS,
        [_output(output, site) for output in bridge.outputs],
    )
    rows = [row for output in bridge.outputs for row in _fields(output.name, output.arguments)]
    yield from _section("Messages", _MESSAGES, rows)
    yield from _section(
        "Services",
        _SERVICES,
        [_service(s, site) for s in bridge.services],
    )
    yield from _section("Calls", _CALLS, _replies(bridge))
    rows = [_action(action, site) for action in bridge.actions]
    yield from _section("Actions", _ACTIONS, rows)
    rows = [row for action in bridge.actions for row in _action_rows(action)]
    yield from _section("Goals", _GOALS, rows)
    yield from _section(
        "Functions",
        _FUNCTIONS,
        [_function(f, site) for f in bridge.functions],
    )


def _section(title: str, head: Sequence[str], rows: Sequence[TableRow]) -> Iterator[Block]:
    if rows:
        yield Heading(2, plain_text(title), title.lower())
        yield from data_table(title, head, rows)


def _parameters(parameters: Sequence[Param], site: DocumentationSite) -> Inlines:
    return join_inlines(
        (*site.type_link(p.type), *(plain_text(f" [{p.unit}]") if p.unit else ()))
        for p in parameters
    )


def _place(port: BridgePort) -> tuple[Inlines, Inlines]:
    return inline_code(port.middleware), inline_code(port.address)


def _input(item: BridgeInput, site: DocumentationSite) -> TableRow:
    message = _parameters(item.parameters, site)
    over, address = _place(item.port)
    quality = plain_text(", ".join(qos_statements(item.port.qos)))
    return TableRow(
        (inline_code(item.name), message, over, address, quality, flatten_doc(item.doc))
    )


def _hub(hub: BridgeHub) -> TableRow:
    items = join_inlines(inline_code(value.span.text) for value in hub.values)
    policy = hub.policy.value
    if hub.policy is HubPolicy.SYNCHRONISED:
        policy += f" within {hub.tolerance_s * 1000:g}\u00a0ms"
    if hub.max_age_s:
        policy += f", not older than {hub.max_age_s:g}\u00a0s"
    return TableRow((inline_code(hub.name), items, plain_text(policy), flatten_doc(hub.doc)))


def _output(output: BridgeOutput, site: DocumentationSite) -> TableRow:
    port = output.port
    when = f"at {output.rate_hz:g}\u00a0Hz" if output.rate_hz else "when its inputs are complete"
    over, address = _place(port)
    quality = plain_text(", ".join(qos_statements(port.qos)))
    message = _parameters(port.operation.inputs, site)
    cells = (inline_code(output.name), message, over, address, plain_text(when), quality)
    return TableRow((*cells, flatten_doc(output.doc)))


def _service(service: BridgeService, site: DocumentationSite) -> TableRow:
    port = service.port
    operation = (*site.declaration_link(port.interface), *plain_text(f".{port.operation.name}"))
    over, address = _place(port)
    return TableRow((inline_code(service.name), operation, over, address, flatten_doc(service.doc)))


def _action(action: BridgeAction, site: DocumentationSite) -> TableRow:
    over = inline_code(action.goal.port.middleware)
    address = inline_code(action.goal.port.address.removesuffix("/goal"))
    timeout = plain_text(f"{action.timeout_s:g}\u00a0s" if action.timeout_s else "")
    goal = _parameters(action.goal.parameters, site)
    return TableRow(
        (inline_code(action.name), goal, over, address, timeout, flatten_doc(action.doc))
    )


def _action_rows(action: BridgeAction) -> Iterator[TableRow]:
    """The fields of commands, feedback and result, and the conditions."""
    for command in action.commands:
        event = " on cancel" if command.is_on_cancel else ""
        yield from _fields(f"{action.name}, command {command.name}{event}", command.arguments)
    yield from _fields(f"{action.name}, feedback", (action.feedback_value,))
    yield from _fields(f"{action.name}, result", (action.result_value,))
    for word, conditions in (("succeed", action.succeed), ("abort", action.abort)):
        for condition in conditions:
            text = " and ".join(" ".join(part.span.text.split()) for part in condition)
            cells = (inline_code(action.name), plain_text(f"{word} when"), inline_code(text))
            yield TableRow((*cells, ()))


def _function(function: BridgeFunction, site: DocumentationSite) -> TableRow:
    unit = plain_text(f" [{function.unit}]") if function.unit else ()
    takes = _parameters(function.parameters, site)
    returns = (*site.type_link(function.result), *unit)
    return TableRow((inline_code(function.name), takes, returns, flatten_doc(function.doc)))


def _replies(bridge: Bridge) -> list[TableRow]:
    rows: list[TableRow] = []
    for service in bridge.services:
        for call in service.calls:
            rows += _fields(f"{service.name}, call {call.name}", call.arguments)
        rows += _fields(service.name, service.reply)
    return rows


def _fields(name: str, arguments: Sequence[BuiltValue]) -> Iterator[TableRow]:
    """A row for each field that is assigned."""
    for argument in arguments:
        root = argument.param.name if len(arguments) > 1 else ""
        if argument.value is not None:
            yield _field(name, root or "(all)", argument.value)
        for assignment in argument.assignments:
            path = _path_text(assignment.path)
            yield _field(name, f"{root}.{path}" if root else path, assignment.value)


def _field(name: str, path: str, value: Expression) -> TableRow:
    units = dict.fromkeys(
        f"{node.value.unit or '?'} → {node.unit}"
        for node in value.walk()
        if isinstance(node, Converted)
    )
    text = inline_code(" ".join(value.span.text.split()))
    return TableRow((inline_code(name), inline_code(path), text, plain_text(", ".join(units))))


def _path_text(path: Sequence[Field | int]) -> str:
    text = "".join(f"[{part}]" if isinstance(part, int) else f".{part.name}" for part in path)
    return text.removeprefix(".")
