"""Convert elements of a struct array to objects, and objects to elements.

In: a structured numpy array, or struct objects. Out: live views of single elements, which are
instances of the struct's class, and arrays built from objects.
"""

from __future__ import annotations

import struct
from collections.abc import Callable, Iterable, Iterator
from operator import attrgetter
from typing import Any

import numpy as np
from numpy.typing import NDArray

from robocomp_dsl.runtime.data.convert import as_scalar, described
from robocomp_dsl.runtime.data.errors import EncodeError
from robocomp_dsl.runtime.data.layout import Leaf, RowLayout, row_layout
from robocomp_dsl.runtime.data.per_class_cache import once
from robocomp_dsl.runtime.data.schema import BOOL, Enum, Primitive, Type
from robocomp_dsl.runtime.data.struct import Struct


def row_view(element: type[Struct], array: NDArray[Any], index: int) -> Any:
    """Element `index` of `array` as an object that reads and writes the array."""
    cls = _row_class(element)
    row = cls.__new__(cls)
    row._array = array
    row._index = index
    return row


def row_views(element: type[Struct], array: NDArray[Any]) -> Iterator[Any]:
    """All elements in order."""
    cls = _row_class(element)
    for index in range(len(array)):
        row = cls.__new__(cls)
        row._array = array
        row._index = index
        yield row


def writable(array: NDArray[Any]) -> NDArray[Any]:
    """`array` itself. Raises `ValueError` if it is a view of a received message."""
    if not array.flags.writeable:
        raise ValueError("received data is read-only; copy() the list and change the copy")
    return array


@once
def _row_class(element: type[Struct]) -> Any:
    """A subclass of `element` that stores no data itself."""
    members: dict[str, Any] = {"__slots__": ("_array", "_index"), "__doc__": element.__doc__}
    for name, (_, type_) in zip(element._names_, element._fields_, strict=True):
        members[name] = _property(name, type_)
    return type(element.__name__, (element,), members)


def _property(name: str, type_: Type) -> property:
    if isinstance(type_, type) and issubclass(type_, Struct):
        return _nested_property(name, type_)
    leaf = type_
    assert isinstance(leaf, Primitive | type)  # noqa: S101 - `row_layout` let only these through
    convert: Callable[[int], Any] | None = None
    if isinstance(leaf, type) and issubclass(leaf, Enum):
        convert = leaf

    def get(row: Any) -> Any:
        value = row._array[name].item(row._index)
        return value if convert is None else convert(value)

    def put(row: Any, value: Any) -> None:
        writable(row._array)[name][row._index] = as_scalar(leaf, value)  # type: ignore[arg-type]

    return property(get, put)


def _nested_property(name: str, type_: type[Struct]) -> property:
    def get(row: Any) -> Any:
        return row_view(type_, row._array[name], row._index)

    def put(row: Any, value: Any) -> None:
        writable(row._array)[name][row._index] = rows_of(type_, (value,))[0]

    return property(get, put)


def rows_of(element: type[Struct], items: Iterable[Any]) -> NDArray[Any]:
    """A new structured array with the values of struct objects.

    Raises `EncodeError` with the index and field of an invalid value.
    """
    layout = row_layout(element)
    items = list(items)
    pack, values = _packer(element)
    try:
        data = bytearray().join([pack(*values(item)) for item in items])
    except (struct.error, AttributeError, TypeError, ValueError, KeyError, OverflowError):
        raise _culprit(element, layout, items) from None
    return np.ndarray(len(items), layout.dtype, data)


@once
def _packer(element: type[Struct]) -> tuple[Callable[..., bytes], Callable[[Any], Any]]:
    """A function that packs the leaves of an object for the dtype, and their attribute getter."""
    layout, at, form = row_layout(element), 0, "<"
    for leaf, offset in zip(layout.leaves, layout.offsets, strict=True):
        form += "x" * (offset - at) + leaf.primitive.code
        at = offset + leaf.primitive.size
    pack = struct.Struct(form + "x" * (layout.stride - at)).pack
    types = [field.type for field in layout.leaves]
    plain = all(isinstance(type_, Primitive) and type_ is not BOOL for type_ in types)
    read = attrgetter(*(".".join(leaf.path) for leaf in layout.leaves))
    if plain and len(layout.leaves) > 1:
        return pack, read
    return pack, lambda item: [_leaf_value(leaf, item) for leaf in layout.leaves]


def _leaf_value(leaf: Leaf, item: Any) -> Any:
    for name in leaf.path:
        item = getattr(item, name)
    return as_scalar(leaf.type, item)


def _culprit(element: type[Struct], layout: RowLayout, items: list[Any]) -> EncodeError:
    for index, item in enumerate(items):
        for leaf in layout.leaves:
            path = f"[{index}].{'.'.join(leaf.path)}"
            try:
                _leaf_value(leaf, item)
            except EncodeError as error:
                return EncodeError(error.reason, path)
            except AttributeError:
                return EncodeError(f"takes a {element.__name__}, not {described(item)}", path)
    return EncodeError(f"takes a sequence of {element.__name__}")
