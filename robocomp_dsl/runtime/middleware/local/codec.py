"""Encoders that write large messages directly into memory files.

In: the fields of an operation. Out: functions from values to bytes, or to a `SharedMessage` if they
are more than `INLINE_BYTES`. The memory of an array is copied once, into the memory file.
"""

from __future__ import annotations

from collections.abc import Callable
from typing import Any, TypeAlias

import numpy as np

from robocomp_dsl.runtime.codec.codec import compile_encoder
from robocomp_dsl.runtime.data.schema import Array, Dictionary, Enum, Fields, Primitive, Sequence
from robocomp_dsl.runtime.data.struct import Struct
from robocomp_dsl.runtime.middleware.local.memory_pool import MemoryPool, SharedMessage
from robocomp_dsl.runtime.middleware.local.packets import INLINE_BYTES

Message: TypeAlias = "bytes | SharedMessage"


def message_encoder(
    fields: Fields, pool: MemoryPool, *, result: bool = False
) -> Callable[[Any], Message]:
    """A function from values to a message, as `compile_encoder`. Raises as `MemoryPool.message`."""
    if _has_arrays(type_ for _, type_ in fields):
        return _by_parts(compile_encoder(fields, result=result, join=tuple), pool)
    encode = compile_encoder(fields, result=result)

    def encode_message(values: Any) -> Message:
        data = encode(values)
        return data if len(data) <= INLINE_BYTES else pool.message((data,), len(data))

    return encode_message


def _by_parts(encode: Callable[[Any], Any], pool: MemoryPool) -> Callable[[Any], Message]:
    ndarray, join = np.ndarray, b"".join

    def encode_message(values: Any) -> Message:
        parts = encode(values)
        if parts.__class__ is bytes:
            return parts
        size = 0
        for part in parts:
            size += part.nbytes if part.__class__ is ndarray else len(part)
        return join(parts) if size <= INLINE_BYTES else pool.message(parts, size)

    return encode_message


def _has_arrays(types: Any) -> bool:
    """Whether values of these types contain arrays, whose memory is a part of the message."""
    for type_ in types:
        match type_:
            case Primitive():
                continue
            case Array():
                return True
            case Sequence():
                inner: Any = (type_.element,)
            case Dictionary():
                inner = (type_.key, type_.value)
            case _ if issubclass(type_, Enum):
                continue
            case _ if issubclass(type_, Struct):
                inner = [field for _, field in type_._fields_]
            case _:
                return True
        if _has_arrays(inner):
            return True
    return False
