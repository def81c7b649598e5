"""The page of a component, and pages of parameters and state machines without a component.

In: model and site. Out: pages.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator

from robocomp_dsl.generate import literals
from robocomp_dsl.generate.doc.graphs import component_figure
from robocomp_dsl.generate.doc.interface_page import operation_links, pattern_badge
from robocomp_dsl.generate.doc.machine_blocks import machine_blocks
from robocomp_dsl.generate.doc.nodes import (
    SPACE,
    Badge,
    Block,
    DocumentationPage,
    FactTable,
    Heading,
    InlineCode,
    Inlines,
    PlainText,
    TableRow,
    data_table,
    inline_code,
    join_inlines,
    plain_text,
)
from robocomp_dsl.generate.doc.prose import flatten_doc, parse_prose
from robocomp_dsl.generate.doc.site import AnchorNames, DocumentationSite
from robocomp_dsl.generate.python import params
from robocomp_dsl.model.component import Component, Port, Role
from robocomp_dsl.model.interface import Pattern
from robocomp_dsl.model.parameter import Kind, Parameter, ParameterSet
from robocomp_dsl.model.statemachine import StateMachine

ROLES = {
    Role.IMPLEMENTS: "implements",
    Role.REQUIRES: "requires",
    Role.PUBLISHES: "publishes",
    Role.SUBSCRIBES: "subscribes to",
}


def component_page(component: Component, site: DocumentationSite) -> DocumentationPage:
    """Ports, parameters, settings and states of a component."""
    return DocumentationPage(
        site.page(component), component.name, "Component", tuple(_blocks(component, site))
    )


def machine_page(machine: StateMachine, site: DocumentationSite) -> DocumentationPage:
    """The page of a state machine that no documented component uses."""
    blocks = (
        FactTable((("File", inline_code(machine.path.name)),)),
        *machine_blocks(machine, site.page(machine)),
    )
    return DocumentationPage(site.page(machine), machine.name, "State machine", blocks)


def parameters_page(parameters: ParameterSet, site: DocumentationSite) -> DocumentationPage:
    """The page of parameters that no documented component uses."""
    blocks = (
        FactTable((("File", inline_code(parameters.path.name)),)),
        *parse_prose(parameters.doc),
        *parameter_table(parameters),
    )
    return DocumentationPage(site.page(parameters), parameters.name, "Parameters", blocks)


def _blocks(component: Component, site: DocumentationSite) -> Iterator[Block]:
    yield FactTable(tuple(_facts(component, site)))
    yield from parse_prose(component.doc)
    if component.ports:
        yield Heading(2, plain_text("Ports"), "ports")
        yield component_figure(component, site)
    head = ("port", "how", "interface", "operations", "middleware")
    yield from data_table(
        f"Ports of {component.name}", head, [_port(p, site) for p in component.ports]
    )
    if component.parameters and component.parameters.parameters:
        yield Heading(2, plain_text("Parameters"), "parameters")
        yield from parse_prose(component.parameters.doc)
        yield from parameter_table(component.parameters)
    machine = component.statemachine.machine if component.statemachine else None
    if machine is not None:
        yield Heading(2, plain_text("States"), "states")
        yield from machine_blocks(machine, site.page(component))


def _facts(component: Component, site: DocumentationSite) -> Iterator[tuple[str, Inlines]]:
    period = f"every {component.period} ms" if component.period else "only on events"
    yield "File", inline_code(component.path.name)
    yield "Language", plain_text(component.language)
    yield "Middleware", inline_code(component.middleware)
    yield "Computes", plain_text(period)
    if component.threads != 1:
        yield "Threads", plain_text(str(component.threads))
    if component.watchdog_s:
        yield "Watchdog", plain_text(f"{component.watchdog_s:g} s")
    if component.gui:
        yield "Window", inline_code(component.gui)
    if component.statemachine:
        yield "State machine", inline_code(component.statemachine.path.name)
    if component.options:
        yield "Options", join_inlines(map(inline_code, component.options))
    homes = [
        deployment
        for deployment in site.subject.deployments
        if any(
            site.page(part.component) == site.page(component)
            for part in deployment.instances
            if not part.is_program
        )
    ]
    if homes:
        yield "Deployed in", join_inlines(map(site.link, homes))


def _port(port: Port, site: DocumentationSite) -> TableRow:
    groups: dict[Pattern, list[Inlines]] = {}
    for operation, words in operation_links(port.interface, site):
        if operation not in port.operations:  # a topic has no operations with outputs
            continue
        groups.setdefault(port.pattern(operation), []).append(words)
    spoken = join_inlines(
        (
            (*pattern_badge(pattern), SPACE, *join_inlines(names))
            for pattern, names in groups.items()
        ),
        SPACE,
    )
    how = f"{ROLES[port.role]}, optional" if port.optional else ROLES[port.role]
    front = (inline_code(port.name), plain_text(how), site.declaration_link(port.interface))
    return TableRow((*front, spoken, join_inlines(map(inline_code, port.middlewares))))


def parameter_table(parameters: ParameterSet) -> Iterator[Block]:
    """A table of all parameters; parameters of groups have the path of the group."""
    head = ("parameter", "type", "default", "range", "unit", "what it is")
    names = AnchorNames()
    rows = [
        TableRow(_parameter(path, p), names.claim(f"parameter.{path}"))
        for path, p in _walk_parameters(parameters.parameters)
    ]
    yield from data_table(f"Parameters of {parameters.name}", head, rows)


def _walk_parameters(
    parameters: Iterable[Parameter], before: str = ""
) -> Iterator[tuple[str, Parameter]]:
    for parameter in parameters:
        listed = "" if parameter.single or parameter.kind is not Kind.GROUP else "[]"
        path = f"{before}{parameter.name}{listed}"
        yield path, parameter
        yield from _walk_parameters(parameter.members, f"{path}.")


def _parameter(path: str, parameter: Parameter) -> tuple[Inlines, ...]:
    group = parameter.kind is Kind.GROUP
    default = (
        plain_text("must be given")
        if parameter.default is None and not group
        else _default(parameter)
    )
    live = (SPACE, Badge("live", "live")) if parameter.live else ()
    name = (InlineCode(path), *live)
    return (
        name,
        _type(parameter),
        default,
        _range(parameter),
        inline_code(parameter.unit),
        flatten_doc(parameter.doc),
    )


def _type(parameter: Parameter) -> Inlines:
    if parameter.is_list:
        length = parameter.describe_length()
        return (PlainText(f"list of {length}: "), *_type(parameter.replace(shortest=None)))
    if parameter.kind is Kind.CHOICE:
        return (PlainText("one of "), *join_inlines(map(inline_code, parameter.choices)))
    if parameter.kind is Kind.GROUP:
        return plain_text(params.takes(parameter).removeprefix("a "))
    return inline_code(parameter.type_name)


def _default(parameter: Parameter) -> Inlines:
    if parameter.default is None:
        return ()
    if isinstance(parameter.default, tuple):
        return inline_code(literals.yaml_value(parameter.default))
    if parameter.kind is Kind.FLOAT and not isinstance(parameter.default, str):
        return inline_code(f"{float(parameter.default):g}")
    return inline_code(
        str(parameter.default)
        if parameter.kind is Kind.CHOICE
        else literals.yaml_value(parameter.default)
    )


def _range(parameter: Parameter) -> Inlines:
    if parameter.kind is Kind.GROUP or (parameter.low is None and parameter.high is None):
        return ()
    low, high = (
        None if bound is None else _format_bound(bound) for bound in (parameter.low, parameter.high)
    )
    if low is None:
        return (PlainText("≤\u00a0"), InlineCode(high or ""))
    return (
        (PlainText("≥\u00a0"), InlineCode(low))
        if high is None
        else (InlineCode(low), PlainText("\u00a0…\u00a0"), InlineCode(high))
    )


def _format_bound(bound: float) -> str:
    return str(int(bound)) if float(bound).is_integer() and abs(bound) < 1e15 else f"{bound:.12g}"
