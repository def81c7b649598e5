"""Converts items of a Bottle to values of IDSL. In: a type. Out: a function.

It raises `MalformedMessage` with the path of the item. Numbers may have another width than IDSL
states, because text carriers have none, but must fit.
"""

from __future__ import annotations

import struct
from collections.abc import Callable
from typing import Any, TypeAlias

import numpy as np

from robocomp_dsl.runtime.codec.bottle.images import IMAGE_ID, is_image, items_to_image
from robocomp_dsl.runtime.codec.bottle.layout import Layout
from robocomp_dsl.runtime.codec.bottle.shapes import described, shape_of
from robocomp_dsl.runtime.codec.bottle.text_writer import write_value
from robocomp_dsl.runtime.codec.bottle.to_bottle import is_spliced, join_path
from robocomp_dsl.runtime.codec.bottle.values import FALSE, TRUE, Bottle, Vocab, Vocab64, vocab
from robocomp_dsl.runtime.data.convert import as_array, as_scalar, check_count
from robocomp_dsl.runtime.data.errors import EncodeError
from robocomp_dsl.runtime.data.schema import (
    BOOL,
    BYTE,
    DOUBLE,
    FLOAT,
    OCTET,
    STRING,
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
from robocomp_dsl.runtime.errors import MalformedMessage

FromItem: TypeAlias = Callable[[Any], Any]
_BOOLS = {TRUE: True, FALSE: False, vocab("ok"): True, vocab("fail"): False, 1: True}
_FLOAT = struct.Struct("<f")
_SHOWN = 40


def width_of(type_: Type, layout: Layout) -> int:
    """The number of items that a field of this type has within a message."""
    if isinstance(type_, type) and issubclass(type_, Struct) and is_spliced(type_, layout):
        return sum(width_of(field, layout) for _, field in type_._fields_)
    return 1


def items_to_fields(fields: Fields, layout: Layout = Layout.YARP) -> Callable[[Bottle], list[Any]]:
    """A function from items to the values of fields."""
    converters: list[tuple[str, FromItem, int | slice]] = []
    count = 0
    for name, type_ in fields:
        width, spliced = width_of(type_, layout), is_spliced(type_, layout)
        at = slice(count, count + width) if spliced else count
        converters.append((name, value_converter(type_, layout), at))
        count += width
    names = ", ".join(f"{name or 'result'} {described(type_)}" for name, type_ in fields)

    def convert(items: Bottle) -> list[Any]:
        if len(items) != count:
            found = f"{len(items)} values ({shape_of(items)})" if len(items) else "no values"
            raise MalformedMessage(f"has {found}, but should have: {names or 'none'}")
        values = []
        plain = as_items(items)
        for name, from_item, at in converters:
            try:
                values.append(from_item(plain[at]))
            except MalformedMessage as error:
                raise _inside(name, error) from None
        return values

    return convert


def as_items(bottle: Bottle) -> list[Any]:
    """The items as Python values."""
    return bottle.tolist() if isinstance(bottle, np.ndarray) else bottle


def value_converter(type_: Type, layout: Layout = Layout.YARP) -> FromItem:
    """A function from an item to a value of `type_`."""
    convert: FromItem
    match type_:
        case Primitive():
            convert = _scalar(type_)
        case Array():
            convert = _counted(type_, _bools if type_.element is BOOL else _array(type_.element))
        case Sequence():
            convert = _counted(type_, _elements(value_converter(type_.element, layout)))
        case Dictionary():
            convert = _dictionary(type_, layout)
        case _ if issubclass(type_, Enum):
            convert = _member(type_)
        case _ if issubclass(type_, Struct):
            convert = _struct(type_, layout)
        case _:
            convert = _struct_array(type_, layout)
    return convert


def _counted(type_: Array | Sequence, convert: FromItem) -> FromItem:
    """`convert`, with a check of the length if the type limits it."""
    if not type_.size and not type_.bound:
        return convert

    def convert_counted(item: Any) -> Any:
        values = convert(item)
        try:
            check_count(type_, len(values))
        except EncodeError as error:
            raise MalformedMessage(error.reason) from None
        return values

    return convert_counted


def _struct_array(type_: Any, layout: Layout) -> FromItem:
    elements = _elements(value_converter(type_._element_, layout))
    return lambda item: type_(elements(item))


def _wrong(item: Any, what: str) -> MalformedMessage:
    text = write_value(item)
    text = text if len(text) <= _SHOWN else text[: _SHOWN - 1] + "…"
    return MalformedMessage(f"`{text}` is no {what}")


def _inside(path: str, error: MalformedMessage) -> MalformedMessage:
    return MalformedMessage(error.reason, join_path(path, error.path), error.offset)


def _scalar(type_: Primitive) -> FromItem:
    if type_ is STRING:
        return _text
    if type_ is BOOL:
        return _flag
    is_float = type_ in {FLOAT, DOUBLE}

    def number(item: Any) -> Any:
        if not isinstance(item, int | float) or isinstance(item, Vocab | Vocab64):
            raise _wrong(item, type_.name)
        if is_float:
            item = float(item)
        elif isinstance(item, float) and item.is_integer():
            item = int(item)
        if type_ is UINT64:
            item = _without_sign(item)
        try:
            value = as_scalar(type_, item)
        except EncodeError as error:
            raise MalformedMessage(error.reason) from None
        if type_ is FLOAT:
            return _FLOAT.unpack(_FLOAT.pack(value))[0]
        return value if is_float else int(value)

    return number


def _without_sign(item: Any) -> Any:
    """A uint64 from the int64 with the same bits, as which a Bottle has it."""
    is_negative = isinstance(item, int) and -(1 << 63) <= item < 0
    return int(item) + (1 << 64) if is_negative else item


def _text(item: Any) -> str:
    if not isinstance(item, str):
        raise _wrong(item, 'string; in text, write it in quotes ("…")')
    try:
        item.encode()
    except UnicodeEncodeError:
        raise MalformedMessage("the text is not UTF-8") from None
    return item


def _flag(item: Any) -> bool:
    value = _BOOLS.get(item) if isinstance(item, int) else None
    if value is None:
        raise _wrong(item, "bool (true, false)")
    return value


def _member(type_: type[Enum]) -> FromItem:
    def member(item: Any) -> Enum:
        if not isinstance(item, int) or item not in type_._value2member_map_:
            raise _wrong(item, f"value of {type_.__name__}")
        return type_(item)

    return member


def _list_of(item: Any) -> Any:
    if not isinstance(item, list | np.ndarray):
        raise _wrong(item, "list")
    return item


def _array(element: Primitive) -> FromItem:
    dtype = element.dtype

    def array(item: Any) -> Any:
        if element in {BYTE, OCTET} and isinstance(item, bytes | memoryview):
            return np.frombuffer(item, np.uint8)
        items = _list_of(item)
        if element is UINT64:
            is_int64 = isinstance(items, np.ndarray) and items.dtype == np.int64
            items = items.view(np.uint64) if is_int64 else [*map(_without_sign, items)]
        try:
            return as_array(items, dtype)
        except EncodeError as error:
            raise MalformedMessage(error.reason, error.path) from None

    return array


def _bools(item: Any) -> Any:
    return np.array([_flag(value) for value in as_items(_list_of(item))], np.bool_)


def _elements(from_item: FromItem) -> FromItem:
    def convert(item: Any) -> list[Any]:
        values = []
        for index, inner in enumerate(as_items(_list_of(item))):
            try:
                values.append(from_item(inner))
            except MalformedMessage as error:
                raise _inside(f"[{index}]", error) from None
        return values

    return convert


def _dictionary(type_: Dictionary, layout: Layout) -> FromItem:
    converters = (
        ("key", value_converter(type_.key, layout)),
        ("value", value_converter(type_.value, layout)),
    )

    def pair(item: Any) -> tuple[Any, ...]:
        items = as_items(_list_of(item))
        if len(items) != 2:
            raise MalformedMessage(f"has {len(items)} values, but should have: key value")
        values = []
        for (name, convert), inner in zip(converters, items, strict=True):
            try:
                values.append(convert(inner))
            except MalformedMessage as error:
                raise _inside(name, error) from None
        return tuple(values)

    pairs = _elements(pair)
    return lambda item: dict(pairs(item))


def _struct(type_: type[Struct], layout: Layout) -> FromItem:
    convert = items_to_fields(type_._fields_, layout)
    if type_._type_id_ != IMAGE_ID:
        return lambda item: type_(*convert(_list_of(item)))
    convert_image = items_to_image(type_)

    def image(item: Any) -> Any:
        """From the image of YARP or the fields of ROS, whatever the program sends."""
        return convert_image(item) if is_image(item) else type_(*convert(_list_of(item)))

    return image
