"""Undeclares publishers and queriers before their session is closed.

zenoh 1.10 keeps a closed session, with a descriptor and a file in /dev/shm, if a publisher or a
querier of it was not undeclared before.
"""

from __future__ import annotations

import contextlib
from typing import Any

import zenoh


def undeclare(declared: list[Any]) -> None:
    """Undeclare and remove all entries; those that a thread uses at this moment stay declared."""
    while declared:
        # RuntimeError: another thread is in a method of the object.
        with contextlib.suppress(zenoh.ZError, RuntimeError):
            declared.pop().undeclare()
