"""What is derived from a class is made once. In: a function of a class. Out: the same, cached.

`functools.cache` does not pass a strict type check here: a class whose instances define `__hash__`
is taken for not hashable.
"""

from __future__ import annotations

from collections.abc import Callable
from typing import Any, TypeVar

R = TypeVar("R")


def once(make: Callable[[type[Any]], R]) -> Callable[[type[Any]], R]:
    """`make`, whose first result for every class is kept; safe to call from several threads."""
    made: dict[type[Any], R] = {}

    def get(cls: type[Any]) -> R:
        if cls not in made:
            made.setdefault(cls, make(cls))
        return made[cls]

    return get
