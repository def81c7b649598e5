"""What `generated/genericworker.py`, `specificworker.py` and `README.md` say of a component.

In: the component, its named types and interfaces. Out: plain data for the templates.
"""

from __future__ import annotations

from robocomp_dsl.generate import docs, layout, literals, names
from robocomp_dsl.generate.component_names import SERVED, Called
from robocomp_dsl.generate.layout import BODY, INNER, Group, Item, definition
from robocomp_dsl.generate.machine_code import MachineCode, machine_code
from robocomp_dsl.generate.worker_imports import generic_imports, specific_imports
from robocomp_dsl.model.component import Component, Port, Role
from robocomp_dsl.model.interface import Operation, Pattern
from robocomp_dsl.record import Value

_LISTS = {
    Role.IMPLEMENTS: "implements",
    Role.REQUIRES: "requires",
    Role.PUBLISHES: "publishes",
    Role.SUBSCRIBES: "subscribes",
}


class HandlerCode(Value):
    """One method that others call. `refusal` is its body in `GenericWorker`; `call` reaches it.

    `call` is empty where nobody waits for an answer.
    """

    definition: str
    doc: str
    refusal: str
    call: str


class ServedCode(Value):
    """One port that others call: `implements RoboCompLaser::Laser`, and its methods."""

    title: str
    handlers: tuple[HandlerCode, ...]


class WorkerCode(Value):
    """Both classes and what is said of the component as a whole.

    `called` declares the proxies; `about` and `rows` are for the README.
    """

    title: str
    source: str
    doc: str
    spec: str
    params: str
    period: int
    served: tuple[ServedCode, ...]
    called: tuple[str, ...]
    generic_imports: tuple[str, ...]
    specific_imports: tuple[str, ...]
    examples: tuple[str, ...]
    about: tuple[str, ...]
    rows: tuple[tuple[str, str, str], ...]
    machine: MachineCode | None


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
            layout.assignment(
                called.proxies[p], called.interfaces[p.interface].proxy, INNER, sign=": "
            )
            for p in proxies
        ),
        generic_imports=tuple(generic_imports(component, called)),
        specific_imports=tuple(specific_imports(called)),
        examples=tuple(_example(p, called) for p in proxies if p.interface.operations),
        about=("", *about) if (about := literals.lines(component.doc)) else (),
        rows=tuple(_row(p, called) for p in component.ports),
        machine=machine_of(component),
    )


def machine_of(component: Component) -> MachineCode | None:
    """Its state machine, if it has one."""
    given = component.statemachine
    return machine_code(given.machine) if given and given.machine else None


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
        *(["machine=MACHINE"] if component.statemachine else []),
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
    handlers = tuple(handler_code(port, o, called) for o in port.interface.operations)
    return ServedCode(f"{port.role} {port.interface.qualified}", handlers)


def handler_code(port: Port, one: Operation, called: Called) -> HandlerCode:
    """One method, as both classes and a stub print it."""
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
        literals.docstring(docs.of_operation(one, called.types, port.interface.qualified), BODY),
        layout.statement("raise ", refused, BODY),
        layout.statement(keyword, above, BODY) if answers else "",
    )


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
