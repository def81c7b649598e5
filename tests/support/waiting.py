"""Waiting for a condition with a deadline, for tests of threads and processes."""

from __future__ import annotations

import time
from collections.abc import Callable
from typing import TypeVar

T = TypeVar("T")

PERIOD_S = 0.005
TIMEOUT_S = 120.0
"""Long, so that a busy machine fails no test; only a test that fails waits so long."""


def wait_until(
    condition: Callable[[], T],
    message: str | Callable[[], str] = "",
    timeout: float = TIMEOUT_S,
    *,
    ignoring: type[Exception] | tuple[type[Exception], ...] = (),
) -> T:
    """Poll `condition` until it is true, and return its value.

    An exception of a type in `ignoring` counts as false: a peer that is not there yet.

    Raises `AssertionError` with `message` (a string, or a function called at the end, for what only
    the end shows) after `timeout` seconds.
    """
    deadline = time.monotonic() + timeout
    while True:
        try:
            if value := condition():
                return value
        except ignoring:
            pass
        if time.monotonic() > deadline:
            text = message() if callable(message) else message
            raise AssertionError(f"not reached within {timeout} s: {text or condition}")
        time.sleep(PERIOD_S)
