"""Large messages in memory files (memfd), which the sender writes once and receivers map.

In: the parts of a message. Out: a sealed file without a name, and at the receiver a view of it. The
kernel frees the memory with the last descriptor and mapping, however the processes end.
"""

from __future__ import annotations

import contextlib
import fcntl
import mmap
import os
import weakref
from collections.abc import Sequence
from typing import Any

import numpy as np

from robocomp_dsl.runtime.errors import EncodeError, MiddlewareError
from robocomp_dsl.runtime.middleware.local.description import MAX_MESSAGE_BYTES

PADDING = bytes(4)
"""Before the message: the 4 bytes of its own header end at a multiple of 8, so that arrays of
doubles are aligned."""
MAX_VIEWS = 256
"""So many messages may be mapped at a time; each keeps a descriptor. Others are copied."""
_MAX_PARTS = 1000
_SEALS = fcntl.F_SEAL_SHRINK | fcntl.F_SEAL_GROW | fcntl.F_SEAL_WRITE
_views: weakref.WeakSet[mmap.mmap] = weakref.WeakSet()


class MalformedPacket(Exception):
    """A peer sent what is no packet of this protocol; its connection is closed."""


class SharedMessage:
    """A message of `size` bytes; `descriptor` is open as long as this object exists."""

    __slots__ = ("descriptor", "size")

    def __init__(self, parts: Sequence[Any], size: int) -> None:
        self.size = size
        self.descriptor = -1
        if size > MAX_MESSAGE_BYTES:
            raise EncodeError(
                f"{size} bytes are more than a message of `local` may have ({MAX_MESSAGE_BYTES})"
            )
        try:
            self.descriptor = os.memfd_create("robocomp", os.MFD_CLOEXEC | os.MFD_ALLOW_SEALING)
            _write(self.descriptor, [PADDING, *parts])
            fcntl.fcntl(self.descriptor, fcntl.F_ADD_SEALS, _SEALS | fcntl.F_SEAL_SEAL)
        except OSError as error:
            reason = error.strerror or error
            raise MiddlewareError(f"no memory for a message of {size} bytes: {reason}") from None

    def __del__(self) -> None:
        if self.descriptor >= 0:
            with contextlib.suppress(OSError):
                os.close(self.descriptor)


def _write(descriptor: int, parts: list[Any]) -> None:
    if len(parts) > _MAX_PARTS:
        parts = [b"".join(parts)]
    left: list[Any] = [np.frombuffer(part, np.uint8) for part in parts if len(part)]
    while left:
        written = os.writev(descriptor, left)
        while left and written >= len(left[0]):
            written -= len(left.pop(0))
        if left:
            left[0] = left[0][written:]


def map_message(descriptor: int, size: int) -> bytes | memoryview:
    """The message of `size` bytes in a memory file, read-only. Raises `MalformedPacket`.

    Without the seals the sender could truncate the file, and reading would be a bus error.
    """
    total = len(PADDING) + size
    try:
        sealed = fcntl.fcntl(descriptor, fcntl.F_GET_SEALS) & _SEALS == _SEALS
        actual = os.fstat(descriptor).st_size
    except OSError:
        sealed, actual = False, 0
    if not sealed or actual != total or size > MAX_MESSAGE_BYTES:
        raise MalformedPacket("a descriptor is no sealed memory file of the announced size")
    try:
        # Private, because Linux before 6.7 refuses a shared mapping of a sealed file.
        memory = mmap.mmap(
            descriptor, total, flags=mmap.MAP_PRIVATE | mmap.MAP_POPULATE, prot=mmap.PROT_READ
        )
    except OSError as error:
        raise MalformedPacket(f"cannot map {size} bytes: {error.strerror}") from None
    if len(_views) >= MAX_VIEWS:
        with memory:
            return memory[len(PADDING) :]
    _views.add(memory)
    return memoryview(memory)[len(PADDING) :]
