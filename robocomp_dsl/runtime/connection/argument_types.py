"""Converts the arguments of an operation to the values that its receiver gets.

In: values as users write them, such as a list for an array. Out: the values that a decoded message
has; monitors at a sender and at a receiver see the same. Errors are `EncodeError`.
"""

from __future__ import annotations

from collections.abc import Callable
from typing import Any, TypeAlias

from robocomp_dsl.runtime.codec.codec import compile_decoder, compile_encoder
from robocomp_dsl.runtime.component.interface import Operation
from robocomp_dsl.runtime.data.convert import as_array, as_scalar
from robocomp_dsl.runtime.data.errors import EncodeError
from robocomp_dsl.runtime.data.schema import Array, Enum, Primitive, StructBase, Type

Converter: TypeAlias = Callable[[Any], Any]


class ArgumentTypes:
    """The converters of the arguments of one operation."""

    def __init__(self, operation: Operation) -> None:
        self.operation = operation
        self._converters = tuple(_converter(name, type_) for name, type_ in operation.inputs)

    def convert(self, arguments: tuple[Any, ...]) -> tuple[Any, ...]:
        """The values of a message. Raises `EncodeError`."""
        self._check_count(arguments)
        pairs = zip(self._converters, arguments, strict=True)
        return tuple(convert(value) for convert, value in pairs)

    def convert_changed(
        self, arguments: tuple[Any, ...], previous: tuple[Any, ...]
    ) -> tuple[Any, ...]:
        """As `convert`, for values that are not those of `previous`, which need no conversion."""
        self._check_count(arguments)
        triples = zip(self._converters, arguments, previous, strict=True)
        return tuple(v if v is old else convert(v) for convert, v, old in triples)

    def _check_count(self, arguments: tuple[Any, ...]) -> None:
        if len(arguments) != len(self._converters):
            names = ", ".join(name for name, _ in self.operation.inputs)
            raise EncodeError(
                f"{self.operation.name} has the arguments ({names}), not {len(arguments)} values"
            )


def _converter(name: str, type_: Type) -> Converter:
    if isinstance(type_, Primitive) or (isinstance(type_, type) and issubclass(type_, Enum)):
        return _located(name, lambda value: as_scalar(type_, value))
    if isinstance(type_, Array):
        dtype = type_.element.dtype
        return _located(name, lambda value: as_array(value, dtype))
    encode, decode = compile_encoder(((name, type_),)), compile_decoder(((name, type_),))

    def as_decoded(value: Any) -> Any:
        return decode(encode((value,)))[0]

    if isinstance(type_, type) and issubclass(type_, StructBase):
        return lambda value: value if type(value) is type_ else as_decoded(value)
    return as_decoded


def _located(name: str, convert: Converter) -> Converter:
    """`convert`, with the name of the argument in its errors."""

    def convert_argument(value: Any) -> Any:
        try:
            return convert(value)
        except EncodeError as error:
            raise EncodeError(error.reason, f"{name}{error.path}") from None

    return convert_argument
