"""The end of what a running command writes to its standard error.

It is read all the time: a command whose errors nobody reads stops when the pipe is full.
"""

from __future__ import annotations

import asyncio
from collections.abc import Awaitable, Callable
from contextlib import suppress

TAIL_BYTES = 65536


class ErrorTail:
    """Reads with `read` until it returns nothing; keeps the last `TAIL_BYTES`."""

    def __init__(self, read: Callable[[int], Awaitable[bytes]]) -> None:
        self._read = read
        self._tail = b""
        self._task = asyncio.get_running_loop().create_task(self._drain())

    async def _drain(self) -> None:
        with suppress(Exception):  # a lost connection is reported by the standard output
            while chunk := await self._read(TAIL_BYTES):
                self._tail = (self._tail + chunk)[-TAIL_BYTES:]

    async def finish(self) -> bytes:
        """What is left at the end."""
        await self._task
        return self._tail

    def cancel(self) -> None:
        """Stop reading."""
        self._task.cancel()
