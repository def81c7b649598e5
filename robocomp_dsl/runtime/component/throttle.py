"""Limits the rate of repeated log messages."""

from __future__ import annotations

import time

INTERVAL_S = 10.0


class Throttle:
    """Allows each key once per `INTERVAL_S`."""

    def __init__(self) -> None:
        self._allowed_at: dict[str, float] = {}

    def allows(self, key: str) -> bool:
        """Whether `key` has not been allowed within the interval; it is then allowed now."""
        now = time.monotonic()
        if now - self._allowed_at.get(key, -INTERVAL_S) < INTERVAL_S:
            return False
        self._allowed_at[key] = now
        return True

    def clear(self) -> None:
        """Allow every key again."""
        self._allowed_at.clear()
