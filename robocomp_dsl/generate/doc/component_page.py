"""The page of a component, and those of parameters and state machines that stand alone.

In: model and site. Out: pages.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator

from robocomp_dsl.generate import literals, params
from robocomp_dsl.generate.doc.graphs import component_figure
from robocomp_dsl.generate.doc.interface_page import badge, operations
from robocomp_dsl.generate.doc.machine_blocks import machine_blocks
from robocomp_dsl.generate.doc.prose import inline_doc, prose
from robocomp_dsl.generate.doc.site import Names, Site
from robocomp_dsl.generate.doc.words import (
    BLANK,
    Badge,
    Block,
    Code,
    Facts,
    Heading,
    Page,
    Row,
    Text,
    Words,
    code,
    joined,
    table,
    text,
)
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


def component_page(component: Component, site: Site) -> Page:
    """Ports, parameters, settings and states of a component."""
    return Page(site.page(component), component.name, "Component", tuple(_blocks(component, site)))


def machine_page(one: StateMachine, site: Site) -> Page:
    """A state machine that no documented component names."""
    blocks = (Facts((("File", code(one.path.name)),)), *machine_blocks(one, site.page(one)))
    return Page(site.page(one), one.name, "State machine", blocks)


def parameters_page(one: ParameterSet, site: Site) -> Page:
    """Parameters of a file that no documented component names."""
    blocks = (Facts((("File", code(one.path.name)),)), *prose(one.doc), *parameter_table(one))
    return Page(site.page(one), one.name, "Parameters", blocks)


def _blocks(component: Component, site: Site) -> Iterator[Block]:
    yield Facts(tuple(_facts(component, site)))
    yield from prose(component.doc)
    if component.ports:
        yield Heading(2, text("Ports"), "ports")
        yield component_figure(component, site)
    head = ("port", "how", "interface", "operations", "middleware")
    yield from table(f"Ports of {component.name}", head, [_port(p, site) for p in component.ports])
    if component.parameters and component.parameters.parameters:
        yield Heading(2, text("Parameters"), "parameters")
        yield from prose(component.parameters.doc)
        yield from parameter_table(component.parameters)
    machine = component.statemachine.machine if component.statemachine else None
    if machine is not None:
        yield Heading(2, text("States"), "states")
        yield from machine_blocks(machine, site.page(component))


def _facts(component: Component, site: Site) -> Iterator[tuple[str, Words]]:
    period = f"every {component.period} ms" if component.period else "only on events"
    yield "File", code(component.path.name)
    yield "Language", text(component.language)
    yield "Middleware", code(component.middleware)
    yield "Computes", text(period)
    if component.threads != 1:
        yield "Threads", text(str(component.threads))
    if component.gui:
        yield "Window", code(component.gui)
    if component.statemachine:
        yield "State machine", code(component.statemachine.path.name)
    if component.options:
        yield "Options", joined(map(code, component.options))
    homes = [
        one
        for one in site.subject.deployments
        if any(site.page(part.component) == site.page(component) for part in one.instances)
    ]
    if homes:
        yield "Deployed in", joined(map(site.link, homes))


def _port(port: Port, site: Site) -> Row:
    groups: dict[Pattern, list[Words]] = {}
    for one, words in operations(port.interface, site):
        groups.setdefault(port.pattern(one), []).append(words)
    spoken = joined(
        ((*badge(pattern), BLANK, *joined(ones)) for pattern, ones in groups.items()), BLANK
    )
    how = f"{ROLES[port.role]}, optional" if port.optional else ROLES[port.role]
    front = (code(port.name), text(how), site.declared(port.interface))
    return Row((*front, spoken, code(port.middleware)))


def parameter_table(one: ParameterSet) -> Iterator[Block]:
    """All parameters, those inside groups with the names of the groups before theirs."""
    head = ("parameter", "type", "default", "range", "unit", "what it is")
    names = Names()
    rows = [
        Row(_parameter(path, p), names.claim(f"parameter.{path}"))
        for path, p in _flat(one.parameters)
    ]
    yield from table(f"Parameters of {one.name}", head, rows)


def _flat(parameters: Iterable[Parameter], before: str = "") -> Iterator[tuple[str, Parameter]]:
    for one in parameters:
        listed = "" if one.single or one.kind is not Kind.GROUP else "[]"
        path = f"{before}{one.name}{listed}"
        yield path, one
        yield from _flat(one.members, f"{path}.")


def _parameter(path: str, one: Parameter) -> tuple[Words, ...]:
    group = one.kind is Kind.GROUP
    default = text("must be given") if one.default is None and not group else _default(one)
    live = (BLANK, Badge("live", "live")) if one.live else ()
    name = (Code(path), *live)
    return name, _type(one), default, _range(one), code(one.unit), inline_doc(one.doc)


def _type(one: Parameter) -> Words:
    if one.kind is Kind.CHOICE:
        return (Text("one of "), *joined(map(code, one.choices)))
    if one.kind is Kind.GROUP:
        return text(params.takes(one).removeprefix("a "))
    return code(one.kind.value)


def _default(one: Parameter) -> Words:
    if one.default is None:
        return ()
    if one.kind is Kind.FLOAT and not isinstance(one.default, str):
        return code(f"{float(one.default):g}")
    return code(str(one.default) if one.kind is Kind.CHOICE else literals.yaml_value(one.default))


def _range(one: Parameter) -> Words:
    if one.kind is Kind.GROUP or (one.low is None and one.high is None):
        return ()
    low, high = (None if bound is None else _number(bound) for bound in (one.low, one.high))
    if low is None:
        return (Text("≤\u00a0"), Code(high or ""))
    return (
        (Text("≥\u00a0"), Code(low))
        if high is None
        else (Code(low), Text("\u00a0…\u00a0"), Code(high))
    )


def _number(bound: float) -> str:
    return str(int(bound)) if float(bound).is_integer() and abs(bound) < 1e15 else f"{bound:.12g}"
