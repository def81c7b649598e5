"""Interfaces from a schema: the same classes and codec that generated code has.

In: a `Schema` of a running component. Out: `Interface` objects by name. A peer may send anything:
what is no valid schema raises `SchemaError`, and the type hash must agree.
"""

from __future__ import annotations

import json
import re
from collections.abc import Iterable, Mapping
from typing import Any

from robocomp_dsl.runtime.component.interface import Interface, Operation, Pattern
from robocomp_dsl.runtime.data.arrays import StructArray
from robocomp_dsl.runtime.data.schema import Array, Dictionary, Enum, Primitive, Sequence, Type
from robocomp_dsl.runtime.data.struct import Struct, StructMeta, default
from robocomp_dsl.runtime.dynamic.python_names import (
    ENUM_MEMBERS,
    ERROR_MEMBERS,
    STRUCT_MEMBERS,
    unique_names,
)
from robocomp_dsl.runtime.dynamic.schema_interface import (
    FieldInfo,
    InterfaceInfo,
    OperationInfo,
    Schema,
    TypeInfo,
)
from robocomp_dsl.runtime.dynamic.type_expressions import parse_type
from robocomp_dsl.runtime.errors import DeclaredError, SchemaError

MAX_LEAVES = 100_000
"""Maximum fields of a type with those of nested types; each is code in a compiled codec."""
NUMBERS_PER_LEAF = 100
"""Numbers of a fixed array that count as one field."""
_NAME = re.compile(r"[A-Za-z_][A-Za-z0-9_]{0,199}")
_QUALIFIED = re.compile(
    r"[A-Za-z_][A-Za-z0-9_]{0,199}(::[A-Za-z_][A-Za-z0-9_]{0,199}|(/[A-Za-z_][A-Za-z0-9_]{0,199}){2})?"
)
_BRACKETS = re.compile(r"[\[\]{}<>,\n]")
_ROS_NAME = re.compile(r"\w+/\w+/\w+")
_ZEROS = {"bool": False, "string": "", "float": 0.0, "double": 0.0}  # others: 0


def build_types(schema: Schema) -> Mapping[str, type[Any]]:
    """The enums, structs and exceptions of `schema` by qualified name. Raises `SchemaError`."""
    builder = _TypeBuilder()
    for info in schema.types:
        builder.add(info)
    return builder.types


def build_interfaces(schema: Schema, types: Mapping[str, type[Any]]) -> dict[str, Interface]:
    """The interfaces of `schema` by qualified name; `types` as of `build_types`.

    Raises `SchemaError`.
    """
    builder = _TypeBuilder(types)
    return {info.name: _interface(info, builder) for info in schema.interfaces}


class _TypeBuilder:
    """The named types so far."""

    def __init__(self, types: Mapping[str, type[Any]] | None = None) -> None:
        self.types = dict(types or {})
        self._leaves: dict[type[Any], int] = {}

    def add(self, info: TypeInfo) -> None:
        """Build one type; it may refer to those before it."""
        _check_name(info.name, _QUALIFIED, "type")
        if info.name in self.types:
            raise SchemaError(f"type `{info.name}` is defined twice")
        if info.kind == "enum":
            cls: type[Any] = _enum(info)
        elif info.kind in ("struct", "exception"):
            cls = self._struct(info)
        else:
            raise SchemaError(f"type `{info.name}` has the unknown kind `{info.kind:.40}`")
        if self.leaves(cls) > MAX_LEAVES:
            raise SchemaError(f"type `{info.name}` has more than {MAX_LEAVES} fields")
        self.types[info.name] = cls

    def leaves(self, type_: Type) -> int:
        """Fields of a value, counting one element of each sequence without a fixed size."""
        match type_:
            case Primitive():
                return 1
            case Array():
                return 1 + type_.size // NUMBERS_PER_LEAF
            case Sequence():
                return self.leaves(type_.element) * (type_.size or 1)
            case Dictionary():
                return self.leaves(type_.key) + self.leaves(type_.value)
        if issubclass(type_, StructArray):
            return self.leaves(type_._element_)
        if type_ not in self._leaves:
            fields = getattr(type_, "_fields_", None)
            count = 1 if fields is None else sum(self.leaves(inner) for _, inner in fields)
            self._leaves[type_] = count
        return self._leaves[type_]

    def _struct(self, info: TypeInfo) -> type[Struct]:
        is_exception = info.kind == "exception"
        base = DeclaredError if is_exception else Struct
        reserved = ERROR_MEMBERS if is_exception else STRUCT_MEMBERS
        pairs = self.fields(info.fields, info.name)
        names = unique_names([name for name, _ in pairs], reserved)
        members: dict[str, Any] = {
            "__annotations__": {n: type_ for n, (_, type_) in zip(names, pairs, strict=True)},
            "__module__": __name__,
            "__doc__": info.doc or f"{info.name}.",
        }
        for name, (_, type_), field in zip(names, pairs, info.fields, strict=True):
            members[name] = _default(type_, field, info.name)
        rename = {n: wire for n, (wire, _) in zip(names, pairs, strict=True) if n != wire}
        cls: Any = StructMeta(
            _short(info.name),
            (base,),
            members,
            type_id=info.name,
            rename=rename,
            units=_units(info.fields, info.name),
        )
        built: type[Struct] = cls
        return built

    def fields(self, infos: Iterable[FieldInfo], inside: str) -> list[tuple[str, Type]]:
        """Names and types of fields or parameters."""
        found: dict[str, Type] = {}
        for info in infos:
            _check_name(info.name, _NAME, f"field of `{inside}`")
            if info.name in found:
                raise SchemaError(f"`{inside}` has two fields `{info.name}`")
            found[info.name] = self.type(info, inside)
        return list(found.items())

    def type(self, info: FieldInfo, inside: str) -> Type:
        """The type of a field. `inside` is for messages."""
        try:
            return parse_type(info.type, self.types)
        except SchemaError as error:
            raise SchemaError(f"field `{info.name}` of `{inside}`: {error}") from None


