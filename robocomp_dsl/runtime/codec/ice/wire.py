"""Layout of Ice's encapsulations and sizes, shared by encoders and decoders.

The format is encoding 1.1 of ZeroC Ice 3.5 and newer (Ice 3.7 manual, "The Ice Protocol"): little
endian, no alignment. An encapsulation is its size in 4 bytes, the version in 2, and the values. A
size is one byte below 255, else 255 and 4 bytes. An enum is the size of its value.
"""

from __future__ import annotations

import struct

HEADER = struct.Struct("<iH")
"""Size of the encapsulation with this header, and the version as a little-endian number."""

VERSION = 0x0101
MAX_BYTE = 254
"""The largest size of one byte."""

SMALL = tuple(bytes([number]) for number in range(MAX_BYTE + 1))
"""The sizes of one byte."""

_LARGE = struct.Struct("<Bi")


def large(number: int) -> bytes:
    """A size of 255 or more. Raises `struct.error` above 2^31 - 1."""
    return _LARGE.pack(255, number)


def size_bytes(number: int) -> bytes:
    """A size. Raises `struct.error` or `IndexError` for numbers that are no size."""
    return SMALL[number] if 0 <= number <= MAX_BYTE else large(number)


def encapsulation(body: bytes) -> bytes:
    """`body` with its header."""
    return HEADER.pack(len(body) + HEADER.size, VERSION) + body


EMPTY = encapsulation(b"")
