"""The content of `genericworker.py`, `specificworker.py` and `README.md`.

In: the component, its named types and interfaces. Out: plain data for the templates.
"""

from __future__ import annotations

from robocomp_dsl.generate import docs, literals, names
from robocomp_dsl.generate.python.component_names import SERVED_ROLES, PythonNames
from robocomp_dsl.generate.python.layout import BODY, INNER
from robocomp_dsl.generate.python.line_breaking import one_statement
from robocomp_dsl.generate.python.machine_code import MachineCode, machine_code
from robocomp_dsl.generate.python.worker_imports import generic_imports, specific_imports
from robocomp_dsl.model.component import Component, Port, Role
from robocomp_dsl.model.interface import Operation, Pattern
from robocomp_dsl.record import ValueRecord

_LISTS = {
    Role.IMPLEMENTS: "implements",
    Role.REQUIRES: "requires",
    Role.PUBLISHES: "publishes",
    Role.SUBSCRIBES: "subscribes",
}


class HandlerCode(ValueRecord):
    """One method that other components call. `answers`: the caller waits for the result."""

    name: str
    parameters: str
    returns: str
    doc: str
    arguments: str
    answers: bool

    @property
    def definition(self) -> str:
        """The method's head, indented as in a class."""
        return one_statement(f"def {self.name}({self.parameters}) -> {self.returns}:", INNER)

    @property
    def call(self) -> str:
        """The arguments for the method of `GenericWorker`; empty if no caller waits."""
        if not self.answers:
            return ""
        keyword = "" if self.returns == "None" else "return "
        return one_statement(f"{keyword}super().{self.name}({self.arguments})", BODY)


class ServedCode(ValueRecord):
    """One served port, `implements RoboCompLaser::Laser`, and its methods."""

    title: str
    handlers: tuple[HandlerCode, ...]


class PortCode(ValueRecord):
    """One port in the specification. `target` is the interface, or the proxy class.

    `methods` are operations and methods of a served port; `attribute` is the proxy's attribute;
    `middlewares` is a tuple as code, or empty.
    """

    name: str
    target: str
    methods: str
    attribute: str
    middlewares: str


class WorkerCode(ValueRecord):
    """Both classes and the component's own data.

    `ports` are lists by keyword of `ComponentSpec`, `called` has the proxies' attributes and
    classes; `watchdog` is a literal in s, empty for none; `about` and `rows` are for the README;
    `window` is the class of Qt that the worker extends, empty without a window.
    """

    title: str
    source: str
    package: str
    doc: str
    period: int
    threads: int
    watchdog: str
    middleware: str
    ports: tuple[tuple[str, tuple[PortCode, ...]], ...]
    params: str
    served: tuple[ServedCode, ...]
    proxies: tuple[tuple[str, str], ...]
    generic_imports: tuple[str, ...]
    specific_imports: tuple[str, ...]
    examples: tuple[str, ...]
    about: tuple[str, ...]
    rows: tuple[tuple[str, str, str], ...]
    machine: MachineCode | None
    window: str


def worker_code(component: Component, py_names: PythonNames, middleware: str) -> WorkerCode:
    """The data of the worker's templates."""
    served = tuple(_served(p, py_names) for p in component.ports if p.role in SERVED_ROLES)
    proxies = [p for p in component.ports if p.role not in SERVED_ROLES]
    ports = {
        key: tuple(_port(p, py_names) for p in component.with_role(role))
        for role, key in _LISTS.items()
    }
    return WorkerCode(
        title=component.name,
        source=component.path.name,
        package=py_names.package,
        doc=literals.docstring(component.doc, INNER, f"The component {component.name}."),
        period=component.period,
        threads=component.threads,
        watchdog=f"{component.watchdog_s:g}" if component.watchdog_s else "",
        middleware=middleware,
        ports=tuple((key, own) for key, own in ports.items() if own),
        params=py_names.params,
        served=served,
        proxies=tuple(
            (py_names.proxies[p], py_names.interfaces[p.interface].proxy) for p in proxies
        ),
        generic_imports=tuple(generic_imports(component, py_names)),
        specific_imports=tuple(specific_imports(py_names, py_names.package)),
        examples=tuple(_example(p, py_names) for p in proxies if p.operations),
        about=("", *about) if (about := literals.lines(component.doc)) else (),
        rows=tuple(_row(p, py_names) for p in component.ports),
        machine=machine_of(component),
        window=component.gui,
    )


def machine_of(component: Component) -> MachineCode | None:
    """The component's state machine, if any."""
    reference = component.statemachine
    return machine_code(reference.machine) if reference and reference.machine else None


def _port(port: Port, py_names: PythonNames) -> PortCode:
    interface = py_names.interfaces[port.interface]
    name = literals.quoted(port.name)
    marks = [literals.quoted(mark) for mark in port.middlewares]
    middlewares = f"({', '.join(marks)}{',' * (len(marks) == 1)})" if marks else ""
    if port in py_names.proxies:
        attribute = literals.quoted(py_names.proxies[port])
        return PortCode(name, interface.proxy, "", attribute, middlewares)
    methods = ", ".join(
        f"{literals.quoted(o.name)}: {literals.quoted(py_names.handlers[port, o])}"
        for o in port.operations
    )
    return PortCode(name, interface.constant, f"{{{methods}}}", "", middlewares)


def _served(port: Port, py_names: PythonNames) -> ServedCode:
    handlers = tuple(handler_code(port, o, py_names) for o in port.operations)
    return ServedCode(f"{port.role} {port.interface.qualified}", handlers)


def handler_code(port: Port, operation: Operation, py_names: PythonNames) -> HandlerCode:
    """One method for both classes and for stubs."""
    arguments = py_names.types.arguments(operation)
    return HandlerCode(
        py_names.handlers[port, operation],
        ", ".join(["self", *(f"{a}: {t}" for a, t in arguments)]),
        py_names.types.returns(operation),
        literals.docstring(
            docs.of_operation(operation, py_names.types, port.interface.qualified), BODY
        ),
        ", ".join(a for a, _ in arguments),
        port.pattern(operation) is Pattern.QUERY,
    )


def _example(port: Port, py_names: PythonNames) -> str:
    """An example call of the first operation, with zero values."""
    operation = port.operations[0]
    method = py_names.interfaces[port.interface].methods[operation]
    arguments = ", ".join(py_names.types.zero(p.type).text for p in operation.inputs)
    results = [name or "result" for name, _ in py_names.types.results(operation)]
    target = f"{', '.join(names.unique(results))} = " if results else ""
    return f"{target}self.{py_names.proxies[port]}.{method}({arguments})"


def _row(port: Port, py_names: PythonNames) -> tuple[str, str, str]:
    """One row of the port table in the README: port, description, methods."""
    if port in py_names.proxies:
        methods = py_names.interfaces[port.interface].methods
        shown = [f"`self.{py_names.proxies[port]}.{methods[o]}`" for o in port.operations]
    else:
        shown = [f"`{py_names.handlers[port, o]}`" for o in port.operations]
    what = f"{port.role} {literals.markdown_cell(port.interface.qualified)}"
    return literals.markdown_cell(port.name), what, ", ".join(shown)
