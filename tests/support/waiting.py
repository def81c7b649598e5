"""Waiting for a condition with a deadline, for tests of threads and processes."""

from __future__ import annotations

import time
from collections.abc import Callable
from typing import TypeVar

T = TypeVar("T")

PERIOD_S = 0.005


def wait_until(
    condition: Callable[[], T], message: str | Callable[[], str] = "", timeout: float = 30.0
) -> T:
    """Poll `condition` until it is true, and return its value.

    Raises `AssertionError` with `message` (a string, or a function called at the end, for what only
    the end shows) after `timeout` seconds.
    """
    deadline = time.monotonic() + timeout
    while not (value := condition()):
        if time.monotonic() > deadline:
            text = message() if callable(message) else message
            raise AssertionError(f"not reached within {timeout} s: {text or condition}")
        time.sleep(PERIOD_S)
    return value
