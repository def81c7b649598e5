"""Converts values of IDSL to items of a Bottle.

In: a type. Out: a function, which raises `EncodeError`.

A struct is a list of its fields, a sequence a list, a dictionary a list of (key value) lists, an
enumerator an int32, a bool a vocab (`true`, `false`), a sequence of bytes a blob. `Layout` tells
where other programs differ.
"""

from __future__ import annotations

import struct
from collections.abc import Callable
from collections.abc import Sequence as Values
from typing import Any, TypeAlias

import numpy as np

from robocomp_dsl.runtime.codec.bottle.images import IMAGE_ID, image_to_items
from robocomp_dsl.runtime.codec.bottle.layout import Layout
from robocomp_dsl.runtime.codec.bottle.values import Float32, Int8, Int16, Int64, vocab
from robocomp_dsl.runtime.data.convert import (
    as_array,
    as_list,
    as_scalar,
    check_count,
    described,
)
from robocomp_dsl.runtime.data.errors import EncodeError
from robocomp_dsl.runtime.data.schema import (
    BOOL,
    BYTE,
    FLOAT,
    INT8,
    LONG,
    OCTET,
    SHORT,
    UINT16,
    UINT32,
    UINT64,
    Array,
    Dictionary,
    Enum,
    Fields,
    Primitive,
    Sequence,
    Type,
)
from robocomp_dsl.runtime.data.struct import Struct

ToItem: TypeAlias = Callable[[Any], Any]
_WIDTHS: dict[Primitive, type[Any]] = {INT8: Int8, SHORT: Int16, LONG: Int64, FLOAT: Float32}
_WIDER: dict[Primitive, np.dtype[Any]] = {
    UINT16: np.dtype(np.int32),
    UINT32: np.dtype(np.int64),
}
"""A Bottle has no unsigned numbers. A uint64 becomes the int64 with the same bits, as in YARP."""
_BITS, _SAME_BITS = struct.Struct("<Q"), struct.Struct("<q")
OK, FAIL = vocab("ok"), vocab("fail")


def join_path(outer: str, inner: str) -> str:
    """The path of a field within a value."""
    return (
        f"{outer}{inner}"
        if not inner or inner.startswith("[") or not outer
        else (f"{outer}.{inner}")
    )


def is_spliced(type_: Type, layout: Layout) -> bool:
    """Whether the items of a field stand among those of the others, without a list."""
    is_struct = isinstance(type_, type) and issubclass(type_, Struct)
    return layout is Layout.THRIFT and is_struct


def fields_to_items(
    fields: Fields, layout: Layout = Layout.YARP
) -> Callable[[Values[Any]], list[Any]]:
    """A function from the values of fields to items."""
    converters = [
        (name, item_converter(type_, layout), is_spliced(type_, layout)) for name, type_ in fields
    ]

    def convert(values: Values[Any]) -> list[Any]:
        if len(values) != len(converters):
            raise EncodeError(f"takes {len(converters)} values, not {len(values)}")
        items: list[Any] = []
        for (name, to_item, spliced), value in zip(converters, values, strict=True):
            try:
                if spliced:
                    items += to_item(value)
                else:
                    items.append(to_item(value))
            except EncodeError as error:
                raise EncodeError(error.reason, join_path(name, error.path)) from None
        return items

    return convert


def item_converter(type_: Type, layout: Layout = Layout.YARP) -> ToItem:
    """A function from a value of `type_` to an item."""
    convert: ToItem
    match type_:
        case Primitive():
            convert = _scalar(type_, layout)
        case Array():
            convert = _array(type_, layout)
        case Sequence():
            convert = _counted(type_, _elements(item_converter(type_.element, layout)))
        case Dictionary():
            convert = _dictionary(type_, layout)
        case _ if issubclass(type_, Enum):
            convert = _member(type_)
        case _ if issubclass(type_, Struct):
            is_image = layout is Layout.YARP and type_._type_id_ == IMAGE_ID
            convert = image_to_items(type_) if is_image else _struct(type_, layout)
        case _:
            convert = _struct_array(type_, layout)
    return convert


def _member(type_: type[Enum]) -> ToItem:
    return lambda value: int(as_scalar(type_, value))


def _scalar(type_: Primitive, layout: Layout) -> ToItem:
    if type_ is BOOL and layout is Layout.THRIFT:
        return lambda value: OK if as_scalar(type_, value) else FAIL
    width = _WIDTHS.get(type_)
    if type_ is UINT64:
        return lambda value: Int64(_SAME_BITS.unpack(_BITS.pack(as_scalar(type_, value)))[0])
    if width is None:
        return lambda value: as_scalar(type_, value)
    return lambda value: width(as_scalar(type_, value))


def _array(type_: Array, layout: Layout) -> ToItem:
    element, dtype = type_.element, type_.element.dtype
    wider = _WIDER.get(element)

    def convert(value: Any) -> Any:
        array = as_array(value, dtype)
        check_count(type_, len(array))
        if element in {BYTE, OCTET}:
            return array.data
        if element is BOOL:
            flags = array.tolist()
            return [OK if flag else FAIL for flag in flags] if layout is Layout.THRIFT else flags
        if element is UINT64:
            return array.view(np.int64)
        return array if wider is None else array.astype(wider)

    return convert


def _counted(type_: Sequence, convert: ToItem) -> ToItem:
    """`convert`, with a check of the length if the type limits it."""
    if not type_.size and not type_.bound:
        return convert

    def convert_counted(values: Any) -> list[Any]:
        items: list[Any] = convert(values)
        check_count(type_, len(items))
        return items

    return convert_counted


def _elements(to_item: ToItem) -> ToItem:
    def convert(values: Any) -> list[Any]:
        items = []
        for index, value in enumerate(as_list(values)):
            try:
                items.append(to_item(value))
            except EncodeError as error:
                raise EncodeError(error.reason, join_path(f"[{index}]", error.path)) from None
        return items

    return convert


def _dictionary(type_: Dictionary, layout: Layout) -> ToItem:
    to_key = item_converter(type_.key, layout)
    to_value = item_converter(type_.value, layout)

    def convert(values: Any) -> list[Any]:
        if not isinstance(values, dict):
            raise EncodeError(f"takes a dict, not {described(values)}")
        items = []
        for key, value in values.items():
            try:
                items.append([to_key(key), to_value(value)])
            except EncodeError as error:
                raise EncodeError(error.reason, join_path(f"[{key!r}]", error.path)) from None
        return items

    return convert


def _struct(type_: type[Struct], layout: Layout) -> ToItem:
    convert, plain = fields_to_items(type_._fields_, layout), type_._plain_

    def convert_struct(value: Any) -> list[Any]:
        if getattr(type(value), "_plain_", None) is not plain:
            raise EncodeError(f"takes a {type_.__name__}, not {described(value)}")
        return convert(value._astuple())

    return convert_struct


def _struct_array(type_: Any, layout: Layout) -> ToItem:
    convert = _elements(item_converter(type_._element_, layout))

    def convert_array(values: Any) -> Any:
        return convert(list(values if isinstance(values, type_) else type_(values)))

    return convert_array
