"""Reads a Bottle in binary form. In: bytes, or a stream. Out: a Bottle, or `MalformedMessage`.

Memory is bounded by the bytes that have arrived: no count of a message is trusted. Large arrays and
blobs (a `memoryview`) share the memory of the message; small ones are copied, so that they do not
keep it.
"""

from __future__ import annotations

from collections.abc import Callable
from typing import Any, TypeAlias

import numpy as np

from robocomp_dsl.runtime.codec.bottle.profile import (
    BLOB,
    DICT,
    LIST,
    STRING,
    BottleScalar,
    Profile,
)
from robocomp_dsl.runtime.codec.bottle.values import MAX_DEPTH, Bottle, Dict
from robocomp_dsl.runtime.errors import MalformedMessage

Bytes: TypeAlias = bytes | memoryview
_SHARED_BYTES = 1 << 14


def read_binary(data: Bytes, profile: Profile) -> Bottle:
    """The Bottle that `data` is. Raises `MalformedMessage`."""
    at = 0
    is_shared = len(data) > _SHARED_BYTES
    data = memoryview(data).toreadonly() if is_shared else bytes(data)

    def take(size: int) -> Bytes:
        nonlocal at
        if size > len(data) - at:
            raise MalformedMessage(f"needs {size} bytes, {len(data) - at} are left", "", at)
        at += size
        return data[at - size : at]

    reader = _Reader(take, profile)
    bottle = reader.bottle()
    if at != len(data):
        raise MalformedMessage(f"{len(data) - at} bytes more than the Bottle has", "", at)
    return bottle


def read_stream(take: Callable[[int], Bytes], profile: Profile) -> tuple[Bottle, int]:
    """A Bottle from a stream, and its size in bytes.

    `take` returns the next bytes; it raises what it likes if they do not arrive, or are too many.
    """
    reader = _Reader(take, profile)
    return reader.bottle(), reader.offset


class _Reader:
    def __init__(self, take: Callable[[int], Bytes], profile: Profile) -> None:
        self._source = take
        self._profile = profile
        self.offset = 0

    def _take(self, size: int) -> Bytes:
        data = self._source(size)
        self.offset += size
        return data

    def _int(self) -> int:
        return int.from_bytes(self._take(4), "little", signed=True)

    def _count(self) -> int:
        count = self._int()
        if count < 0:
            raise MalformedMessage(f"{count} is no count", "", self.offset - 4)
        return count

    def bottle(self) -> Bottle:
        """The whole message."""
        tag = self._int()
        if not tag & LIST or tag == DICT:
            raise MalformedMessage(f"starts with the tag {tag}, which is no list", "", 0)
        return self._list(tag, 1)

    def _list(self, tag: int, depth: int) -> Bottle:
        """The body of a list."""
        if depth > MAX_DEPTH:
            what = f"lists are nested more than {MAX_DEPTH} deep"
            raise MalformedMessage(what, "", self.offset)
        count = self._count()
        inner = tag - LIST
        if not inner:
            return [self._item(self._int(), depth) for _ in range(count)]
        scalar = self._profile.by_tag.get(inner)
        if scalar is not None and scalar.dtype is not None:
            data = self._take(count * scalar.dtype.itemsize)
            array = np.frombuffer(data, scalar.dtype)
            if isinstance(data, memoryview) and not _is_shareable(array):
                array = np.frombuffer(bytes(data), scalar.dtype)
            return array
        if scalar is None and inner not in {STRING, BLOB}:
            raise self._unknown(tag)
        return [self._value(inner, scalar) for _ in range(count)]

    def _item(self, tag: int, depth: int) -> Any:
        scalar = self._profile.by_tag.get(tag)
        if scalar is not None or tag in {STRING, BLOB}:
            return self._value(tag, scalar)
        if tag == DICT:
            inner = self._int()
            if not inner & LIST or inner == DICT:
                raise self._unknown(inner)
            items = self._list(inner, depth + 1)
            if isinstance(items, np.ndarray):
                kind = self._profile.by_tag[inner - LIST].type
                return Dict(kind(item) for item in items.tolist())
            return Dict(items)
        if not tag & LIST:
            raise self._unknown(tag)
        return self._list(tag, depth + 1)

    def _value(self, tag: int, scalar: BottleScalar | None) -> Any:
        if scalar is not None:
            (number,) = scalar.form.unpack(self._take(scalar.form.size))
            return number if scalar.type in {int, float} else scalar.type(number)
        data = self._take(self._count())
        if tag == STRING:
            # Older peers send other encodings; `surrogateescape` keeps their bytes.
            return str(data, "utf-8", "surrogateescape")
        return data if len(data) > _SHARED_BYTES else bytes(data)

    def _unknown(self, tag: int) -> MalformedMessage:
        version = self._profile.version
        hint = "" if version > 3 or tag not in {18, 20, 274, 276} else "; is the peer YARP 4?"
        return MalformedMessage(f"YARP {version} has no tag {tag}{hint}", "", self.offset - 4)


def _is_shareable(array: np.ndarray[Any, Any]) -> bool:
    return array.nbytes > _SHARED_BYTES and array.flags.aligned
