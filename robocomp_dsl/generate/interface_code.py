"""The interfaces of a component as Python source: their specs and proxies, and the whole module.

In: the ports of a component and the named types. Out: `InterfacesCode`, plain data for the
template of `generated/interfaces.py`.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator

from robocomp_dsl.generate import layout, literals
from robocomp_dsl.generate.component_names import InterfaceNames
from robocomp_dsl.generate.layout import INNER, Group
from robocomp_dsl.generate.proxy_code import FormCode, MethodCode, form_codes, method_code
from robocomp_dsl.generate.python_types import PythonTypes
from robocomp_dsl.generate.type_code import TypeCode, type_code
from robocomp_dsl.model.component import Port, Role
from robocomp_dsl.model.interface import Interface, Operation
from robocomp_dsl.model.types import Enum
from robocomp_dsl.record import Value


class InterfaceCode(Value):
    """One interface; `proxy` is empty where the component only serves it."""

    constant: str
    spec: str
    proxy: str = ""
    head: str = ""
    doc: str = ""
    slots: str = ""
    methods: tuple[MethodCode, ...] = ()
    forms: tuple[FormCode, ...] = ()


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
    methods = tuple(method_code(i, o, called, types) for i, o in enumerate(interface.operations))
    slots = sorted((m.slot.partition(":")[0] for m in methods), key=layout.natural)
    return InterfaceCode(
        called.constant,
        stated,
        called.proxy,
        layout.class_head(called.proxy, "rt.Proxy"),
        literals.docstring(interface.doc, INNER, f"Calls {interface.qualified}."),
        layout.statement("__slots__ = ", layout.tuple_of(*map(literals.quoted, slots)), INNER),
        methods,
        tuple(form_codes(interface, called, outgoing, types)),
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


class InterfacesCode(Value):
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