def _enum(info: TypeInfo) -> type[Enum]:
    for enumerator in info.enumerators:
        _check_name(enumerator.name, _NAME, f"enumerator of `{info.name}`")
    names = unique_names([e.name for e in info.enumerators], ENUM_MEMBERS)
    if not names:
        raise SchemaError(f"enum `{info.name}` has no enumerators")
    values = {name: e.value for name, e in zip(names, info.enumerators, strict=True)}
    create: Any = Enum  # the type checker knows only the members' constructor
    cls: type[Enum] = create(_short(info.name), values, module=__name__)
    return cls


def _default(type_: Type, info: FieldInfo, inside: str) -> object:
    """What a field has that is not given."""
    value: Any = None
    if info.defaultValue:
        try:
            value = json.loads(info.defaultValue)
        except (ValueError, RecursionError):
            raise SchemaError(
                f"field `{info.name}` of `{inside}`: the default is not JSON"
            ) from None
    if isinstance(type_, Primitive):
        zero = _ZEROS.get(type_.name, 0)
        return value if type(value) is type(zero) else zero
    if not (isinstance(type_, type) and issubclass(type_, Enum)):
        return default()
    members = {name.rstrip("_"): member for name, member in type_.__members__.items()}
    zero_member = next((e for e in members.values() if e == 0), next(iter(type_)))
    return members.get(value, zero_member) if isinstance(value, str) else zero_member


def _interface(info: InterfaceInfo, types: _TypeBuilder) -> Interface:
    _check_name(info.name, _QUALIFIED, "interface")
    operations = [_operation(each, info.name, types) for each in info.operations]
    if len({operation.name for operation in operations}) < len(operations):
        raise SchemaError(f"interface `{info.name}` has two operations of one name")
    interface = Interface(info.name, *operations)
    if interface.hash.hex() != info.hash:
        raise SchemaError(
            f"interface `{info.name}` does not have the type hash that the component states"
            f" ({interface.hash.hex()}, not {info.hash:.16}); update both to the same version"
        )
    return interface


def _operation(info: OperationInfo, inside: str, types: _TypeBuilder) -> Operation:
    _check_name(info.name, _NAME, f"operation of `{inside}`")
    full_name = f"{inside}.{info.name}"
    if info.pattern not in list(Pattern):
        raise SchemaError(f"`{full_name}` has the unknown pattern `{info.pattern:.40}`")
    first, rest = info.outputs[:1], info.outputs[1:]
    has_result = bool(first) and not first[0].name
    throws = []
    for name in info.throws:
        cls = types.types.get(name)
        if cls is None or not issubclass(cls, DeclaredError):
            raise SchemaError(f"`{full_name}` throws `{name:.80}`, which is not an exception")
        throws.append(cls)
    operation = Operation(
        info.name,
        Pattern(info.pattern),
        types.fields(info.inputs, full_name),
        types.fields(rest if has_result else info.outputs, full_name),
        tuple(throws),
        returns=types.type(first[0], full_name) if has_result else None,
        idempotent=info.idempotent,
        units=_units((*info.inputs, *info.outputs), full_name),
    )
    leaves = sum(types.leaves(type_) for _, type_ in (*operation.inputs, *operation.outputs))
    if leaves > MAX_LEAVES:
        raise SchemaError(f"`{full_name}` has more than {MAX_LEAVES} fields")
    return operation


def _units(infos: Iterable[FieldInfo], inside: str) -> dict[str, str]:
    """The units of fields or parameters by name. ROS types have none in their shape."""
    units = {info.name: info.unit for info in infos if info.unit}
    for name, unit in units.items():
        if _BRACKETS.search(unit):
            raise SchemaError(f"field `{name}` of `{inside}`: `{unit:.40}` is not a unit")
    return {} if _ROS_NAME.fullmatch(inside) else units


def _check_name(name: str, form: re.Pattern[str], what: str) -> None:
    if not form.fullmatch(name):
        raise SchemaError(f"`{name:.80}` is not a valid name of a {what}")


def _short(qualified: str) -> str:
    return re.split("::|/", qualified)[-1]
