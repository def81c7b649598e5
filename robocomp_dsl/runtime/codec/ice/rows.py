"""Sequences of fixed structs: numpy arrays in memory, packed elements on Ice's wire.

In: a struct class, an array or bytes. Out: the bytes, or the array. Memory has the padding of
`data.layout`, and an enum has 4 bytes; the wire has no padding, and an enum has one byte.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray

from robocomp_dsl.runtime.codec.ice.wire import MAX_BYTE
from robocomp_dsl.runtime.codec.struct_arrays import column
from robocomp_dsl.runtime.data.layout import Leaf, RowLayout, row_layout
from robocomp_dsl.runtime.data.per_class_cache import once
from robocomp_dsl.runtime.data.schema import Enum, Primitive
from robocomp_dsl.runtime.data.struct import Struct


@dataclass(frozen=True, eq=False)
class PackedRows:
    """The elements of a sequence on the wire: `dtype` has one numbered field for each leaf.

    `direct`: memory and wire layout are the same.
    """

    layout: RowLayout
    dtype: np.dtype[Any]
    direct: bool


@once
def packed_rows(element: type[Struct]) -> PackedRows | None:
    """The wire layout of a sequence of `element`; None if its elements have no fixed size."""
    layout = row_layout(element)
    formats = [_format(leaf) for leaf in layout.leaves]
    if not all(formats):
        return None
    dtype = np.dtype([(str(index), form) for index, form in enumerate(formats)])
    offsets = tuple(dtype.fields[name][1] for name in dtype.names or ())  # type: ignore[index]
    same = offsets == layout.offsets and dtype.itemsize == layout.stride
    has_enum = any(not isinstance(leaf.type, Primitive) for leaf in layout.leaves)
    return PackedRows(layout, dtype, same and not has_enum)


def _format(leaf: Leaf) -> str:
    """The numpy format of a leaf on the wire; empty for an enum with values of several bytes."""
    if isinstance(leaf.type, Primitive):
        return leaf.type.dtype.str
    return "u1" if is_one_byte(leaf.type) else ""


def is_one_byte(enum: type[Enum]) -> bool:
    """Whether each value is one byte on the wire."""
    return all(0 <= int(member) <= MAX_BYTE for member in enum)


def pack(rows: PackedRows, array: NDArray[Any]) -> bytes:
    """The elements of `array`, whose bools and enums are valid."""
    packed = np.empty(len(array), rows.dtype)
    for index, leaf in enumerate(rows.layout.leaves):
        packed[str(index)] = column(array, leaf)
    return packed.tobytes()


def unpack(rows: PackedRows, message: bytes, offset: int, count: int) -> NDArray[Any]:
    """`count` elements from `offset` on; read-only like all received arrays.

    Raises `ValueError` or `TypeError` if the message is too short.
    """
    if rows.direct:
        return aligned(np.ndarray(count, rows.layout.dtype, message, offset))
    packed: NDArray[Any] = np.ndarray(count, rows.dtype, message, offset)
    array = np.zeros(count, rows.layout.dtype)
    for index, leaf in enumerate(rows.layout.leaves):
        column(array, leaf)[...] = packed[str(index)]
    array.flags.writeable = False
    return array


def aligned(array: NDArray[Any]) -> NDArray[Any]:
    """The array, copied if its memory is not aligned; read-only."""
    if not array.flags.aligned:
        array = array.copy()
        array.flags.writeable = False
    return array
