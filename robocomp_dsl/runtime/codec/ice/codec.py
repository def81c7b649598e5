"""Convert values to messages of Ice and back: encoding 1.1 of ZeroC Ice 3.5 and newer.

In: an operation. Out: specialised functions: their source is generated from the schema (`encoder`,
`decoder`). The layout is described in `wire`; values have the Python types of `codec.codec`.

Encoders raise only `EncodeError`, decoders only `MalformedMessage`. Decoded arrays are read-only;
`copy()` them before changing them.
"""

from __future__ import annotations

from collections.abc import Callable
from typing import TYPE_CHECKING, Any, TypeAlias, cast

from robocomp_dsl.runtime.codec.ice import wire
from robocomp_dsl.runtime.codec.ice.decoder import decoder_function
from robocomp_dsl.runtime.codec.ice.encoder import encoder_function
from robocomp_dsl.runtime.codec.ice.read import Reader
from robocomp_dsl.runtime.data.declared_error import DeclaredError
from robocomp_dsl.runtime.data.schema import STRING, Fields
from robocomp_dsl.runtime.errors import EncodeError, MalformedMessage
from robocomp_dsl.slice_identifiers import valid_path

if TYPE_CHECKING:
    from robocomp_dsl.runtime.component.interface import Operation

Encoder: TypeAlias = Callable[[Any], bytes]
Decoder: TypeAlias = Callable[[bytes], Any]

_LAST_SLICE, _HAS_SIZE, _HAS_OPTIONAL = 0x20, 0x10, 0x04
_MAX_SLICES = 32
"""No declared exception is derived; more slices than in any program are not read."""


class UnknownException(Exception):
    """An exception that the operation does not declare; the text is its type id."""


def request_encoder(operation: Operation) -> Encoder:
    """A function from the tuple of arguments to bytes."""
    return encoder_function(operation.inputs, "tuple", _in_order(operation.inputs))


def request_decoder(operation: Operation) -> Decoder:
    """A function from bytes to the tuple of arguments."""
    return decoder_function(operation.inputs, "tuple", _in_order(operation.inputs))


def reply_encoder(operation: Operation) -> Encoder:
    """A function from the result of a servant to bytes."""
    outputs = operation.outputs
    return encoder_function(outputs, _form(outputs), _result_last(outputs))


def reply_decoder(operation: Operation) -> Decoder:
    """A function from bytes to the result of a proxy."""
    outputs = operation.outputs
    return decoder_function(outputs, _form(outputs), _result_last(outputs))


def _form(outputs: Fields) -> str:
    """The Python form of a result: `none`, `one` or `tuple`."""
    return ("none", "one")[len(outputs)] if len(outputs) < 2 else "tuple"


def _in_order(fields: Fields) -> tuple[int, ...]:
    return tuple(range(len(fields)))


def _result_last(outputs: Fields) -> tuple[int, ...]:
    """Out parameters are encoded before the result, which has no name."""
    order = _in_order(outputs)
    return (*order[1:], 0) if outputs and not outputs[0][0] else order


def type_id(exception: type[DeclaredError], module: str) -> str:
    """The name of an exception on the wire; `module` is for types that were written by hand."""
    return f"::{valid_path(exception._type_id_ or f'{module}::{exception.__name__}')}"


def error_encoder(
    throws: tuple[type[DeclaredError], ...], module: str
) -> Callable[[DeclaredError], bytes]:
    """A function from one of these exceptions to bytes: one slice, in the compact format."""
    slices = [
        (throw, _slice_head(throw, module), encoder_function((("", throw),), "one", (0,)))
        for throw in throws
    ]

    def encode_error(error: DeclaredError) -> bytes:
        for throw, head, encode in slices:
            if isinstance(error, throw):
                return wire.encapsulation(head + encode(error)[wire.HEADER.size :])
        raise EncodeError(f"{type(error).__name__} is not declared by the operation")

    return encode_error


def _slice_head(throw: type[DeclaredError], module: str) -> bytes:
    name = type_id(throw, module).encode()
    return bytes([_LAST_SLICE]) + wire.size_bytes(len(name)) + name


def error_decoder(
    throws: tuple[type[DeclaredError], ...], module: str
) -> Callable[[bytes], DeclaredError]:
    """A function from bytes to the exception.

    A derived exception of a peer is read as its declared base. Raises `UnknownException` for any
    other exception.
    """
    classes = {type_id(throw, module): throw for throw in throws}

    def decode_error(message: bytes) -> DeclaredError:
        reader = Reader(message)
        first = ""
        for _ in range(_MAX_SLICES):
            start = reader.at
            has = reader.number("B", "flags of the exception")
            name = reader.text(STRING, "type id of the exception")
            first = first or name
            end = _slice_end(reader) if has & _HAS_SIZE else 0
            if name in classes:
                value = cast("DeclaredError", reader.record(classes[name], name))
                if end and reader.at != end and not has & _HAS_OPTIONAL:
                    raise MalformedMessage("the size of the slice is wrong", name, start)
                if has & _LAST_SLICE and not has & _HAS_OPTIONAL:
                    reader.finish()
                return value
            if not end or has & _LAST_SLICE:
                break
            reader.at = end
        raise UnknownException(first)

    return decode_error


def _slice_end(reader: Reader) -> int:
    """The offset after a slice that has a size; the size includes its own 4 bytes."""
    start = reader.at
    size: int = reader.number("i", "size of the slice")
    if size < 4 or start + size > len(reader.data):
        left = len(reader.data) - start
        raise MalformedMessage(f"a slice of {size} bytes, {left} left", "", start)
    return start + size
