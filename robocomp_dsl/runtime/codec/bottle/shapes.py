"""The shape of a Bottle and of a type, for messages of errors.

In: items, or a type of IDSL. Out: short texts such as `float64, float64, string` and `Pose`.
"""

from __future__ import annotations

from typing import Any

import numpy as np

from robocomp_dsl.runtime.codec.bottle.values import (
    Bottle,
    Dict,
    Float32,
    Int8,
    Int16,
    Int64,
    Vocab,
    Vocab64,
)
from robocomp_dsl.runtime.data.schema import Array, Dictionary, Primitive, Sequence, Type

_MAX_ITEMS = 8
_KINDS: tuple[tuple[type[Any], str], ...] = (
    (Int8, "int8"),
    (Int16, "int16"),
    (Int64, "int64"),
    (Vocab, "vocab"),
    (Vocab64, "vocab"),
    (int, "int32"),
    (Float32, "float32"),
    (float, "float64"),
    (str, "string"),
    (bytes, "blob"),
    (memoryview, "blob"),
    (Dict, "dictionary"),
)


def shape_of(items: Bottle) -> str:
    """The wire types of the items, such as `int32, list of 3`."""
    if isinstance(items, np.ndarray):
        return f"all {items.dtype.name}"
    shown = [_kind(item) for item in items[:_MAX_ITEMS]]
    if len(items) > _MAX_ITEMS:
        shown.append("…")
    return ", ".join(shown)


def _kind(item: Any) -> str:
    for type_, name in _KINDS:
        if isinstance(item, type_):
            return name
    return f"list of {len(item)}" if isinstance(item, list | np.ndarray) else "number"


def described(type_: Type) -> str:
    """A type of IDSL, such as `double`, `sequence<double>` or `Pose`."""
    match type_:
        case Primitive():
            return type_.name
        case Array() | Sequence():
            return f"sequence<{described(type_.element)}>"
        case Dictionary():
            return f"dictionary<{described(type_.key)}, {described(type_.value)}>"
        case _:
            return type_.__name__
