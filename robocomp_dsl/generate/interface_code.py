"""The interfaces of a component as Python source: their specs and proxies, and the whole module.

In: the ports of a component and the named types. Out: `InterfacesCode`, plain data for the
template of `generated/interfaces.py`.
"""

from __future__ import annotations

from collections import Counter
from collections.abc import Iterable, Iterator
from dataclasses import dataclass

from robocomp_dsl.generate import layout, literals, names
from robocomp_dsl.generate.layout import BODY, INNER, Group
from robocomp_dsl.generate.python_types import PythonTypes
from robocomp_dsl.generate.type_code import TypeCode, type_code
from robocomp_dsl.model.component import Port, Role
from robocomp_dsl.model.interface import Interface, Operation, Pattern
from robocomp_dsl.model.types import Enum, Struct

PROXY_MEMBERS = frozenset(("INTERFACE", "set_timeout", "wait_for_server"))
"""Public members of the base of all proxies."""


@dataclass(frozen=True, slots=True)
class MethodCode:
    """One operation of a proxy: its slot, the line that binds it, its definition."""

    slot: str
    bind: str
    definition: str
    doc: str
    statement: str


@dataclass(frozen=True, slots=True)
class FormCode:
    """`query`, `command` or `publish` of a proxy: one signature for each struct it takes."""

    overloads: tuple[str, ...]
    definition: str
    doc: str
    statements: tuple[str, ...]


@dataclass(frozen=True, slots=True)
class InterfaceCode:
    """One interface; `proxy` is empty where the component only serves it."""

    constant: str
    spec: str
    proxy: str = ""
    doc: str = ""
    slots: str = ""
    methods: tuple[MethodCode, ...] = ()
    forms: tuple[FormCode, ...] = ()


@dataclass(frozen=True, slots=True)
class InterfaceNames:
    """What the other generated modules call an interface."""

    constant: str
    proxy: str
    methods: dict[Operation, str]


def named(interfaces: Iterable[Interface], types: PythonTypes) -> dict[Interface, InterfaceNames]:
    """Names for the interfaces of a component, none of them that of a type."""
    wanted = list(interfaces)
    count = Counter(i.name for i in wanted)
    found = {}
    for one in wanted:
        name = f"{one.module}_{one.name}" if count[one.name] > 1 else one.name
        found[one] = InterfaceNames(
            types.scope.claim(name.upper()),
            types.scope.claim(f"{name}Proxy"),
            _method_names(one, types),
        )
    return found


def _method_names(interface: Interface, types: PythonTypes) -> dict[Operation, str]:
    reserved = PROXY_MEMBERS | names.ANNOTATION | set(types.names.values())
    called = names.unique([o.name for o in interface.operations], reserved)
    return dict(zip(interface.operations, called, strict=True))


def interface_code(
    interface: Interface, called: InterfaceNames, ports: Iterable[Port], types: PythonTypes
) -> InterfaceCode:
    """The spec of an interface, and a proxy if one of `ports` calls or publishes."""
    operations = [_operation(o, types) for o in interface.operations]
    spec = layout.call(
        "rt.Interface", literals.quoted(interface.qualified), layout.tuple_of(*operations)
    )
    stated = layout.statement(f"{called.constant} = ", spec)
    outgoing = [p for p in ports if p.role in (Role.REQUIRES, Role.PUBLISHES)]
    if not outgoing:
        return InterfaceCode(called.constant, stated)
    methods = tuple(_method(i, o, called, types) for i, o in enumerate(interface.operations))
    slots = sorted((m.slot.partition(":")[0] for m in methods), key=layout.natural)
    return InterfaceCode(
        called.constant,
        stated,
        called.proxy,
        literals.docstring(interface.doc, INNER, f"Calls {interface.qualified}."),
        layout.statement("__slots__ = ", layout.tuple_of(*map(literals.quoted, slots)), INNER),
        methods,
        tuple(_forms(interface, called, outgoing, types)),
    )


def _operation(one: Operation, types: PythonTypes) -> Group:
    inputs = [layout.tuple_of(literals.quoted(p.name), types.schema(p.type)) for p in one.inputs]
    outputs = [
        layout.tuple_of(literals.quoted(name), types.schema(type_))
        for name, type_ in types.results(one)
    ]
    throws = layout.tuple_of(*(types.names[t] for t in one.throws), head="throws=")
    return layout.call(
        "rt.Operation",
        literals.quoted(one.name),
        f"rt.Pattern.{one.pattern.name}",
        layout.tuple_of(*inputs, head="inputs="),
        layout.tuple_of(*outputs, head="outputs="),
        throws,
        f"idempotent={one.idempotent}",
    )


