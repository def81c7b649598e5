"""Waits a moment for a reply before the thread sleeps.

In: a socket. Out: `wait`, which returns when a reply has come, or soon. To wake a sleeping thread
takes longer than a call, above all on an idle processor. Each look yields the processor, so that
the other side can run on it. A wait in vain switches this off for a while.
"""

from __future__ import annotations

import os
import select
import socket
from collections.abc import Callable
from typing import Any

LOOKS = 60
"""So often; about 1 us each. A server on a processor that sleeps needs up to 50 us to reply."""
WAITS_WITHOUT = 31
"""So many waits after one in vain return at once."""


class BriefPoll:
    """The waits of one connection."""

    __slots__ = ("_poll", "_without")

    def __init__(self, opened: socket.socket) -> None:
        poll = select.poll()
        poll.register(opened, select.POLLIN)
        self._poll: Callable[[int], Any] = poll.poll
        self._without = 0

    def wait(self) -> None:
        """Return when a reply has come, or soon."""
        if self._without:
            self._without -= 1
            return
        poll, give_way = self._poll, os.sched_yield
        for _ in range(LOOKS):
            if poll(0):
                return
            give_way()
        self._without = WAITS_WITHOUT
