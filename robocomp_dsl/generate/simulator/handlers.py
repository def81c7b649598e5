"""The content of `simulator.py`: for every operation a method that calls the device of its port.

In: a component and its names. Out: plain data for the template.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass

from robocomp_dsl.generate import docs, literals, names
from robocomp_dsl.generate.python import layout
from robocomp_dsl.generate.python.component_names import SERVED_ROLES, PythonNames
from robocomp_dsl.generate.python.layout import BODY, INNER, STEP
from robocomp_dsl.generate.python.line_breaking import one_statement
from robocomp_dsl.generate.python.worker_imports import specific_imports
from robocomp_dsl.generate.simulator.served_interfaces import Published, period_of
from robocomp_dsl.model.component import Component, Port
from robocomp_dsl.model.interface import Operation
from robocomp_dsl.model.parameter import Kind, Parameter

SKIN = "skin"
"""The group of parameters of a world with skin."""

PUSHED = "reference_timeout"
"""The parameter of a world with control boards."""

_TYPES = {Kind.STRING: "str", Kind.FLOAT: "float", Kind.BOOL: "bool"}


@dataclass(frozen=True, slots=True)
class Delegation:
    """One method: its head, and the lines of its body."""

    definition: str
    doc: str
    lines: tuple[str, ...]


@dataclass(frozen=True, slots=True)
class SimulatorCode:
    """The module. `source` is the file of the world.

    `topics` are published in every period, `streams` by the devices themselves; `skin` has the
    names and types of the skin's parameters, if any; `has_torque_timeout`: there is a time-out
    for streamed joint references.
    """

    title: str
    source: str
    package: str
    doc: str
    imports: tuple[str, ...]
    methods: tuple[Delegation, ...]
    topics: tuple[str, ...]
    streams: tuple[str, ...]
    skin: tuple[tuple[str, str], ...]
    has_torque_timeout: bool


def simulator_code(
    source: str,
    component: Component,
    py_names: PythonNames,
    topics: Sequence[Published],
    *,
    publish_always: bool = False,
) -> SimulatorCode:
    """The data of the template; `publish_always`: topics are also published without subscribers."""
    proxies = {port.name: attribute for port, attribute in py_names.proxies.items()}
    served = [p for p in component.ports if p.role in SERVED_ROLES]
    return SimulatorCode(
        title=component.name,
        source=source,
        package=py_names.package,
        doc=literals.docstring(component.doc, INNER, f"The simulator {component.name}."),
        imports=tuple(specific_imports(py_names)),
        methods=tuple(_method(p, o, py_names) for p in served for o in p.operations),
        topics=tuple(
            _publications(
                [topic for topic in topics if not topic.topic.immediate], proxies, publish_always
            )
        ),
        streams=tuple(_streams([topic for topic in topics if topic.topic.immediate], proxies)),
        skin=_skin_parameters(component),
        has_torque_timeout=any(parameter.name == PUSHED for parameter in _parameters(component)),
    )


def _streams(topics: Sequence[Published], proxies: Mapping[str, str]) -> Iterator[str]:
    """For each port the statement that starts its own publications."""
    for source in dict.fromkeys(topic.source for topic in topics):
        proxy_names = [f"self.{proxies[topic.port]}" for topic in topics if topic.source == source]
        port = f"self.ports[{literals.quoted(source)}]"
        yield layout.statement("", layout.call(f"{port}.publish", *proxy_names), BODY)


def _parameters(component: Component) -> Sequence[Parameter]:
    return component.parameters.parameters if component.parameters else ()


def _skin_parameters(component: Component) -> tuple[tuple[str, str], ...]:
    """The live parameters of the group `skin` with their types; none without skin."""
    parameters = _parameters(component)
    found = next(
        (parameter for parameter in parameters if parameter.name == SKIN and parameter.members),
        None,
    )
    return tuple((member.name, _TYPES[member.kind]) for member in found.members) if found else ()


def _publications(
    topics: Sequence[Published], proxies: Mapping[str, str], publish_always: bool
) -> Iterator[str]:
    """The lines that publish; a topic with a longer period is published in every n-th round."""
    usual = period_of(topics)
    for every in sorted({topic.topic.period // usual for topic in topics}, reverse=True):
        if every > 1:
            yield f"if self.rounds % {every} == 0:"
        for topic in topics:
            if topic.topic.period == every * usual:
                indent = STEP if every > 1 else ""
                yield from _publication(
                    topic, f"self.{proxies[topic.port]}", indent, publish_always
                )


def _publication(
    published: Published, proxy: str, indent: str, publish_always: bool
) -> Iterator[str]:
    """Publishes a port's result or new data if there are subscribers."""
    port = f"self.ports[{literals.quoted(published.source)}]"
    asking = layout.call(f"{port}.latest", literals.quoted(published.topic.query), tail="):")
    argument = "message"
    if published.topic.on_change:
        asking, argument = layout.call(f"{port}.poll", tail="):"), "*message"
    if not publish_always:
        yield f"{indent}if {proxy}.has_subscribers():"
        indent += STEP
    yield indent + layout.statement("for message in ", asking, BODY + indent)
    indent += STEP
    telling = layout.call(f"{proxy}.{published.topic.operation}", argument)
    yield indent + layout.statement("", telling, BODY + indent)


def _method(port: Port, operation: Operation, py_names: PythonNames) -> Delegation:
    arguments = py_names.types.arguments(operation)
    returns = py_names.types.returns(operation)
    parameters = ["self", *(f"{a}: {t}" for a, t in arguments)]
    return Delegation(
        one_statement(
            f"def {py_names.handlers[port, operation]}({', '.join(parameters)}) -> {returns}:",
            INNER,
        ),
        literals.docstring(
            docs.of_operation(operation, py_names.types, port.interface.qualified), BODY
        ),
        tuple(_lines(port, operation, [a for a, _ in arguments], returns)),
    )


def _lines(
    port: Port, called_operation: Operation, arguments: list[str], returns: str
) -> Iterator[str]:
    """Two statements for a result, so that the formatter need not break a line."""
    operation = f"self.ports[{literals.quoted(port.name)}].{called_operation.name}"
    if returns == "None":
        yield layout.statement("", layout.call(operation, *arguments), BODY)
        return
    ask, answer = names.unique(("ask", "answer"), arguments)
    yield f"{ask} = {operation}"
    target = f"{answer}: {returns}"
    if arguments:
        yield layout.statement(f"{target} = ", layout.call(ask, *arguments), BODY)
    else:
        yield layout.assignment(target, f"{ask}()", BODY)
    yield f"return {answer}"
