"""Explains why a value cannot be encoded. In: fields, values, failure. Out: `EncodeError`.

Encoders only detect a failure; this module checks the values again to locate it.
"""

from __future__ import annotations

from typing import Any

from robocomp_dsl.runtime.codec.struct_arrays import bad_element
from robocomp_dsl.runtime.data.arrays import StructArray
from robocomp_dsl.runtime.data.convert import as_array, as_list, as_scalar, check_count, described
from robocomp_dsl.runtime.data.layout import row_layout
from robocomp_dsl.runtime.data.schema import (
    Array,
    Dictionary,
    Enum,
    Fields,
    Primitive,
    Sequence,
    Type,
)
from robocomp_dsl.runtime.data.struct import Struct
from robocomp_dsl.runtime.errors import EncodeError


def explain(fields: Fields, form: str, values: Any, failure: Exception) -> EncodeError:
    """The error to raise for `values`, which an encoder of `fields` rejected with `failure`."""
    try:
        for name, type_, value in _paired(fields, form, values):
            _check(type_, value, name)
    except EncodeError as error:
        return error
    return EncodeError(f"cannot be encoded: {failure}")


def _paired(fields: Fields, form: str, values: Any) -> list[tuple[str, Type, Any]]:
    """Name, type and value of each field."""
    if form == "none":
        if values is not None:
            raise EncodeError(f"there is no result, so None and not {described(values)}")
        return []
    if form == "one":
        values = (values,)
    names = ", ".join(name or "result" for name, _ in fields)
    if not isinstance(values, tuple | list):
        raise EncodeError(f"takes a tuple of ({names}), not {described(values)}")
    if len(values) != len(fields):
        raise EncodeError(f"takes {len(fields)} values ({names}), not {len(values)}")
    unnamed = "" if form == "one" else "result"
    return [(n or unnamed, t, v) for (n, t), v in zip(fields, values, strict=True)]


def _check(type_: Type, value: Any, path: str) -> None:
    """Raise `EncodeError` for the first invalid part of `value`."""
    try:
        match type_:
            case Primitive():
                as_scalar(type_, value)
            case Array():
                check_count(type_, len(as_array(value, type_.element.dtype)))
            case Sequence():
                items = as_list(value)
                check_count(type_, len(items))
                for index, item in enumerate(items):
                    _check(type_.element, item, f"[{index}]")
            case Dictionary():
                _check_dictionary(type_, value)
            case _ if issubclass(type_, Enum):
                as_scalar(type_, value)
            case _ if issubclass(type_, Struct):
                _check_record(type_, value)
            case _ if issubclass(type_, StructArray):
                _check_rows(type_, value)
    except EncodeError as error:
        inner = error.path if path else error.path.removeprefix(".")
        raise EncodeError(error.reason, path + inner) from None


def _check_record(type_: type[Struct], value: Any) -> None:
    for name, (_, inner) in zip(type_._names_, type_._fields_, strict=True):
        try:
            item = getattr(value, name)
        except AttributeError:
            raise EncodeError(f"takes a {type_.__name__}, not {described(value)}") from None
        _check(inner, item, f".{name}")


def _check_rows(type_: type[StructArray[Any]], value: Any) -> None:
    layout = row_layout(type_._element_)
    index = bad_element(layout, type_._rows(value))
    if index is not None:
        raise EncodeError(
            f"a bool or enum of {type_._element_.__name__} has no such value", f"[{index}]"
        )


def _check_dictionary(type_: Dictionary, value: Any) -> None:
    if not isinstance(value, dict):
        raise EncodeError(f"takes a dict, not {described(value)}")
    for key, item in value.items():
        _check(type_.key, key, f"[{key!r}]")
        _check(type_.value, item, f"[{key!r}]")
