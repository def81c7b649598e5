"""Type expressions of a schema, such as `sequence<M::T>`, to types.

In: a text from a peer, and the named types before it. Out: a type of the codec, or `SchemaError`.
"""

from __future__ import annotations

import re
from collections.abc import Mapping
from dataclasses import replace
from typing import Any

from robocomp_dsl.runtime.data import schema
from robocomp_dsl.runtime.data.arrays import StructArray, array_class
from robocomp_dsl.runtime.data.layout import row_layout
from robocomp_dsl.runtime.data.schema import Array, Dictionary, Primitive, Sequence, Type
from robocomp_dsl.runtime.data.struct import Struct
from robocomp_dsl.runtime.errors import SchemaError

MAX_DEPTH = 32
"""Maximum nesting of sequences and dictionaries."""
MAX_LENGTH = 1_000_000
"""Largest length of a fixed array; its elements are in every value."""
_NAME = "[A-Za-z_][A-Za-z0-9_]*"
_TOKEN = re.compile(rf"{_NAME}(?:::{_NAME}|/{_NAME}/{_NAME})?|[<>,]|[1-9][0-9]*")
NamedTypes = Mapping[str, type[Any]]


def parse_type(text: str, types: NamedTypes) -> Type:
    """The type that `text` names. Raises `SchemaError`."""
    tokens = _TOKEN.findall(text)
    if "".join(tokens) != text:
        raise SchemaError(f"`{text:.80}` is not a type")
    tokens.reverse()
    type_ = _parse(tokens, types, text, MAX_DEPTH)
    if tokens:
        raise SchemaError(f"`{text:.80}` is not a type: unexpected `{tokens[-1]:.40}`")
    return type_


def _parse(tokens: list[str], types: NamedTypes, text: str, depth: int) -> Type:
    if not depth:
        raise SchemaError(f"`{text:.80}` is nested deeper than {MAX_DEPTH} levels")
    name = tokens.pop() if tokens else ""
    if name in ("sequence", "array"):
        _expect(tokens, "<", text)
        element = _parse(tokens, types, text, depth - 1)
        length = _length(tokens, text) if name == "array" or tokens[-1:] == [","] else 0
        _expect(tokens, ">", text)
        return _sequence(element, **{"size" if name == "array" else "bound": length})
    if name == "string" and tokens[-1:] == ["<"]:
        tokens[-1] = ","
        length = _length(tokens, text)
        _expect(tokens, ">", text)
        return replace(schema.STRING, bound=length)
    if name == "dictionary":
        _expect(tokens, "<", text)
        key = _parse(tokens, types, text, depth - 1)
        _expect(tokens, ",", text)
        value = _parse(tokens, types, text, depth - 1)
        _expect(tokens, ">", text)
        try:
            return Dictionary(key, value)
        except TypeError as error:
            raise SchemaError(f"`{text:.80}` is not a type: {error}") from None
    found: Type | None = schema.PRIMITIVES.get(name) or types.get(name)
    if found is None:
        raise SchemaError(f"type `{name:.80}` is not defined before its use")
    return found


def _expect(tokens: list[str], sign: str, text: str) -> None:
    if not tokens or tokens.pop() != sign:
        raise SchemaError(f"`{text:.80}` is not a type: `{sign}` is missing")


def _length(tokens: list[str], text: str) -> int:
    """The number after a comma."""
    _expect(tokens, ",", text)
    number = tokens.pop() if tokens else ""
    if not number.isdecimal() or len(number) > len(str(2**32)):
        raise SchemaError(f"`{text:.80}` is not a type: a length is missing")
    return int(number)


def _sequence(element: Type, size: int = 0, bound: int = 0) -> Type:
    """The sequence that generated code would use: numpy arrays where the layout is fixed."""
    if size > MAX_LENGTH:
        raise SchemaError(f"an array of {size} elements is too long (at most {MAX_LENGTH})")
    if isinstance(element, Primitive) and not element.is_text:
        return Array(element, size, bound)
    if isinstance(element, type) and issubclass(element, Struct) and not (size or bound):
        try:
            row_layout(element)
        except TypeError:  # no fixed size
            return Sequence(element)
        array: type[StructArray[Any]] = array_class(element)
        return array
    return Sequence(element, size, bound)
