"""Convert values to messages and back: CDR, little endian, version 1, as in DDS and ROS 2.

In: the fields of an operation, or one type. Out: specialised functions: their source is generated
from the schema (`encoder`, `decoder`) and compiled once, on first use.

The format is OMG CDR (CORBA 3.0, section 15.3; DDS-XTypes 1.3, section 7.4.1, "XCDR version 1")
after the 4 bytes 00 01 00 00; numbers are aligned to their size, counted from the end of these
bytes. An enum is 32 bits; a dictionary a sequence of (key, value) structs; an exception a struct;
the inputs of an operation one struct, its outputs another. A struct without fields is one zero
byte, as in ROS 2.

Decoded arrays are read-only views of the message; `copy()` them before changing them. For invalid
bytes decoders raise `MalformedMessage` and no other exception.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable
from typing import Any, TypeAlias, TypeVar, cast

from robocomp_dsl.runtime.codec.decoder import decoder_function
from robocomp_dsl.runtime.codec.encoder import encoder_function
from robocomp_dsl.runtime.codec.read import read_number
from robocomp_dsl.runtime.data.per_class_cache import once
from robocomp_dsl.runtime.data.schema import INT, Fields
from robocomp_dsl.runtime.data.struct import Struct
from robocomp_dsl.runtime.errors import DeclaredError, EncodeError

Buffer: TypeAlias = bytes | bytearray | memoryview
R = TypeVar("R", bound=Struct)


def compile_encoder(
    fields: Fields,
    *,
    result: bool = False,
    join: Callable[[Iterable[Any]], Any] = b"".join,
) -> Callable[[Any], Any]:
    """A function from the tuple of the fields' values to a message; raises `EncodeError`.

    With `result` it accepts the result of a method: None, a single value, or a tuple of several.
    `join` makes the message of its parts, buffers that include the memory of arrays; it is not
    called for a message of one part, which is bytes.
    """
    return encoder_function(fields, _form(fields, result), join)


def compile_decoder(fields: Fields, *, result: bool = False) -> Callable[[Buffer], Any]:
    """A function from a message to the argument of `compile_encoder`; raises `MalformedMessage`."""
    return decoder_function(fields, _form(fields, result))


def _form(fields: Fields, result: bool) -> str:
    """The Python form of the values: `none`, `one` or `tuple`."""
    if not result or len(fields) > 1:
        return "tuple"
    return "one" if fields else "none"


def encode(value: Struct) -> bytes:
    """One struct as a message. Raises `EncodeError`."""
    return _encoder_of(value._plain_)(value)


def decode(type_: type[R], message: Buffer) -> R:
    """A message as one struct. Raises `MalformedMessage`."""
    return cast("R", _decoder_of(type_)(message))


@once
def _encoder_of(type_: type[Struct]) -> Callable[[Any], bytes]:
    return encoder_function((("", type_),), "one")


@once
def _decoder_of(type_: type[Struct]) -> Callable[[Buffer], Any]:
    return compile_decoder((("", type_),), result=True)


def compile_error_encoder(
    throws: tuple[type[DeclaredError], ...],
) -> Callable[[DeclaredError], bytes]:
    """A function from one of these exceptions to a message: its index, then its fields."""
    encoders = [compile_encoder((("", INT), ("", throw))) for throw in throws]

    def encode_error(error: DeclaredError) -> bytes:
        for index, throw in enumerate(throws):
            if isinstance(error, throw):
                return cast("bytes", encoders[index]((index, error)))
        raise EncodeError(f"{type(error).__name__} is not declared by the operation")

    return encode_error


def compile_error_decoder(
    throws: tuple[type[DeclaredError], ...],
) -> Callable[[Buffer], DeclaredError]:
    """A function from such a message to the exception; raises `MalformedMessage`."""
    decoders = [compile_decoder((("", INT), (throw.__name__, throw))) for throw in throws]

    def decode_error(message: Buffer) -> DeclaredError:
        index = read_number(message, len(throws), "index of the exception")
        return cast("DeclaredError", decoders[index](message)[1])

    return decode_error
