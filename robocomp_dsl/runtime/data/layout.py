"""Memory and wire layout of the elements of a sequence of fixed structs.

In: a struct class whose leaves are numbers, bools and enums. Out: `RowLayout`.

In XCDR1 every leaf is aligned to its size, counted from the start of the message; a struct has no
alignment or padding of its own. So after the first element, which may start at another residue,
all elements have the same layout and stride, and the last has no trailing padding. The numpy
dtype has that layout, so elements are copied as one block.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from itertools import accumulate
from typing import Any, TypeGuard

import numpy as np

from robocomp_dsl.runtime.data.per_class_cache import once
from robocomp_dsl.runtime.data.schema import INT, Enum, Primitive, Type
from robocomp_dsl.runtime.data.struct import Struct


@dataclass(frozen=True, slots=True)
class Leaf:
    """One number of an element. `path`: the attributes that lead to it."""

    path: tuple[str, ...]
    type: Primitive | type[Enum]

    @property
    def primitive(self) -> Primitive:
        """The wire type; an enum is an int."""
        return self.type if isinstance(self.type, Primitive) else INT


@dataclass(frozen=True, eq=False)
class RowLayout:
    """Layout of the elements from the second on. Sizes and offsets in bytes.

    `offsets` of the leaves from the start of the element; `residue`: start of an element modulo
    `alignment`, the largest alignment of its leaves; `stride`: distance of two elements (size of
    `dtype`); `size`: without trailing padding; `direct`: there is no padding, and the first element
    has the layout of the others once its start is aligned.
    """

    dtype: np.dtype[Any]
    leaves: tuple[Leaf, ...]
    offsets: tuple[int, ...]
    residue: int
    alignment: int
    stride: int
    size: int
    direct: bool

    @property
    def first_alignment(self) -> int:
        """Alignment of the first leaf; it determines the padding before an element."""
        return self.leaves[0].primitive.size

    def first(self, start: int) -> tuple[tuple[int, ...], int]:
        """Offsets and size of a first element at the aligned position `start`."""
        return _placed(self.leaves, start)


def padding(position: int, alignment: int) -> int:
    """Bytes from `position` to the next multiple of `alignment`."""
    return -position % alignment


@once
def row_layout(element: type[Struct]) -> RowLayout:
    """The layout of a sequence of `element`. Raises `TypeError` if its size is not fixed."""
    leaves = tuple(_leaves(element, ()))
    if not leaves:
        raise TypeError(f"{element.__name__} has no fields to make an array of")
    first, alignment = leaves[0].primitive.size, max(leaf.primitive.size for leaf in leaves)
    size = _placed(leaves, 0)[1]
    residue = (size + padding(size, first)) % alignment
    offsets, size = _placed(leaves, residue)
    stride = size + padding(residue + size, first)
    solid = stride == sum(leaf.primitive.size for leaf in leaves)
    return RowLayout(
        dtype=_dtype(element, iter(offsets), stride)[0],
        leaves=leaves,
        offsets=offsets,
        residue=residue,
        alignment=alignment,
        stride=stride,
        size=size,
        # The count before the first element ends at a multiple of 4.
        direct=solid and residue == 0 and (alignment <= 4 or first == alignment),
    )


@once
def packed_layout(element: type[Struct]) -> RowLayout:
    """The layout of a sequence of `element` on a wire without padding. Raises as `row_layout`."""
    leaves = row_layout(element).leaves
    ends = list(accumulate(leaf.primitive.size for leaf in leaves))
    offsets, size = (0, *ends[:-1]), ends[-1]
    dtype = _dtype(element, iter(offsets), size)[0]
    return RowLayout(dtype, leaves, offsets, 0, 1, size, size, direct=True)


def _leaves(type_: Type, path: tuple[str, ...]) -> Iterator[Leaf]:
    if _is_leaf(type_):
        yield Leaf(path, type_)
    elif isinstance(type_, type) and issubclass(type_, Struct) and type_._fields_:
        for name, (_, inner) in zip(type_._names_, type_._fields_, strict=True):
            yield from _leaves(inner, (*path, name))
    else:
        raise TypeError(f"{'.'.join(path) or type_}: no number, so no fixed size")


def _is_leaf(type_: Type) -> TypeGuard[Primitive | type[Enum]]:
    if isinstance(type_, Primitive):
        return not type_.is_text
    return isinstance(type_, type) and issubclass(type_, Enum)


def _placed(leaves: tuple[Leaf, ...], start: int) -> tuple[tuple[int, ...], int]:
    """Offsets of the leaves, and size, of an element that starts at `start`."""
    offsets, at = [], start
    for leaf in leaves:
        at += padding(at, leaf.primitive.size)
        offsets.append(at - start)
        at += leaf.primitive.size
    return tuple(offsets), at - start


def _dtype(type_: Type, offsets: Iterator[int], size: int = 0) -> tuple[np.dtype[Any], int, int]:
    """The numpy dtype with its start and end; leaves take their offsets from the iterator."""
    if not (isinstance(type_, type) and issubclass(type_, Struct)):
        primitive = type_ if isinstance(type_, Primitive) else INT
        at = next(offsets)
        return primitive.dtype, at, at + primitive.size
    fields = [_dtype(inner, offsets) for _, inner in type_._fields_]
    begin, end = fields[0][1], fields[-1][2]
    dtype = np.dtype(
        {
            "names": list(type_._names_),
            "formats": [format_ for format_, _, _ in fields],
            "offsets": [at - begin for _, at, _ in fields],
            "itemsize": size or end - begin,
        }
    )
    return dtype, begin, end
