"""The import lines of the worker's two modules, sorted like ruff.

In: a component and its names. Out: lines.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator

from robocomp_dsl.generate.python import layout
from robocomp_dsl.generate.python.component_names import PythonNames
from robocomp_dsl.generate.python.python_types import PythonTypes
from robocomp_dsl.model.component import Component
from robocomp_dsl.model.interface import Operation
from robocomp_dsl.model.types import Declaration, Type


def mentioned(operation: Operation, types: PythonTypes) -> Iterator[str]:
    """The types in the signature of a handler."""
    kinds: list[Type] = [p.type for p in operation.inputs]
    kinds += [type_ for _, type_ in types.results(operation)]
    return (types.names[t] for t in kinds if isinstance(t, Declaration))


def _signature_types(py_names: PythonNames) -> set[str]:
    return {name for _, o in py_names.handlers for name in mentioned(o, py_names.types)}


def generic_imports(component: Component, py_names: PythonNames) -> Iterator[str]:
    """The imports of `genericworker.py`, relative to the other generated modules."""
    runtime = {"ComponentSpec"} if component.gui else {"Component", "ComponentSpec"}
    runtime |= {"CalledPort"} if py_names.proxies else set()
    runtime |= {"ServedPort"} if len(py_names.proxies) < len(component.ports) else set()
    used = _signature_types(py_names)
    for port in component.ports:
        interface = py_names.interfaces[port.interface]
        used.add(interface.proxy if port in py_names.proxies else interface.constant)
    yield _import("robocomp_dsl.runtime", runtime)
    if py_names.handlers:
        yield "from robocomp_dsl.runtime import types as rt"
    if component.gui:
        yield "from robocomp_dsl.runtime.gui.window import QtWidgets, WindowComponent"
    yield ""
    if used:
        yield _import(".interfaces", used)
    if component.statemachine and component.statemachine.machine:
        yield "from .machine import MACHINE"
    yield _import(".params", {py_names.params})


def specific_imports(py_names: PythonNames, package: str = "") -> Iterator[str]:
    """The imports of a module that defines the handlers, such as `specificworker.py`.

    `package` is the package of the generated modules; if empty, the imports are relative.
    """
    yield f"from {package}.genericworker import GenericWorker"
    if used := _signature_types(py_names):
        yield _import(f"{package}.interfaces", used)


def _import(module: str, used: Iterable[str]) -> str:
    """`from module import …`, sorted like ruff: constants, classes, the rest."""
    ordered = sorted(used, key=_import_order)
    return f"from {module} import {', '.join(ordered)}"


def _import_order(name: str) -> tuple[object, ...]:
    kind = 0 if name.isupper() and len(name) > 1 else 1 if name[0].isupper() else 2
    return kind, layout.natural(name.lower()), layout.natural(name)
