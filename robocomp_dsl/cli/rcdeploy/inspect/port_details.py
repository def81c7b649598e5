"""One port in full: operations, and the types that they use. In: a port. Out: lines, or data."""

from __future__ import annotations

import re
from collections.abc import Iterable, Iterator
from typing import Any

from robocomp_dsl.cli.rcdeploy.inspect.type_names import signature
from robocomp_dsl.client import ComponentDescription, DescribedPort, struct_to_plain
from robocomp_dsl.runtime.dynamic.schema_interface import FieldInfo, InterfaceInfo, TypeInfo


def describe_port(component: ComponentDescription, port: DescribedPort) -> Iterator[str]:
    """Operations with their signatures, and the fields of their types with units and docs."""
    peers = f", connected to {', '.join(port.peers)}" if port.peers else ""
    yield f"{component.name}.{port.name}: {port.role} {port.interface.name}{peers}"
    yield from _doc(port.info.doc, "  ")
    for operation in port.info.operations:
        yield f"  [{operation.pattern}] {signature(operation)}"
        yield from _doc(operation.doc, "      ")
    for info in used_types(component, port.info):
        yield ""
        yield f"  {info.kind} {info.name}"
        yield from _doc(info.doc, "      ")
        for field in info.fields:
            yield f"    {_field(field)}"
        for value in info.enumerators:
            doc = f"  # {' '.join(value.doc.split())}" if value.doc else ""
            yield f"    {value.name} = {value.value}{doc}"


def _field(field: FieldInfo) -> str:
    unit = f" [{field.unit}]" if field.unit else ""
    default = f" = {field.defaultValue}" if field.defaultValue else ""
    doc = f"  # {' '.join(field.doc.split())}" if field.doc else ""
    return f"{field.type} {field.name}{default}{unit}{doc}"


def _doc(text: str, indentation: str) -> Iterator[str]:
    yield from (f"{indentation}{line.strip()}" for line in text.splitlines() if line.strip())


def used_types(component: ComponentDescription, interface: InterfaceInfo) -> list[TypeInfo]:
    """The types that an interface uses, directly or not, each after those that it uses."""
    used: set[str] = set()
    for operation in interface.operations:
        used |= {*operation.throws}
        for info in (*operation.inputs, *operation.outputs):
            used |= _names(info.type)
    for type_ in reversed(list(component.type_infos.values())):
        if type_.name in used:
            for field in type_.fields:
                used |= _names(field.type)
    return [type_ for type_ in component.type_infos.values() if type_.name in used]


def _names(expression: str) -> set[str]:
    return set(re.findall(r"[\w:]+", expression))


def port_data(component: ComponentDescription, ports: Iterable[DescribedPort]) -> dict[str, Any]:
    """Component, ports and types as plain data."""
    listed = list(ports)
    types = {t.name: t for port in listed for t in used_types(component, port.info)}
    return {
        "component": component.name,
        "ports": [
            {
                "name": port.name,
                "role": port.role,
                "peers": list(port.peers),
                "interface": struct_to_plain(port.info),
            }
            for port in listed
        ],
        "types": [struct_to_plain(type_) for type_ in types.values()],
    }
