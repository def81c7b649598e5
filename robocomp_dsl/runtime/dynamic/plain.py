"""Values of any type as plain data: dict, list, str, int, float and bool, for JSON, YAML and CSV.

In: a type and a value of it. Out: plain data with the names of the IDSL file. An enumerator is its
name; a dictionary is a dict, or a list of `key` and `value` if its key is a struct.
"""

from __future__ import annotations

from typing import Any

import numpy as np

from robocomp_dsl.runtime.component.interface import Operation
from robocomp_dsl.runtime.data.arrays import StructArray
from robocomp_dsl.runtime.data.schema import (
    DOUBLE,
    FLOAT,
    Array,
    Dictionary,
    Enum,
    Fields,
    Primitive,
    Sequence,
    Type,
)
from robocomp_dsl.runtime.data.struct import Struct

_MAX_SHORTENED = 4096
"""Longer float arrays keep the digits of the conversion to double, which is faster."""


def to_plain(type_: Type, value: Any) -> Any:
    """`value` as plain data. A float has as few digits as identify it."""
    match type_:
        case Primitive():
            return _number(type_, value)
        case Array():
            return _array(type_, value)
        case Sequence():
            return [to_plain(type_.element, item) for item in value]
        case Dictionary():
            return _dictionary(type_, value)
    return _declared(type_, value)


def _declared(type_: type[Any], value: Any) -> Any:
    if issubclass(type_, StructArray):
        return [struct_to_plain(item) for item in value]
    if issubclass(type_, Enum):
        return type_(value).name.rstrip("_")
    return struct_to_plain(value)


def struct_to_plain(value: Struct) -> dict[str, Any]:
    """A struct or an exception as a dict by field names."""
    pairs = zip(value._names_, value._fields_, strict=True)
    return {name: to_plain(type_, getattr(value, attribute)) for attribute, (name, type_) in pairs}


def fields_to_plain(fields: Fields, values: tuple[Any, ...]) -> dict[str, Any]:
    """Parameters of an operation as a dict; the result has the name `return`."""
    pairs = zip(fields, values, strict=True)
    return {name or "return": to_plain(type_, value) for (name, type_), value in pairs}


def result_to_plain(operation: Operation, result: Any) -> Any:
    """What a call returned: None, the only output, or a dict of several."""
    if len(operation.outputs) > 1:
        return fields_to_plain(operation.outputs, result)
    return to_plain(operation.outputs[0][1], result) if operation.outputs else None


def _number(type_: Primitive, value: Any) -> Any:
    if type_ is FLOAT:
        return float(str(np.float32(value)))
    if type_ is DOUBLE:
        return float(value)
    return value


def _array(type_: Array, value: Any) -> list[Any]:
    if type_.element is FLOAT and len(value) <= _MAX_SHORTENED:
        return [float(str(item)) for item in value]
    items: list[Any] = value.tolist()
    return items


def _dictionary(type_: Dictionary, value: dict[Any, Any]) -> Any:
    items = [(to_plain(type_.key, k), to_plain(type_.value, v)) for k, v in value.items()]
    if isinstance(type_.key, type) and issubclass(type_.key, Struct):
        return [{"key": key, "value": item} for key, item in items]
    return dict(items)
