"""What `generated/simulator.py` says: for every operation a method that asks the device behind it.

In: a component and its names. Out: plain data for the template.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass

from robocomp_dsl.generate import docs, layout, literals, names
from robocomp_dsl.generate.component_names import SERVED, Called
from robocomp_dsl.generate.layout import BODY, INNER, STEP, definition
from robocomp_dsl.generate.simulator.offers import Published, period_of
from robocomp_dsl.generate.worker_imports import specific_imports
from robocomp_dsl.model.component import Component, Port
from robocomp_dsl.model.interface import Operation
from robocomp_dsl.model.parameter import Kind, Parameter

SKIN = "skin"
"""The group of parameters that a world with skin has."""

PUSHED = "reference_timeout"
"""The parameter that a control board has."""

_TYPES = {Kind.STRING: "str", Kind.FLOAT: "float", Kind.BOOL: "bool"}


@dataclass(frozen=True, slots=True)
class Delegation:
    """One method: its head and its body, line by line."""

    definition: str
    doc: str
    lines: tuple[str, ...]


@dataclass(frozen=True, slots=True)
class SimulatorCode:
    """The module. `source` is the file that the world was described in.

    `topics` are published in every period, `streams` by the devices themselves; `skin` are the
    names and types of the parameters of a skin, if there is one; `pushed`: there is a parameter
    for joints that nobody pushes any more.
    """

    title: str
    source: str
    doc: str
    imports: tuple[str, ...]
    methods: tuple[Delegation, ...]
    topics: tuple[str, ...]
    streams: tuple[str, ...]
    skin: tuple[tuple[str, str], ...]
    pushed: bool


def simulator_code(
    source: str,
    component: Component,
    called: Called,
    topics: Sequence[Published],
    *,
    unheard: bool = False,
) -> SimulatorCode:
    """Everything that the templates print; `unheard`: it is also published where nobody hears."""
    proxies = {port.name: attribute for port, attribute in called.proxies.items()}
    served = [p for p in component.ports if p.role in SERVED]
    return SimulatorCode(
        title=component.name,
        source=source,
        doc=literals.docstring(component.doc, INNER, f"The simulator {component.name}."),
        imports=tuple(specific_imports(called)),
        methods=tuple(_method(p, o, called) for p in served for o in p.interface.operations),
        topics=tuple(
            _publications([one for one in topics if not one.topic.at_once], proxies, unheard)
        ),
        streams=tuple(_streams([one for one in topics if one.topic.at_once], proxies)),
        skin=_skin_parameters(component),
        pushed=any(one.name == PUSHED for one in _parameters(component)),
    )


def _streams(topics: Sequence[Published], proxies: Mapping[str, str]) -> Iterator[str]:
    """For each port the statement that lets it publish by itself."""
    for source in dict.fromkeys(one.source for one in topics):
        told = [f"self.{proxies[one.port]}" for one in topics if one.source == source]
        port = f"self.ports[{literals.quoted(source)}]"
        yield layout.statement("", layout.call(f"{port}.publish", *told), BODY)


def _parameters(component: Component) -> Sequence[Parameter]:
    return component.parameters.parameters if component.parameters else ()


def _skin_parameters(component: Component) -> tuple[tuple[str, str], ...]:
    """The live parameters of the group `skin` with their types; none without skin."""
    given = _parameters(component)
    found = next((one for one in given if one.name == SKIN and one.members), None)
    return tuple((one.name, _TYPES[one.kind]) for one in found.members) if found else ()


def _publications(
    topics: Sequence[Published], proxies: Mapping[str, str], unheard: bool
) -> Iterator[str]:
    """The lines that publish; topics of a longer period in every so many rounds."""
    usual = period_of(topics)
    for every in sorted({one.topic.period // usual for one in topics}, reverse=True):
        if every > 1:
            yield f"if self.rounds % {every} == 0:"
        for one in topics:
            if one.topic.period == every * usual:
                indent = STEP if every > 1 else ""
                yield from _publication(one, f"self.{proxies[one.port]}", indent, unheard)


def _publication(one: Published, proxy: str, indent: str, unheard: bool) -> Iterator[str]:
    """Where it is heard, what a port answers or its servant has to tell is published."""
    port = f"self.ports[{literals.quoted(one.source)}]"
    asking = layout.call(f"{port}.current", literals.quoted(one.topic.asked), tail="):")
    told = "told"
    if one.topic.news:
        asking, told = layout.call(f"{port}.news", tail="):"), "*told"
    if not unheard:
        yield f"{indent}if {proxy}.is_heard():"
        indent += STEP
    yield indent + layout.statement("for told in ", asking, BODY + indent)
    indent += STEP
    telling = layout.call(f"{proxy}.{one.topic.operation}", told)
    yield indent + layout.statement("", telling, BODY + indent)


def _method(port: Port, one: Operation, called: Called) -> Delegation:
    arguments = called.types.arguments(one)
    returns = called.types.returns(one)
    return Delegation(
        definition(
            called.handlers[port, one], ("self", *(f"{a}: {t}" for a, t in arguments)), returns
        ),
        literals.docstring(docs.of_operation(one, called.types, port.interface.qualified), BODY),
        tuple(_lines(port, one, [a for a, _ in arguments], layout.flat(returns))),
    )


def _lines(port: Port, one: Operation, arguments: list[str], returns: str) -> Iterator[str]:
    """Two steps for an answer, so that every line is one that the formatter leaves as it is."""
    operation = f"self.ports[{literals.quoted(port.name)}].{one.name}"
    if returns == "None":
        yield layout.statement("", layout.call(operation, *arguments), BODY)
        return
    ask, answer = names.unique(("ask", "answer"), arguments)
    yield f"{ask} = {operation}"
    told = f"{answer}: {returns}"
    if arguments:
        yield layout.statement(f"{told} = ", layout.call(ask, *arguments), BODY)
    else:
        yield layout.assignment(told, f"{ask}()", BODY)
    yield f"return {answer}"
