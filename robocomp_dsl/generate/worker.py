"""What `generated/genericworker.py`, `specificworker.py` and `README.md` say of a component.

In: the component, its named types and interfaces. Out: plain data for the templates.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator
from dataclasses import dataclass

from robocomp_dsl.generate import layout, literals, names
from robocomp_dsl.generate.interface_code import InterfaceNames
from robocomp_dsl.generate.layout import BODY, INNER, Group, Item, definition
from robocomp_dsl.generate.python_types import PythonTypes
from robocomp_dsl.model.component import Component, Port, Role
from robocomp_dsl.model.interface import Interface, Operation, Pattern
from robocomp_dsl.model.types import Declaration, Type

COMPONENT_MEMBERS = frozenset(
    (
        "SPEC",
        "clock",
        "compute",
        "declare_emergency",
        "emergency",
        "end_emergency",
        "finalize",
        "initialize",
        "log",
        "name",
        "params",
        "quit",
        "restore",
    )
)
"""Public members of the base of all components; an operation or proxy never hides one."""

SERVED = (Role.IMPLEMENTS, Role.SUBSCRIBES)
_LISTS = {
    Role.IMPLEMENTS: "implements",
    Role.REQUIRES: "requires",
    Role.PUBLISHES: "publishes",
    Role.SUBSCRIBES: "subscribes",
}


@dataclass(frozen=True, slots=True)
class HandlerCode:
    """One method that others call. `refusal` is its body in `GenericWorker`; `call` reaches it.

    `call` is empty where nobody waits for an answer.
    """

    definition: str
    doc: str
    refusal: str
    call: str


@dataclass(frozen=True, slots=True)
class ServedCode:
    """One port that others call: `implements RoboCompLaser::Laser`, and its methods."""

    title: str
    handlers: tuple[HandlerCode, ...]


@dataclass(frozen=True, slots=True)
class CalledCode:
    """One port that calls others: its attribute and the class of that."""

    proxy: str
    hint: str


@dataclass(frozen=True, slots=True)
class WorkerCode:
    """Both classes and what is said of the component as a whole."""

    title: str
    source: str
    doc: str
    spec: str
    params: str
    period: int
    served: tuple[ServedCode, ...]
    called: tuple[CalledCode, ...]
    generic_imports: tuple[str, ...]
    specific_imports: tuple[str, ...]
    examples: tuple[str, ...]
    about: tuple[str, ...]
    rows: tuple[tuple[str, str, str], ...]


@dataclass(frozen=True, slots=True)
class Called:
    """All names of one component."""

    types: PythonTypes
    interfaces: dict[Interface, InterfaceNames]
    handlers: dict[tuple[Port, Operation], str]
    proxies: dict[Port, str]
    params: str


def members(
    component: Component, types: PythonTypes, interfaces: dict[Interface, InterfaceNames]
) -> Called:
    """Names for the methods and proxies; none hides a type or what every component has."""
    params = types.scope.claim(f"{names.camel(component.name)}Params")
    scope = names.Scope(COMPONENT_MEMBERS | types.scope.taken)
    served = [p for p in component.ports if p.role in SERVED]
    proxies = {
        p: scope.claim(f"{p.name.lower()}_proxy") for p in component.ports if p not in served
    }
    handlers = {
        (p, o): scope.claim(f"{p.name}_{o.name}") for p in served for o in p.interface.operations
    }
    return Called(types, interfaces, handlers, proxies, params)


def worker_code(component: Component, called: Called, middleware: str) -> WorkerCode:
    """Everything that the templates of the worker print."""
    served = tuple(_served(p, called) for p in component.ports if p.role in SERVED)
    proxies = [p for p in component.ports if p.role not in SERVED]
    return WorkerCode(
        title=component.name,
        source=component.path.name,
        doc=literals.docstring(component.doc, INNER, f"The component {component.name}."),
        spec=layout.statement("SPEC = ", _spec(component, called, middleware), INNER),
        params=called.params,
        period=component.period,
        served=served,
        called=tuple(
            CalledCode(called.proxies[p], called.interfaces[p.interface].proxy) for p in proxies
        ),
        generic_imports=tuple(_generic_imports(component, called)),
        specific_imports=tuple(_specific_imports(called)),
        examples=tuple(_example(p, called) for p in proxies if p.interface.operations),
        about=("", *about) if (about := literals.lines(component.doc)) else (),
        rows=tuple(_row(p, called) for p in component.ports),
    )


def _spec(component: Component, called: Called, middleware: str) -> Group:
    ports = {role: [_port(p, called) for p in component.with_role(role)] for role in Role}
    return layout.call(
        "ComponentSpec",
        f"name={literals.quoted(component.name)}",
        f"period={component.period}",
        f"threads={component.threads}",
        f"middleware={literals.quoted(middleware)}",
        *(layout.tuple_of(*ports[role], head=f"{key}=") for role, key in _LISTS.items()),
        f"parameters={called.params}",
    )


def _port(port: Port, called: Called) -> Item:
    interface = called.interfaces[port.interface]
    own = [f"middleware={literals.quoted(port.middleware)}"] if port.middleware else []
    if port in called.proxies:
        attribute = literals.quoted(called.proxies[port])
        return layout.call(
            "CalledPort", literals.quoted(port.name), interface.proxy, attribute, *own
        )
    methods = [
        f"{literals.quoted(o.name)}: {literals.quoted(called.handlers[port, o])}"
        for o in port.interface.operations
    ]
    table = Group("{", tuple(methods), "}")
    quoted = literals.quoted(port.name)
    return layout.call("ServedPort", quoted, interface.constant, table, *own)


def _served(port: Port, called: Called) -> ServedCode:
    handlers = tuple(_handler(port, o, called) for o in port.interface.operations)
    return ServedCode(f"{port.role} {port.interface.qualified}", handlers)


def _handler(port: Port, one: Operation, called: Called) -> HandlerCode:
    name = called.handlers[port, one]
    arguments = called.types.arguments(one)
    returns = called.types.returns(one)
    parameters = ("self", *(f"{a}: {t}" for a, t in arguments))
    refused = layout.call("rt.NotImplementedOperation", literals.quoted(name))
    above = layout.call(f"super().{name}", *(a for a, _ in arguments))
    keyword = "" if returns == "None" else "return "
    answers = port.pattern(one) is Pattern.QUERY
    return HandlerCode(
        definition(name, parameters, returns),
        literals.docstring(_about(one, port), BODY),
        layout.statement("raise ", refused, BODY),
        layout.statement(keyword, above, BODY) if answers else "",
    )


def _about(one: Operation, port: Port) -> str:
    """The doc comment of an operation, with the units and the exceptions below it."""
    units = [f"{p.name} in {p.unit}" for p in (*one.inputs, *one.outputs) if p.unit]
    throws = ", ".join(t.name for t in one.throws)
    below = [f"Units: {', '.join(units)}."] if units else []
    below += [f"May raise {throws}."] if throws else []
    said = one.doc.strip() or f"{port.interface.qualified}: {one.name}."
    return "\n".join([said, "", *below]) if below else said


def _mentioned(one: Operation, types: PythonTypes) -> Iterator[str]:
    """The types that the signature of a handler names."""
    kinds: list[Type] = [p.type for p in one.inputs]
    kinds += [type_ for _, type_ in types.results(one)]
    return (types.names[t] for t in kinds if isinstance(t, Declaration))


def _signature_types(called: Called) -> set[str]:
    return {name for _, o in called.handlers for name in _mentioned(o, called.types)}


def _generic_imports(component: Component, called: Called) -> Iterator[str]:
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
    yield _import("generated.params", {called.params})


def _specific_imports(called: Called) -> Iterator[str]:
    yield "from generated.genericworker import GenericWorker"
    if used := _signature_types(called):
        yield _import("generated.interfaces", used)


def _import(module: str, used: Iterable[str]) -> str:
    """`from module import …`, sorted as ruff sorts: constants, classes, the rest."""
    ordered = sorted(used, key=lambda n: (not (n.isupper() and len(n) > 1), n[:1].islower(), n))
    line = f"from {module} import {', '.join(ordered)}"
    if len(line) <= layout.WIDTH:
        return line
    return f"from {module} import (\n" + "".join(f"    {n},\n" for n in ordered) + ")"


def _example(port: Port, called: Called) -> str:
    """A call of the first operation, with zero values."""
    one = port.interface.operations[0]
    method = called.interfaces[port.interface].methods[one]
    given = ", ".join(called.types.zero(p.type).text for p in one.inputs)
    results = [name or "result" for name, _ in called.types.results(one)]
    target = f"{', '.join(names.unique(results))} = " if results else ""
    return f"{target}self.{called.proxies[port]}.{method}({given})"


def _row(port: Port, called: Called) -> tuple[str, str, str]:
    """A row of the table in the README: the port, what it is for, the methods."""
    if port in called.proxies:
        methods = called.interfaces[port.interface].methods
        shown = [f"`self.{called.proxies[port]}.{m}`" for m in methods.values()]
    else:
        shown = [f"`{called.handlers[port, o]}`" for o in port.interface.operations]
    what = f"{port.role} {literals.markdown_cell(port.interface.qualified)}"
    return literals.markdown_cell(port.name), what, ", ".join(shown)
