"""The receiving side of large messages: the memory files of a peer, mapped.

In: descriptors from a peer. Out: read-only views of messages; arrays are decoded without a copy. A
file that the peer uses again is mapped already. Each message has a descriptor with a shared lock,
which is closed with the last array of the message: then the peer may write the next message.
"""

from __future__ import annotations

import fcntl
import mmap
import os
import weakref

import numpy as np

from robocomp_dsl.runtime.middleware.local.description import MAX_MESSAGE_BYTES
from robocomp_dsl.runtime.middleware.local.memory_pool import PADDING

MAX_FILES = 16
MAX_MAPPED_BYTES = 1 << 28
"""What stays mapped for a connection, beside the messages that are in use."""
MAX_VIEWS = 256
"""So many messages may be in use at a time; each keeps a descriptor. Others are copied."""
_views: set[int] = set()


class MalformedPacket(Exception):
    """A peer sent what is no packet of this protocol; its connection is closed."""


class MappedFiles:
    """The files of one connection."""

    def __init__(self) -> None:
        self._files: dict[tuple[int, int], mmap.mmap] = {}

    def clear(self) -> None:
        """Forget all files; messages in use stay mapped."""
        self._files.clear()

    def view(self, descriptor: int, size: int) -> bytes | memoryview:
        """The message of `size` bytes in a memory file. Raises `MalformedPacket`.

        It closes the descriptor, at once or with the last use of the message.
        """
        try:
            memory = self._map(descriptor, len(PADDING) + size)
        except (OSError, ValueError) as error:
            os.close(descriptor)
            raise MalformedPacket(f"cannot map {size} bytes: {error}") from None
        except MalformedPacket:
            os.close(descriptor)
            raise
        if len(_views) >= MAX_VIEWS:
            copied = memory[len(PADDING) : len(PADDING) + size]
            os.close(descriptor)
            return copied
        message = np.frombuffer(memory, np.uint8, size, len(PADDING))
        _views.add(descriptor)
        weakref.finalize(message, _release, descriptor).atexit = False
        return message.data

    def _map(self, descriptor: int, size: int) -> mmap.mmap:
        """The memory of a file, which the peer cannot truncate: reading would be a bus error."""
        status = os.fstat(descriptor)
        key = status.st_dev, status.st_ino
        memory = self._files.pop(key, None)
        if memory is None:
            memory = _map_whole(descriptor, status.st_size)
        self._files[key] = memory
        self._limit()
        if len(memory) < size or size > MAX_MESSAGE_BYTES + len(PADDING):
            raise MalformedPacket("a memory file is shorter than its message")
        return memory

    def _limit(self) -> None:
        """Forget the files that were not used for the longest time."""
        total = sum(map(len, self._files.values()))
        while len(self._files) > 1 and (total > MAX_MAPPED_BYTES or len(self._files) > MAX_FILES):
            total -= len(self._files.pop(next(iter(self._files))))


def _map_whole(descriptor: int, size: int) -> mmap.mmap:
    try:
        sealed = fcntl.fcntl(descriptor, fcntl.F_GET_SEALS) & fcntl.F_SEAL_SHRINK
    except OSError:
        sealed = 0
    if not sealed or not size:
        raise MalformedPacket("a descriptor is no sealed memory file")
    # The mapping must not keep the lock of this message.
    reopened = os.open(f"/proc/self/fd/{descriptor}", os.O_RDONLY | os.O_CLOEXEC)
    try:
        return mmap.mmap(reopened, size, prot=mmap.PROT_READ)
    finally:
        os.close(reopened)


def _release(descriptor: int) -> None:
    _views.discard(descriptor)
    os.close(descriptor)
