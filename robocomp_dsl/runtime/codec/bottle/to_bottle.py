"""Converts values of IDSL to items of a Bottle.

In: a type. Out: a function, which raises `EncodeError`.

A struct is a list of its fields, a sequence a list, a dictionary a list of (key value) lists, an
enumerator an int32, a bool a vocab (`true`, `false`), a sequence of bytes a blob.
"""

from __future__ import annotations

from collections.abc import Callable
from collections.abc import Sequence as Values
from typing import Any, TypeAlias

from robocomp_dsl.runtime.codec.bottle.values import Float32, Int16, Int64
from robocomp_dsl.runtime.data.convert import as_array, as_list, as_scalar, described
from robocomp_dsl.runtime.data.errors import EncodeError
from robocomp_dsl.runtime.data.per_class_cache import once
from robocomp_dsl.runtime.data.schema import (
    BOOL,
    BYTE,
    FLOAT,
    LONG,
    SHORT,
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
_WIDTHS: dict[Primitive, type[Any]] = {SHORT: Int16, LONG: Int64, FLOAT: Float32}


def join_path(outer: str, inner: str) -> str:
    """The path of a field within a value."""
    return (
        f"{outer}{inner}"
        if not inner or inner.startswith("[") or not outer
        else (f"{outer}.{inner}")
    )


def fields_to_items(fields: Fields) -> Callable[[Values[Any]], list[Any]]:
    """A function from the values of fields to items."""
    converters = [(name, item_converter(type_)) for name, type_ in fields]

    def convert(values: Values[Any]) -> list[Any]:
        if len(values) != len(converters):
            raise EncodeError(f"takes {len(converters)} values, not {len(values)}")
        items = []
        for (name, to_item), value in zip(converters, values, strict=True):
            try:
                items.append(to_item(value))
            except EncodeError as error:
                raise EncodeError(error.reason, join_path(name, error.path)) from None
        return items

    return convert


def item_converter(type_: Type) -> ToItem:
    """A function from a value of `type_` to an item."""
    convert: ToItem
    match type_:
        case Primitive():
            convert = _scalar(type_)
        case Array():
            convert = _array(type_.element)
        case Sequence():
            convert = _elements(item_converter(type_.element))
        case Dictionary():
            convert = _dictionary(type_)
        case _ if issubclass(type_, Enum):
            convert = _member(type_)
        case _ if issubclass(type_, Struct):
            convert = _struct(type_)
        case _:
            convert = _struct_array(type_)
    return convert


def _member(type_: type[Enum]) -> ToItem:
    return lambda value: int(as_scalar(type_, value))


def _scalar(type_: Primitive) -> ToItem:
    width = _WIDTHS.get(type_)
    if width is None:
        return lambda value: as_scalar(type_, value)
    return lambda value: width(as_scalar(type_, value))


def _array(element: Primitive) -> ToItem:
    dtype = element.dtype
    if element is BYTE:
        return lambda value: as_array(value, dtype).tobytes()
    if element is BOOL:
        return lambda value: as_array(value, dtype).tolist()
    return lambda value: as_array(value, dtype)


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


def _dictionary(type_: Dictionary) -> ToItem:
    to_key, to_value = item_converter(type_.key), item_converter(type_.value)

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


@once
def _struct(type_: type[Struct]) -> ToItem:
    convert, plain = fields_to_items(type_._fields_), type_._plain_

    def convert_struct(value: Any) -> list[Any]:
        if getattr(type(value), "_plain_", None) is not plain:
            raise EncodeError(f"takes a {type_.__name__}, not {described(value)}")
        return convert(value._astuple())

    return convert_struct


def _struct_array(type_: Any) -> ToItem:
    convert = _elements(item_converter(type_._element_))

    def convert_array(values: Any) -> Any:
        return convert(list(values if isinstance(values, type_) else type_(values)))

    return convert_array
