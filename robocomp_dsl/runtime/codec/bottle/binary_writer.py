"""Writes a Bottle in binary form. In: a Bottle. Out: bytes, or `EncodeError`.

Large arrays and blobs are not copied into the parts of a message.
"""

from __future__ import annotations

from typing import Any

import numpy as np

from robocomp_dsl.runtime.codec.bottle.profile import (
    BLOB,
    DICT,
    LIST,
    PROFILE_3,
    STRING,
    Profile,
)
from robocomp_dsl.runtime.codec.bottle.values import (
    FALSE,
    MAX_DEPTH,
    TRUE,
    Bottle,
    Dict,
    Int64,
    Vocab,
)
from robocomp_dsl.runtime.errors import EncodeError

_INT32 = range(-(2**31), 2**31)
_INT64 = range(-(2**63), 2**63)
_MAX_SIZE = 2**31 - 1


LARGE_BYTES = 1 << 14
"""Parts of this size stay what they are."""
_MAX_PARTS = 64


def write_binary(bottle: Bottle, profile: Profile = PROFILE_3) -> bytes:
    """The bytes of a Bottle. Raises `EncodeError` for what no Bottle can contain."""
    return b"".join(_parts(bottle, profile))


def write_parts(bottle: Bottle, profile: Profile = PROFILE_3) -> list[Any]:
    """As `write_binary`, in few parts: large ones are the memory of the values themselves."""
    gathered: list[Any] = []
    small: list[Any] = []
    for part in _parts(bottle, profile):
        if len(part) < LARGE_BYTES or len(gathered) >= _MAX_PARTS:
            small.append(part)
            continue
        if small:
            gathered.append(b"".join(small))
            small = []
        gathered.append(part)
    if small:
        gathered.append(b"".join(small))
    return gathered


def _parts(bottle: Bottle, profile: Profile) -> list[Any]:
    parts: list[Any] = []
    _Writer(profile, parts).nested(bottle, 1)
    return parts


def _word(number: int) -> bytes:
    return number.to_bytes(4, "little")


class _Writer:
    def __init__(self, profile: Profile, parts: list[Any]) -> None:
        self._profile = profile
        self._add = parts.append

    def nested(self, items: Any, depth: int) -> None:
        """A list with its tag."""
        if depth > MAX_DEPTH:
            raise EncodeError(f"lists are nested more than {MAX_DEPTH} deep")
        if len(items) > _MAX_SIZE:
            raise EncodeError(f"a list has at most {_MAX_SIZE} items, not {len(items)}")
        if isinstance(items, np.ndarray):
            self._array(items)
            return
        typed = [self._typed(item) for item in items]
        tags = {tag for tag, _ in typed}
        (common,) = tags if len(tags) == 1 else (LIST,)
        special = common if not common & LIST else 0
        self._add(_word(LIST + special) + _word(len(typed)))
        for tag, item in typed:
            if not special and tag & LIST == 0:
                self._add(_word(tag))
            self._body(tag, item, depth)

    def _array(self, items: np.ndarray[Any, Any]) -> None:
        if not len(items):
            self._add(_word(LIST) + _word(0))
            return
        scalar = self._profile.by_dtype.get(items.dtype.newbyteorder("<"))
        if scalar is None or items.ndim != 1:
            raise EncodeError(f"a Bottle has no lists of {items.dtype.name}, shape {items.shape}")
        self._add(_word(LIST + scalar.tag) + _word(len(items)))
        array = np.ascontiguousarray(items, items.dtype.newbyteorder("<"))
        self._add(array.view(np.uint8).data)

    def _typed(self, item: Any) -> tuple[int, Any]:
        """The tag of a value, and the value in the type that the tag has."""
        kind = type(item)
        if kind is bool:
            item, kind = (TRUE if item else FALSE), Vocab
        elif kind is int and item not in _INT32:
            kind = Int64
        scalar = self._profile.by_type.get(kind)
        if scalar is not None:
            return scalar.tag, item
        if isinstance(item, str):
            return STRING, item.encode(errors="surrogateescape")
        if isinstance(item, bytes | bytearray | memoryview):
            return BLOB, item
        if isinstance(item, Dict):
            return DICT, item
        if isinstance(item, list | np.ndarray):
            return LIST, item
        raise EncodeError(f"a Bottle of YARP {self._profile.version} has no {kind.__name__}")

    def _body(self, tag: int, item: Any, depth: int) -> None:
        scalar = self._profile.by_tag.get(tag)
        if scalar is not None:
            try:
                self._add(scalar.form.pack(item))
            except Exception as error:
                raise EncodeError(f"{item} does not fit into {scalar.type.__name__}") from error
        elif tag == DICT:
            self._add(_word(DICT))
            self.nested(list(item), depth + 1)
        elif tag == LIST:
            self.nested(item, depth + 1)
        else:
            if len(item) > _MAX_SIZE:
                raise EncodeError(f"a string or blob has at most {_MAX_SIZE} bytes")
            self._add(_word(len(item)))
            self._add(item)
