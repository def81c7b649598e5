"""Decodes CDR that other ROS implementations wrote.

In: a decoder of an operation. Out: a decoder that accepts padding at the end of a message: the
serializers of ROS 2 round its size up to a multiple of 4 and leave any bytes there.
"""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

from robocomp_dsl.runtime.errors import MalformedMessage

_MAX_PADDING = 3


def padded(decode: Callable[[bytes], Any]) -> Callable[[bytes], Any]:
    """`decode`, for messages with up to 3 bytes of padding; raises `MalformedMessage`."""

    def decode_padded(data: bytes) -> Any:
        try:
            return decode(data)
        except MalformedMessage as error:
            # The error of excess bytes names the position where the message ended.
            if error.path or not 4 < error.offset < len(data) <= error.offset + _MAX_PADDING:
                raise
            return decode(data[: error.offset])

    return decode_padded
