"""The module that provides the old code with the names it uses, on top of the generated ones.

In: a component, its inferred parameters. Out: the text of `legacy.py`.
"""

from __future__ import annotations

from collections.abc import Collection, Iterator

from robocomp_dsl.generate import names
from robocomp_dsl.generate.literals import python_string
from robocomp_dsl.generate.names import COMPONENT_MEMBERS
from robocomp_dsl.generate.python.component_names import (
    SERVED_ROLES,
    PythonNames,
    modules_of,
    names_of,
)
from robocomp_dsl.generate.python.worker import machine_of
from robocomp_dsl.generate.templates import render
from robocomp_dsl.migrate.infer import InferredParameters, ScalarParameter
from robocomp_dsl.migrate.parameter_files import walk_parameters
from robocomp_dsl.model.component import Component
from robocomp_dsl.model.interface import Module
from robocomp_dsl.model.types import Dictionary, Enum, ExceptionType, Sequence, Struct

STAND_INS = {
    name: frozenset(attributes.split())
    for name, attributes in {
        "Ice": "Exception LocalException UserException ConnectionRefusedException TimeoutException"
        " ConnectFailedException ConnectionLostException ObjectNotExistException loadSlice"
        " NoEndpointException",
        "QtCore": "QCoreApplication QMutex QMutexLocker QRecursiveMutex QTimer Signal Slot"
        " pyqtSignal pyqtSlot qApp",
        "QtWidgets": "QApplication qApp",
        "QtGui": "QApplication qApp",
        "QApplication": "instance quit exit processEvents",
        "QCoreApplication": "instance quit exit processEvents",
        "QRecursiveMutex": "lock tryLock unlock",
        "qApp": "quit exit processEvents aboutToQuit",
        "QTimer": "start stop setInterval interval isActive setSingleShot isSingleShot"
        " setTimerType timeout singleShot",
        "QMutex": "Recursive NonRecursive lock tryLock unlock",
        "QMutexLocker": "unlock relock mutex",
        "Signal": "",
        "Slot": "",
    }.items()
}
"""The names of Ice and Qt that the module provides, and the attributes of each."""


def legacy_text(
    component: Component,
    parameters: InferredParameters,
    *,
    source: bool = False,
    bare: Collection[str] = (),
) -> str:
    """The module for the old code of `component`.

    `source`: its modules are in `src/`; `bare` are types that it uses without their module.
    """
    called = names_of(component)
    provided = interface_names(component)
    return render(
        "migrate/legacy.py.jinja",
        name=component.name,
        package=called.package,
        modules=[(m.name, list(_types(m, called))) for m in modules_of(component)],
        settings=list(_settings(parameters)),
        typed=parameters.typed,
        proxies=list(_proxies(component, called)),
        machine=_machine_name(component),
        states=list(states_of(component)),
        events=list(_events(component)),
        source=source,
        bare=[
            (name, next(module for module, names in provided.items() if name in names))
            for name in sorted(bare)
        ],
        window=bool(component.gui),
    )


def interface_names(component: Component) -> dict[str, frozenset[str]]:
    """The names that each interface module of RoboComp has for the old code."""
    called = names_of(component)
    return {
        module.name: frozenset(old for old, _ in _types(module, called))
        for module in modules_of(component)
    }


def states_of(component: Component) -> Iterator[str]:
    """The suffixes of the state methods of the component's state machine."""
    machine = machine_of(component)
    for method in machine.of_verb("state") if machine else ():
        yield method.name.removeprefix("state_")


def _machine_name(component: Component) -> str:
    """The attribute of the state machine; empty without a machine or if the name is not usable."""
    reference = component.statemachine
    name = reference.machine.name if reference and reference.machine else ""
    return name if name.isidentifier() and name not in COMPONENT_MEMBERS else ""


def _events(component: Component) -> Iterator[tuple[str, str]]:
    """The old signals, of both generations of RoboComp, and the events that replace them."""
    reference = component.statemachine
    for transition in reference.machine.transitions if reference and reference.machine else ():
        if (
            transition.event
            and transition.target
            and transition.source.isidentifier()
            and transition.target.isidentifier()
        ):
            yield f"t_{transition.source}_to_{transition.target}", transition.event
            yield f"{transition.source}to{transition.target}", transition.event


def _types(module: Module, called: PythonNames) -> Iterator[tuple[str, str]]:
    """The types of a module by old name; sequences and dictionaries are plain."""
    for declaration in module.declarations:
        old = names.identifier(declaration.name)
        if isinstance(declaration, Struct | Enum | ExceptionType):
            yield old, f"_types.{called.types.names[declaration]}"
        elif isinstance(declaration, Sequence):
            yield old, "list"
        elif isinstance(declaration, Dictionary):
            yield old, "dict"


def _settings(parameters: InferredParameters) -> Iterator[str]:
    for path, parameter in walk_parameters(parameters.tree):
        key = "".join(f"{python_string(part)}, " for part in parameter.old_path)
        listed = not isinstance(parameter, ScalarParameter)
        texts = parameter.texts if isinstance(parameter, ScalarParameter) else {}
        rows = ", ".join(f"{value!r}: {python_string(text)}" for value, text in texts.items())
        yield f"(({key}), {python_string('.'.join(path))}, {listed}, {{{rows}}})"


def _proxies(component: Component, called: PythonNames) -> Iterator[tuple[str, str]]:
    for port in component.ports:
        if port.role not in SERVED_ROLES:
            yield f"{port.name}Proxy", called.proxies[port]
            yield port.name, called.proxies[port]
