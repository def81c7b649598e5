"""The sending side of large messages: memory files (memfd) that are written again and again.

In: the parts of a message. Out: a `SharedMessage`, whose descriptor goes to the receivers. To
allocate pages takes longer than to write them, so a file is used again when nobody reads it. The
kernel knows: each message has a descriptor of its own with a shared lock (`flock`), which ends when
all its copies are closed, in sockets and in all receivers. A killed receiver holds nothing, and the
memory of a file is freed with its last descriptor and mapping.
"""

from __future__ import annotations

import contextlib
import fcntl
import os
import threading
import time
from collections.abc import Sequence
from typing import Any

import numpy as np

from robocomp_dsl.runtime.errors import EncodeError, MiddlewareError
from robocomp_dsl.runtime.middleware.local.description import MAX_MESSAGE_BYTES

PADDING = bytes(4)
"""Before the message: the 4 bytes of its own header end at a multiple of 8, so that arrays of
doubles are aligned."""
MAX_FILES = 16
MAX_POOL_BYTES = 1 << 28
"""The files that a component keeps; those in use by receivers may be more."""
IDLE_S = 10.0
"""Files that were not used for so long are not kept beside a new message."""
_MAX_PARTS = 1000


class SharedMessage:
    """A message of `size` bytes; `descriptor` is read-only, and open while this object exists."""

    __slots__ = ("descriptor", "size")

    def __init__(self, descriptor: int, size: int) -> None:
        self.descriptor = descriptor
        self.size = size

    def __del__(self) -> None:
        with contextlib.suppress(OSError):
            os.close(self.descriptor)


class MemoryPool:
    """The memory files of one component."""

    def __init__(self) -> None:
        self._files: list[_MemoryFile] = []
        self._lock = threading.Lock()

    def message(self, parts: Sequence[Any], size: int) -> SharedMessage:
        """A message of these parts, `size` bytes together; each byte is copied once.

        Raises `EncodeError` if it is too long, and `MiddlewareError` without memory.
        """
        if size > MAX_MESSAGE_BYTES:
            raise EncodeError(
                f"{size} bytes are more than a message of `local` may have ({MAX_MESSAGE_BYTES})"
            )
        try:
            file = self._take(len(PADDING) + size)
            file.write([PADDING, *parts])
            message = SharedMessage(file.open_for_reading(), size)
        except OSError as error:
            reason = error.strerror or error
            raise MiddlewareError(f"no memory for a message of {size} bytes: {reason}") from None
        self._give_back(file)
        return message

    def _take(self, size: int) -> _MemoryFile:
        """A file that nobody reads."""
        capacity = 1 << (size - 1).bit_length()
        with self._lock:
            for file in self._files:
                if file.capacity == capacity and file.is_free():
                    self._files.remove(file)
                    return file
        return _MemoryFile(capacity)

    def _give_back(self, file: _MemoryFile) -> None:
        now = file.used_at = time.monotonic()
        with self._lock:
            self._files.append(file)
            total = sum(each.capacity for each in self._files)
            while (
                total > MAX_POOL_BYTES
                or len(self._files) > MAX_FILES
                or (now - self._files[0].used_at > IDLE_S)
            ):
                total -= self._files.pop(0).capacity


class _MemoryFile:
    """A file without a name; of its capacity, only written pages use memory."""

    def __init__(self, capacity: int) -> None:
        self.capacity = capacity
        self.used_at = 0.0
        self._descriptor = -1
        created = os.memfd_create("robocomp", os.MFD_CLOEXEC | os.MFD_ALLOW_SEALING)
        try:
            os.ftruncate(created, capacity)
            seals = fcntl.F_SEAL_SHRINK | fcntl.F_SEAL_GROW | fcntl.F_SEAL_SEAL
            fcntl.fcntl(created, fcntl.F_ADD_SEALS, seals)
        except BaseException:
            os.close(created)
            raise
        self._descriptor = created

    def is_free(self) -> bool:
        """Whether no message in it is on its way or in use, in whatever process."""
        try:
            fcntl.flock(self._descriptor, fcntl.LOCK_EX | fcntl.LOCK_NB)
        except OSError:
            return False
        fcntl.flock(self._descriptor, fcntl.LOCK_UN)
        return True

    def open_for_reading(self) -> int:
        """A descriptor for one message, with its lock."""
        path = f"/proc/self/fd/{self._descriptor}"
        descriptor = os.open(path, os.O_RDONLY | os.O_CLOEXEC)
        fcntl.flock(descriptor, fcntl.LOCK_SH | fcntl.LOCK_NB)
        return descriptor

    def write(self, parts: list[Any]) -> None:
        """Write at the beginning."""
        if len(parts) > _MAX_PARTS:
            parts = [b"".join(parts)]
        left: list[Any] = [np.frombuffer(part, np.uint8) for part in parts if len(part)]
        offset = 0
        while left:
            written = os.pwritev(self._descriptor, left, offset)
            offset += written
            while left and written >= len(left[0]):
                written -= len(left.pop(0))
            if left:
                left[0] = left[0][written:]

    def __del__(self) -> None:
        if self._descriptor >= 0:
            with contextlib.suppress(OSError):
                os.close(self._descriptor)
