"""Sequences of fixed structs with padding, whose wire and memory layouts differ.

In: a structured array and a position, or bytes and an offset. Out: the bytes, or the array. The
wire has no padding after the last element, and the first element may have other padding (see
`layout`). Positions count from the end of the encapsulation header, offsets from the start of the
message.
"""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

import numpy as np
from numpy.typing import NDArray

from robocomp_dsl.runtime.data.layout import Leaf, RowLayout, padding
from robocomp_dsl.runtime.data.schema import BOOL, Primitive

_HEADER = 4


def column(array: NDArray[Any], leaf: Leaf) -> NDArray[Any]:
    """The numbers of one leaf of all elements."""
    for name in leaf.path:
        array = array[name]
    return array


def pack(layout: RowLayout, array: NDArray[Any], position: int) -> bytes:
    """The elements as bytes that start at `position`; padding bytes are zero."""
    if not len(array):
        return b""
    clean = np.zeros(len(array), layout.dtype)
    for leaf in layout.leaves:
        column(clean, leaf)[...] = column(array, leaf)
    raw = clean.tobytes()
    lead = padding(position, layout.first_alignment)
    start = position + lead
    tail = len(raw) - (layout.stride - layout.size)
    if start % layout.alignment == layout.residue:
        return bytes(lead) + raw[:tail]
    offsets, size = layout.first(start)
    head = bytearray(size)
    _move(layout, raw, layout.offsets, head, offsets)
    if len(array) == 1:
        return bytes(lead) + head
    gap = padding(start + size, layout.first_alignment)
    return bytes(lead) + head + bytes(gap) + raw[layout.stride : tail]


def unpack(
    layout: RowLayout, buffer: Any, offset: int, count: int, dtype: np.dtype[Any] | None = None
) -> tuple[NDArray[Any], int]:
    """`count` elements and the offset after them. Raises `ValueError` if the buffer is too short.

    `dtype` is that of the layout, or its equivalent in the other byte order.
    """
    dtype = dtype or layout.dtype
    if not count:
        return np.ndarray(0, dtype, b""), offset
    start = offset + padding(offset - _HEADER, layout.first_alignment)
    offsets, size = layout.offsets, layout.size
    regular = (start - _HEADER) % layout.alignment == layout.residue
    if not regular:
        offsets, size = layout.first(start - _HEADER)
    second = begin(layout, offset, 1)
    rest = (count - 2) * layout.stride + layout.size if count > 1 else 0
    end = second + rest if rest else start + size
    if end > len(buffer):
        raise ValueError(f"{count} elements need {end - offset} bytes")
    if regular and layout.stride == layout.size:
        return np.ndarray(count, dtype, buffer, start), end
    data = bytearray(count * layout.stride)
    _move(layout, buffer[start : start + size], offsets, data, layout.offsets)
    data[layout.stride : layout.stride + rest] = buffer[second:end] if rest else b""
    array: NDArray[Any] = np.ndarray(count, dtype, data)
    array.flags.writeable = False  # like all received arrays
    return array, end


def _move(
    layout: RowLayout, source: Any, froms: tuple[int, ...], target: bytearray, tos: tuple[int, ...]
) -> None:
    """Copy the leaves of the first element from one layout to the other."""
    for leaf, at, to in zip(layout.leaves, froms, tos, strict=True):
        size = leaf.primitive.size
        target[to : to + size] = source[at : at + size]


def begin(layout: RowLayout, offset: int, index: int) -> int:
    """Start of element `index` if the first one starts at `offset` or after its padding."""
    first = layout.first_alignment
    start = offset + padding(offset - _HEADER, first)
    if not index:
        return start
    end = start + layout.first(start - _HEADER)[1]
    return end + padding(end - _HEADER, first) + (index - 1) * layout.stride


def bad_element(layout: RowLayout, array: NDArray[Any]) -> int | None:
    """The first element with a bool other than 0 or 1, or an unknown enumerator."""
    wrong = np.zeros(len(array), np.bool_)
    for leaf in _constrained(layout):
        numbers = column(array, leaf)
        if isinstance(leaf.type, Primitive):
            wrong |= numbers.view(np.uint8) > 1
        else:
            wrong |= ~np.isin(numbers, [int(member) for member in leaf.type])
    return int(wrong.argmax()) if wrong.any() else None


def _constrained(layout: RowLayout) -> list[Leaf]:
    """The leaves with invalid byte values: bools and enums."""
    return [
        leaf for leaf in layout.leaves if not isinstance(leaf.type, Primitive) or leaf.type is BOOL
    ]


def checker(layout: RowLayout) -> Callable[[NDArray[Any]], None] | None:
    """A function that raises `ValueError` for an invalid element; None if all are valid."""
    if not _constrained(layout):
        return None

    def check(array: NDArray[Any]) -> None:
        if bad_element(layout, array) is not None:
            raise ValueError

    return check
