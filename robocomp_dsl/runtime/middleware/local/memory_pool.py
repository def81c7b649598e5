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
import mmap
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
        self._files: list[MemoryFile] = []
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

    def _take(self, size: int) -> MemoryFile:
        """A file that nobody reads."""
        capacity = 1 << (size - 1).bit_length()
        with self._lock:
            for file in self._files:
                if file.capacity == capacity and file.is_free():
                    self._files.remove(file)
                    return file
        return MemoryFile(capacity)

    def _give_back(self, file: MemoryFile) -> None:
        now = file.used_at = time.monotonic()
        with self._lock:
            self._files.append(file)
            total = sum(each.capacity for each in self._files)
            while self._files and (
                total > MAX_POOL_BYTES
                or len(self._files) > MAX_FILES
                or now - self._files[0].used_at > IDLE_S
            ):
                total -= self._files.pop(0).capacity


class MemoryFile:
    """A file without a name; of its capacity, only written pages use memory."""

    def __init__(self, capacity: int) -> None:
        self.capacity = capacity
        self.used_at = 0.0
        self.is_written = False
        self._memory: np.ndarray[Any, np.dtype[np.uint8]] | None = None
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
        """Write at the beginning: new pages by a system call, which does not clear them first."""
        if len(parts) > _MAX_PARTS:
            parts = [b"".join(parts)]
        sources: list[Any] = [np.frombuffer(part, np.uint8) for part in parts if len(part)]
        if not self.is_written:
            self._write_new(sources)
            self.is_written = True
            return
        if self._memory is None:
            self._memory = np.frombuffer(mmap.mmap(self._descriptor, self.capacity), np.uint8)
        start = 0
        for source in sources:
            self._memory[start : start + source.size] = source
            start += source.size

    def _write_new(self, sources: list[Any]) -> None:
        offset = 0
        while sources:
            written = os.pwritev(self._descriptor, sources, offset)
            offset += written
            while sources and written >= len(sources[0]):
                written -= len(sources.pop(0))
            if sources:
                sources[0] = sources[0][written:]

    def __del__(self) -> None:
        if self._descriptor >= 0:
            with contextlib.suppress(OSError):
                os.close(self._descriptor)
