"""The schema of interfaces, from the types that the codec uses.

In: interfaces of generated code, and their documentation. Out: `Schema`, as `getInterfaces` returns
it. Types are listed after those that they use.
"""

from __future__ import annotations

import json
from collections.abc import Iterable, Iterator
from typing import Any

from robocomp_dsl.runtime.component.interface import Interface, Operation
from robocomp_dsl.runtime.data.arrays import StructArray
from robocomp_dsl.runtime.data.schema import Array, Dictionary, Enum, Primitive, Sequence, Type
from robocomp_dsl.runtime.data.struct import Struct
from robocomp_dsl.runtime.data.type_hash import sequence_shape, type_shape
from robocomp_dsl.runtime.dynamic.documentation import Documentation
from robocomp_dsl.runtime.dynamic.schema_interface import (
    EnumeratorInfo,
    FieldInfo,
    InterfaceInfo,
    OperationInfo,
    Schema,
    TypeInfo,
)
from robocomp_dsl.runtime.errors import DeclaredError


def describe_interfaces(
    interfaces: Iterable[Interface], documentation: Documentation | None = None
) -> Schema:
    """The schema of `interfaces`; an interface that occurs twice is listed once."""
    types = _TypeTable(documentation or Documentation())
    by_name = {interface.name: interface for interface in interfaces}
    described = [_interface(interface, types) for interface in by_name.values()]
    return Schema(types.infos, described)


class _TypeTable:
    """The named types of a schema, each with a name of its own."""

    def __init__(self, documentation: Documentation) -> None:
        self.documentation = documentation
        self.infos: list[TypeInfo] = []
        self._names: dict[type[Any], str] = {}
        self._taken: set[str] = set()

    def expression(self, type_: Type) -> str:
        """`double`, `sequence<M::T>` and so on."""
        match type_:
            case Primitive():
                return type_shape(type_)
            case Array() | Sequence():
                return sequence_shape(type_, self.expression(type_.element))
            case Dictionary():
                return f"dictionary<{self.expression(type_.key)},{self.expression(type_.value)}>"
        if issubclass(type_, StructArray):
            return f"sequence<{self.name(type_._element_)}>"
        return self.name(type_)

    def name(self, cls: type[Any]) -> str:
        """The name of an enum, a struct or an exception, which is listed from now on."""
        if cls not in self._names:
            texts = self.documentation.of_type(cls)
            info = _enum(cls, texts) if issubclass(cls, Enum) else self._struct(cls, texts)
            name = getattr(cls, "_type_id_", "") or texts.get("name", cls.__name__)
            info.name = self._unused(str(name))
            self._names[cls] = info.name
            self.infos.append(info)
        return self._names[cls]

    def _unused(self, name: str) -> str:
        unused, number = name, 2
        while unused in self._taken:
            unused, number = f"{name}_{number}", number + 1
        self._taken.add(unused)
        return unused

    def _struct(self, cls: type[Struct], texts: Any) -> TypeInfo:
        kind = "exception" if issubclass(cls, DeclaredError) else "struct"
        about = texts.get("fields", {})
        is_ros = "/" in cls._type_id_  # the type hash covers the units of other types
        fields = [
            FieldInfo(
                name,
                self.expression(type_),
                cls._units_.get(name, "")
                or (about.get(name, {}).get("unit", "") if is_ros else ""),
                about.get(name, {}).get("doc", ""),
                _default(cls._defaults_.get(attribute)),
            )
            for attribute, (name, type_) in zip(cls._names_, cls._fields_, strict=True)
        ]
        return TypeInfo("", kind, texts.get("doc", ""), fields)

    def parameters(self, fields: Iterable[tuple[str, Type]], units: Any) -> list[FieldInfo]:
        """Inputs or outputs of an operation."""
        return [
            FieldInfo(name, self.expression(type_), units.get(name, "")) for name, type_ in fields
        ]


def _enum(cls: type[Enum], texts: Any) -> TypeInfo:
    about = texts.get("values", {})
    enumerators = [
        EnumeratorInfo(name, value, about.get(name, "")) for name, value in enumerator_names(cls)
    ]
    return TypeInfo("", "enum", texts.get("doc", ""), [], enumerators)


def enumerator_names(cls: type[Enum]) -> Iterator[tuple[str, int]]:
    """Names as in the IDSL file, and values. Python adds an underscore to some names."""
    for name, enumerator in cls.__members__.items():
        yield name.rstrip("_") or name, enumerator.value


def _default(value: object) -> str:
    """A default as JSON; empty for zero and for what is made anew each time."""
    if isinstance(value, Enum):
        value = value.name.rstrip("_")
    is_literal = isinstance(value, bool | int | float | str)
    return json.dumps(value) if is_literal and value else ""


def _interface(interface: Interface, types: _TypeTable) -> InterfaceInfo:
    texts = types.documentation.of_interface(interface.name)
    about = texts.get("operations", {})
    return InterfaceInfo(
        interface.name,
        interface.hash.hex(),
        texts.get("doc", ""),
        [_operation(each, about.get(each.name, {}), types) for each in interface.operations],
    )


def _operation(operation: Operation, texts: Any, types: _TypeTable) -> OperationInfo:
    return OperationInfo(
        operation.name,
        operation.pattern.value,
        operation.idempotent,
        texts.get("doc", ""),
        types.parameters(operation.inputs, operation.units),
        types.parameters(operation.outputs, operation.units),
        [types.name(throw) for throw in operation.throws],
    )
