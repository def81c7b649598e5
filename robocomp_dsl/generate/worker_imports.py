"""The import lines of the worker's two modules: what is used, sorted as ruff sorts.

In: a component and its names. Out: lines.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator

from robocomp_dsl.generate import layout
from robocomp_dsl.generate.component_names import Called
from robocomp_dsl.generate.python_types import PythonTypes
from robocomp_dsl.model.component import Component
from robocomp_dsl.model.interface import Operation
from robocomp_dsl.model.types import Declaration, Type


def mentioned(one: Operation, types: PythonTypes) -> Iterator[str]:
    """The types that the signature of a handler names."""
    kinds: list[Type] = [p.type for p in one.inputs]
    kinds += [type_ for _, type_ in types.results(one)]
    return (types.names[t] for t in kinds if isinstance(t, Declaration))


def _signature_types(called: Called) -> set[str]:
    return {name for _, o in called.handlers for name in mentioned(o, called.types)}


def generic_imports(component: Component, called: Called) -> Iterator[str]:
    """Those of `generated/genericworker.py`."""
    runtime = {"Component", "ComponentSpec"}
    runtime |= {"CalledPort"} if called.proxies else set()
    runtime |= {"ServedPort"} if len(called.proxies) < len(component.ports) else set()
    used = _signature_types(called)
    for port in component.ports:
        interface = called.interfaces[port.interface]
        used.add(interface.proxy if port in called.proxies else interface.constant)
    yield _import("robocomp_dsl.runtime", runtime)
    if called.handlers:
        yield "from robocomp_dsl.runtime import types as rt"
    yield ""
    if used:
        yield _import("generated.interfaces", used)
    if component.statemachine:
        yield "from generated.machine import MACHINE"
    yield _import("generated.params", {called.params})


def specific_imports(called: Called) -> Iterator[str]:
    """Those of a module that defines the handlers, as `specificworker.py` does."""
    yield "from generated.genericworker import GenericWorker"
    if used := _signature_types(called):
        yield _import("generated.interfaces", used)


def _import(module: str, used: Iterable[str]) -> str:
    """`from module import …`, sorted as ruff sorts: constants, classes, the rest."""
    ordered = sorted(used, key=_import_order)
    line = f"from {module} import {', '.join(ordered)}"
    if len(line) <= layout.WIDTH:
        return line
    return f"from {module} import (\n" + "".join(f"    {n},\n" for n in ordered) + ")"


def _import_order(name: str) -> tuple[object, ...]:
    kind = 0 if name.isupper() and len(name) > 1 else 1 if name[0].isupper() else 2
    return kind, layout.natural(name.lower()), layout.natural(name)
