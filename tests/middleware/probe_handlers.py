"""Handlers of the interface Probe."""

from __future__ import annotations

import threading

from tests.middleware.network import DEADLINE
from tests.middleware.probe_types import Broken


def divide(a: int, b: int) -> tuple[int, int]:
    if b == 0:
        raise Broken(7, "by zero")
    return divmod(a, b)


def blocked(free: threading.Event) -> None:
    free.wait(DEADLINE)


def fail() -> None:
    raise KeyError("no such thing")


HANDLERS = {
    "add": lambda a, b: a + b,
    "divide": divide,
    "echo": lambda v: v,
    "fail": fail,
}
