"""Cache for a value derived from a class. In: a function of a class. Out: the cached function.

The value is stored in the class, so that both are freed together. `functools.cache` would keep
every class alive, and fails a strict type check here: a class whose instances define `__hash__`
is considered unhashable.
"""

from __future__ import annotations

import sys
from collections.abc import Callable
from threading import Lock
from typing import Any, TypeVar

R = TypeVar("R")

_storing = Lock()
_MISSING = (None, None)


def once(make: Callable[[type[Any]], R]) -> Callable[[type[Any]], R]:
    """`make` with its first result cached for every class; thread-safe."""
    # Python's attribute cache only finds interned names.
    name = sys.intern(f"_cached_{make.__module__}.{make.__qualname__}")

    def get(cls: type[Any]) -> R:
        pair: tuple[type[Any] | None, Any] = getattr(cls, name, _MISSING)
        if pair[0] is cls:  # otherwise the value of a base class
            found: R = pair[1]
            return found
        return stored(cls)

    def stored(cls: type[Any]) -> R:
        value = make(cls)
        with _storing:
            if name not in cls.__dict__:  # otherwise another thread was faster
                setattr(cls, name, (cls, value))
        first: R = cls.__dict__[name][1]
        return first

    return get
