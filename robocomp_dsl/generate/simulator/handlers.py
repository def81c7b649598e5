"""What `generated/simulator.py` says: for every operation a method that asks the device behind it.

In: a component and its names. Out: plain data for the template.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass

from robocomp_dsl.generate import docs, layout, literals, names
from robocomp_dsl.generate.component_names import SERVED, Called
from robocomp_dsl.generate.layout import BODY, INNER, definition
from robocomp_dsl.generate.simulator.offers import Published
from robocomp_dsl.generate.worker_imports import specific_imports
from robocomp_dsl.model.component import Component, Port
from robocomp_dsl.model.interface import Operation
from robocomp_dsl.model.parameter import Kind

SKIN = "skin"
"""The group of parameters that a world with skin has."""

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
    names and types of the parameters of a skin, if there is one.
    """

    title: str
    source: str
    doc: str
    imports: tuple[str, ...]
    methods: tuple[Delegation, ...]
    topics: tuple[str, ...]
    streams: tuple[str, ...]
    skin: tuple[tuple[str, str], ...]


def simulator_code(
    source: str, component: Component, called: Called, topics: Sequence[Published]
) -> SimulatorCode:
    """Everything that the templates print."""
    proxies = {port.name: attribute for port, attribute in called.proxies.items()}
    served = [p for p in component.ports if p.role in SERVED]
    return SimulatorCode(
        title=component.name,
        source=source,
        doc=literals.docstring(component.doc, INNER, f"The simulator {component.name}."),
        imports=tuple(specific_imports(called)),
        methods=tuple(_method(p, o, called) for p in served for o in p.interface.operations),
        topics=tuple(
            line
            for one in topics
            if not one.topic.at_once
            for line in _publication(one, f"self.{proxies[one.port]}")
        ),
        streams=tuple(_streams([one for one in topics if one.topic.at_once], proxies)),
        skin=_skin_parameters(component),
    )


def _streams(topics: Sequence[Published], proxies: Mapping[str, str]) -> Iterator[str]:
    """For each port the statement that lets it publish by itself."""
    for source in dict.fromkeys(one.source for one in topics):
        told = [
            f"self.{proxies[one.port]}.{one.topic.operation}"
            for one in topics
            if one.source == source
        ]
        port = f"self.ports[{literals.quoted(source)}]"
        yield layout.statement("", layout.call(f"{port}.publish", *told), BODY)


def _skin_parameters(component: Component) -> tuple[tuple[str, str], ...]:
    """The live parameters of the group `skin` with their types; none without skin."""
    given = component.parameters.parameters if component.parameters else ()
    found = next((one for one in given if one.name == SKIN and one.members), None)
    return tuple((one.name, _TYPES[one.kind]) for one in found.members) if found else ()


def _publication(one: Published, proxy: str) -> Iterator[str]:
    """The lines that publish what a port answers, or what its servant has to tell."""
    port, indent = f"self.ports[{literals.quoted(one.source)}]", ""
    asking, told = (
        layout.call(f"{port}.current", literals.quoted(one.topic.asked), tail="):"),
        "told",
    )
    if one.topic.news:
        given = ("self.simulation.in_step",) if one.topic.dear else ()
        asking, told = layout.call(f"{port}.news", *given, tail="):"), "*told"
    if one.topic.dear:
        yield layout.statement("if ", layout.call(f"{proxy}.wait_for_server", "0", tail="):"), BODY)
        indent = layout.STEP
    yield indent + layout.statement("for told in ", asking, BODY + indent)
    indent += layout.STEP
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
    yield layout.statement(f"{answer}: {returns} = ", layout.call(ask, *arguments), BODY)
    yield f"return {answer}"
