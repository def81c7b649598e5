"""An example of a value of a type, as a user would type it. In: a type. Out: YAML on one line."""

from __future__ import annotations

from typing import Any

from robocomp_dsl.runtime.data.arrays import StructArray
from robocomp_dsl.runtime.data.schema import (
    BOOL,
    DOUBLE,
    FLOAT,
    Array,
    Dictionary,
    Enum,
    Primitive,
    Sequence,
    Type,
)
from robocomp_dsl.runtime.data.struct import Struct

_EXAMPLES = {BOOL: "true", FLOAT: "0.5", DOUBLE: "0.5"}  # others: 1
_MAX_DEPTH = 4
_MAX_FIELDS = 6


def example(type_: Type, depth: int = _MAX_DEPTH) -> str:
    """`{x: 0.5, names: [text]}`; `…` where it would be too long."""
    if not depth:
        return "…"
    match type_:
        case Primitive():
            return "text" if type_.is_text else _EXAMPLES.get(type_, "1")
        case Array() | Sequence():
            element = example(type_.element, depth - 1)
            shown = [element] * min(type_.size or 1, _MAX_FIELDS)
            return f"[{', '.join([*shown, *(['…'] if type_.size > _MAX_FIELDS else [])])}]"
        case Dictionary():
            key, value = example(type_.key, depth - 1), example(type_.value, depth - 1)
            if isinstance(type_.key, type) and issubclass(type_.key, Struct):
                return f"[{{key: {key}, value: {value}}}]"
            return f"{{{key}: {value}}}"
    return _declared(type_, depth)


def _declared(type_: type[Any], depth: int) -> str:
    if issubclass(type_, StructArray):
        return f"[{example(type_._element_, depth - 1)}]"
    if issubclass(type_, Enum):
        return next(iter(type_)).name.rstrip("_")
    fields = [f"{name}: {example(inner, depth - 1)}" for name, inner in type_._fields_]
    if len(fields) > _MAX_FIELDS:
        fields = [*fields[:_MAX_FIELDS], "…"]
    return f"{{{', '.join(fields)}}}"
