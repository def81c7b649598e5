"""Finds out when a program without lifecycle is ready: by its output, a port, or time.

In: a `Readiness`, the lines of the program's output. Out: one call when it is ready.
"""

from __future__ import annotations

import asyncio
import re
from collections.abc import Callable
from contextlib import suppress

from robocomp_dsl.model.deployment import Readiness

PORT_PROBE_S = 0.1
"""Time between two attempts to connect, and the limit of one."""
_HOSTS = ("127.0.0.1", "::1")


class ReadinessProbe:
    """Probes one start of a program, until it is ready or `close` is called."""

    def __init__(self, readiness: Readiness, on_ready: Callable[[], None]) -> None:
        self._on_ready = on_ready
        self._pattern = re.compile(readiness.pattern) if readiness.pattern else None
        self._task: asyncio.Task[None] | None = None
        if readiness.port or readiness.delay_s:
            self._task = asyncio.get_running_loop().create_task(self._wait(readiness))

    def observe(self, text: str) -> None:
        """A line of output."""
        if self._pattern and self._pattern.search(text):
            self._pattern = None
            self._on_ready()

    def close(self) -> None:
        """Stop probing."""
        self._pattern = None
        if self._task:
            self._task.cancel()

    async def _wait(self, readiness: Readiness) -> None:
        if readiness.delay_s:
            await asyncio.sleep(readiness.delay_s)
        else:
            while not await _answers(readiness.port):
                await asyncio.sleep(PORT_PROBE_S)
        self._on_ready()


async def _answers(port: int) -> bool:
    """Whether something accepts connections at `port` of loopback."""
    for host in _HOSTS:
        with suppress(OSError, TimeoutError):
            connecting = asyncio.open_connection(host, port)
            _, writer = await asyncio.wait_for(connecting, PORT_PROBE_S)
            writer.close()
            return True
    return False
