"""A running component as its schema describes it: ports, interfaces and types.

In: the replies to `getInfo` and `getInterfaces`. Out: `ComponentDescription`.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from typing import Any

from robocomp_dsl.runtime.component.component_interface import COMPONENT, ComponentInfo
from robocomp_dsl.runtime.component.interface import Interface
from robocomp_dsl.runtime.dynamic.build import build_interfaces, build_types
from robocomp_dsl.runtime.dynamic.schema_interface import (
    FieldInfo,
    InterfaceInfo,
    OperationInfo,
    Schema,
    TypeInfo,
)

COMPONENT_PORT = "Component"
"""The port that every component has."""


@dataclass(frozen=True, slots=True)
class DescribedPort:
    """A port. `role`: implements, requires, publishes or subscribesTo; `info` has units and docs.

    `peers` are the components that a required or subscribing port is connected to.
    """

    name: str
    role: str
    interface: Interface
    info: InterfaceInfo
    peers: tuple[str, ...] = ()

    def operation_info(self, name: str) -> OperationInfo:
        """Docs and units of an operation. Raises `KeyError`."""
        return {operation.name: operation for operation in self.info.operations}[name]


@dataclass(frozen=True, slots=True)
class ComponentDescription:
    """A component: its ports in order, its types and their documentation by qualified name."""

    name: str
    info: ComponentInfo
    ports: tuple[DescribedPort, ...]
    types: Mapping[str, type[Any]]
    type_infos: Mapping[str, TypeInfo]

    def port(self, name: str, *roles: str) -> DescribedPort:
        """The port called `name`, with one of `roles` if any are given. Raises `KeyError`."""
        for port in self.ports:
            if port.name == name and (not roles or port.role in roles):
                return port
        raise KeyError(name)

    def field_info(self, type_name: str, field: str) -> FieldInfo | None:
        """Unit and doc of a field of a struct; None if there is none."""
        info = self.type_infos.get(type_name)
        return next((f for f in info.fields if f.name == field), None) if info else None


def describe_component(info: ComponentInfo, schema: Schema) -> ComponentDescription:
    """Join both replies of one component. Raises `SchemaError` for an invalid schema."""
    types = build_types(schema)
    interfaces = build_interfaces(schema, types)
    infos = {interface.name: interface for interface in schema.interfaces}
    ports = [
        DescribedPort(
            port.name,
            port.role,
            interfaces[port.declared],
            infos[port.declared],
            tuple(port.peers),
        )
        for port in info.ports
        if port.declared in interfaces
    ]
    if COMPONENT.name in interfaces:
        name = COMPONENT.name
        ports.append(DescribedPort(COMPONENT_PORT, "implements", interfaces[name], infos[name]))
    return ComponentDescription(
        info.name, info, tuple(ports), types, {type_.name: type_ for type_ in schema.types}
    )