def _method(
    position: int, one: Operation, called: InterfaceNames, types: PythonTypes
) -> MethodCode:
    name = called.methods[one]
    slot = f"_call_{name}"
    returns = types.returns(one)
    hint = layout.subscript("Callable", "...", returns)
    arguments = types.arguments(one)
    made = layout.call(f"self.{slot}", *(a for a, _ in arguments))
    keyword = "" if returns == "None" else "return "
    parameters = ("self", *(f"{a}: {t}" for a, t in arguments))
    bound = layout.call("bind", f"{called.constant}.operations[{position}]")
    return MethodCode(
        layout.statement(f"{slot}: ", hint, INNER),
        layout.statement(f"self.{slot} = ", bound, BODY),
        layout.definition(name, parameters, returns),
        literals.docstring(one.doc, BODY) if literals.lines(one.doc) else "",
        layout.statement(keyword, made, BODY),
    )


def _forms(
    interface: Interface, called: InterfaceNames, ports: list[Port], types: PythonTypes
) -> Iterable[FormCode]:
    """The calls by request: `query(req)`, `command(req)`, `publish(req)`."""
    for form in (Pattern.QUERY, Pattern.COMMAND, Pattern.PUBLISH):
        takers = [
            o
            for o in interface.operations
            if len(o.inputs) == 1
            and isinstance(o.inputs[0].type, Struct)
            and any(p.pattern(o) is form for p in ports)
        ]
        count = Counter(o.inputs[0].type for o in takers)
        clear = [o for o in takers if count[o.inputs[0].type] == 1]
        if clear and form.value not in called.methods.values():
            yield _form(form.value, clear, called, types)


def _form(
    name: str, takers: list[Operation], called: InterfaceNames, types: PythonTypes
) -> FormCode:
    given = "request_" if "request" in types.scope.taken else "request"
    rows = [
        (types.annotation(o.inputs[0].type), types.returns(o), called.methods[o]) for o in takers
    ]
    listed = ", ".join(f"`{method}`" for _, _, method in rows)
    doc = literals.docstring(f"The operation that takes the request: {listed}.", BODY)
    if len(rows) == 1:
        taken, returns, method = rows[0]
        keyword = "" if returns == "None" else "return "
        body = layout.statement(keyword, layout.call(f"self.{method}", given), BODY)
        return FormCode(
            (), layout.definition(name, ("self", f"{given}: {taken}"), returns), doc, (body,)
        )
    overloads = tuple(
        layout.definition(name, ("self", f"{given}: {taken}"), returns)
        for taken, returns, _ in rows
    )
    statements = [
        f"if isinstance({given}, {taken}):\n{BODY}    return self.{method}({given})"
        for taken, _, method in rows
    ]
    failure = f'raise TypeError(f"no operation takes a {{type({given}).__name__}}")'
    general = layout.definition(name, ("self", f"{given}: Any"), "Any")
    return FormCode(overloads, general, doc, (*statements, failure))


@dataclass(frozen=True, slots=True)
class InterfacesCode:
    """The whole module; `sources` is empty or ` from A.idsl, B.idsl`."""

    sources: str
    exceptions: tuple[str, ...]
    standard_imports: tuple[str, ...]
    third_party_imports: tuple[str, ...]
    types: tuple[TypeCode, ...]
    interfaces: tuple[InterfaceCode, ...]


def interfaces_code(
    sources: Iterable[str],
    ports: Iterable[Port],
    called: dict[Interface, InterfaceNames],
    types: PythonTypes,
) -> InterfacesCode:
    """Everything that the template prints."""
    code = tuple(type_code(d, types) for d in types.ordered)
    specs = tuple(
        interface_code(i, n, [p for p in ports if p.interface is i], types)
        for i, n in called.items()
    )
    named_sources = ", ".join(sources)
    return InterfacesCode(
        f" from {literals.printable(named_sources)}" if named_sources else "",
        tuple(_exceptions(types)),
        tuple(_standard_imports(specs)),
        tuple(_third_party_imports(code, specs)),
        code,
        specs,
    )


def _exceptions(types: PythonTypes) -> Iterator[str]:
    """Rules of ruff that the IDSL files make us break."""
    enums = (d for d in types.ordered if isinstance(d, Enum))
    if any(len({e.value for e in one.enumerators}) < len(one.enumerators) for one in enums):
        yield "# Some values are equal in the IDSL file:"
        yield "# ruff: noqa: PIE796"


def _standard_imports(interfaces: tuple[InterfaceCode, ...]) -> Iterator[str]:
    methods = any(i.methods for i in interfaces)
    if methods:
        yield "from collections.abc import Callable"
    wanted = ["Any"] if methods else []
    wanted += ["overload"] if any(f.overloads for i in interfaces for f in i.forms) else []
    if wanted:
        yield f"from typing import {', '.join(wanted)}"


def _third_party_imports(
    types: tuple[TypeCode, ...], interfaces: tuple[InterfaceCode, ...]
) -> Iterator[str]:
    if any("np.zeros(0, " in line for t in types for line in t.statements):
        yield "import numpy as np"
    if types or interfaces:
        yield "from robocomp_dsl.runtime import types as rt"
