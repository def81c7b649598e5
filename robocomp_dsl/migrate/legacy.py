"""The module that gives the old code the names it uses, on top of the generated ones.

In: a component, its inferred parameters. Out: the text of `legacy.py`.
"""

from __future__ import annotations

from collections.abc import Iterator

from robocomp_dsl.generate import names
from robocomp_dsl.generate.component_names import SERVED, Called, modules_of, names_of
from robocomp_dsl.generate.literals import python_string
from robocomp_dsl.generate.names import COMPONENT_MEMBERS
from robocomp_dsl.generate.templates import render
from robocomp_dsl.generate.worker import machine_of
from robocomp_dsl.migrate.infer import Leaf, Parameters
from robocomp_dsl.migrate.texts import leaves
from robocomp_dsl.model.component import Component
from robocomp_dsl.model.interface import Module
from robocomp_dsl.model.types import Dictionary, Enum, ExceptionType, Sequence, Struct

STAND_INS = {
    "Ice": frozenset(
        (
            "Exception",
            "LocalException",
            "UserException",
            "ConnectionRefusedException",
            "ConnectFailedException",
            "ObjectNotExistException",
            "NoEndpointException",
            "TimeoutException",
            "loadSlice",
        )
    ),
    "QtCore": frozenset(("QMutex", "QMutexLocker", "QTimer", "Slot")),
    "QtWidgets": frozenset(("QApplication",)),
    "QtGui": frozenset[str](),
    "QApplication": frozenset(("instance",)),
    "QTimer": frozenset(("singleShot",)),
    "QMutex": frozenset(("Recursive",)),
    "QMutexLocker": frozenset[str](),
    "Slot": frozenset[str](),
}
"""What the module gives of Ice and Qt, and the attributes of each that it has."""


def legacy_text(component: Component, parameters: Parameters) -> str:
    """The module for the old code of `component`."""
    called = names_of(component)
    return render(
        "migrate/legacy.py.jinja",
        name=component.name,
        modules=[(m.name, list(_types(m, called))) for m in modules_of(component)],
        settings=list(_settings(parameters)),
        typed=parameters.typed,
        proxies=list(_proxies(component, called)),
        machine=_machine_name(component),
        states=list(states_of(component)),
        events=list(_events(component)),
    )


def states_of(component: Component) -> Iterator[str]:
    """The states of its machine, as the methods that were called for them end."""
    machine = machine_of(component)
    for one in machine.of_verb("state") if machine else ():
        yield one.name.removeprefix("state_")


def _machine_name(component: Component) -> str:
    """The attribute that was started; empty without one, or where the name is no such thing."""
    given = component.statemachine
    name = given.machine.name if given and given.machine else ""
    return name if name.isidentifier() and name not in COMPONENT_MEMBERS else ""


def _events(component: Component) -> Iterator[tuple[str, str]]:
    """The signals of old, of both generations of RoboComp, and the events of today."""
    given = component.statemachine
    for one in given.machine.transitions if given and given.machine else ():
        if one.event and one.target and one.source.isidentifier() and one.target.isidentifier():
            yield f"t_{one.source}_to_{one.target}", one.event
            yield f"{one.source}to{one.target}", one.event


def _types(module: Module, called: Called) -> Iterator[tuple[str, str]]:
    """The types of a module as its old Python module had them; lists and dictionaries are plain."""
    for one in module.declarations:
        old = names.identifier(one.name)
        if isinstance(one, Struct | Enum | ExceptionType):
            yield old, f"_types.{called.types.names[one]}"
        elif isinstance(one, Sequence):
            yield old, "list"
        elif isinstance(one, Dictionary):
            yield old, "dict"


def _settings(parameters: Parameters) -> Iterator[str]:
    for path, one in leaves(parameters.tree):
        key = "".join(f"{python_string(part)}, " for part in one.old)
        texts = one.texts if isinstance(one, Leaf) else ("true", "false")
        listed = not isinstance(one, Leaf)
        yield f'(({key}), {python_string(".".join(path))}, {listed}, ("{texts[0]}", "{texts[1]}"))'


def _proxies(component: Component, called: Called) -> Iterator[tuple[str, str]]:
    for port in component.ports:
        if port.role not in SERVED:
            yield f"{port.name}Proxy", called.proxies[port]
            yield port.name, called.proxies[port]
