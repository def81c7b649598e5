"""The values of a Bottle in Python.

In: Python values. Out: the wire type of each. A Bottle is a list, or a numpy array: a list whose
items are numbers of one type. `int` is an int32, or an int64 if it does not fit; `float` is a
float64, `str` a string, `bytes` a blob, `bool` a vocab.
"""

from __future__ import annotations

import math
from typing import Any, TypeAlias

import numpy as np

Bottle: TypeAlias = "list[Any] | np.ndarray[Any, Any]"
MAX_DEPTH = 64
"""Deeper nested lists are refused; the depth of the message itself is 1."""


class Int8(int):
    """An integer of 8 bits."""

    __slots__ = ()


class Int16(int):
    """An integer of 16 bits."""

    __slots__ = ()


class Int64(int):
    """An integer of 64 bits, whatever its value."""

    __slots__ = ()


class Float32(float):
    """A float of 32 bits."""

    __slots__ = ()


class Vocab(int):
    """Up to four characters as an int32, the first one in the lowest byte."""

    __slots__ = ()

    @property
    def text(self) -> str:
        """The characters."""
        return (self & 0xFFFFFFFF).to_bytes(4, "little").rstrip(b"\0").decode("latin-1")


class Vocab64(int):
    """Up to eight characters as an int64 (YARP 4)."""

    __slots__ = ()

    @property
    def text(self) -> str:
        """The characters."""
        return (self & (2**64 - 1)).to_bytes(8, "little").rstrip(b"\0").decode("latin-1")


class Dict(list[Any]):
    """A dictionary: a list of (key value) lists."""

    __slots__ = ()


def vocab(text: str) -> Vocab:
    """The vocab of up to four characters of Latin-1; longer texts are cut."""
    data = text.encode("latin-1", "replace")[:4].ljust(4, b"\0")
    return Vocab(int.from_bytes(data, "little", signed=True))


def vocab64(text: str) -> Vocab64:
    """The vocab of up to eight characters of Latin-1; longer texts are cut."""
    data = text.encode("latin-1", "replace")[:8].ljust(8, b"\0")
    return Vocab64(int.from_bytes(data, "little", signed=True))


TRUE = vocab("1")
FALSE = Vocab(0)


def is_word(value: Any, text: str) -> bool:
    """Whether a value is this word, as a vocab or as a string."""
    if isinstance(value, Vocab):
        return value == vocab(text) and len(text) <= 4
    return isinstance(value, str) and value == text


def identical(a: Any, b: Any) -> bool:
    """Whether two values have the same wire types and contents; NaN is identical to NaN."""
    if isinstance(a, np.ndarray) and isinstance(b, np.ndarray):
        has_nan = a.dtype.kind == "f"
        return a.dtype == b.dtype and np.array_equal(a, b, equal_nan=has_nan)
    if type(a) is not type(b):
        return False
    if isinstance(a, list):
        return len(a) == len(b) and all(map(identical, a, b))
    return bool(a == b) or (isinstance(a, float) and math.isnan(a) and math.isnan(b))
