"""A value that is derived from a class, computed once. In: a function of a class. Out: it, cached.

The class itself holds the value, so that both are freed together. `functools.cache` would hold
every class for good, and does not pass a strict type check here: a class whose instances define
`__hash__` is taken for not hashable.
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
    """`make`, whose first result for every class is kept; safe to call from several threads."""
    # Python finds only interned names in its cache of attributes.
    name = sys.intern(f"_cached_{make.__module__}.{make.__qualname__}")

    def get(cls: type[Any]) -> R:
        pair: tuple[type[Any] | None, Any] = getattr(cls, name, _MISSING)
        if pair[0] is cls:  # else it is the value of a base class
            found: R = pair[1]
            return found
        return stored(cls)

    def stored(cls: type[Any]) -> R:
        value = make(cls)
        with _storing:
            if name not in cls.__dict__:  # else another thread was faster
                setattr(cls, name, (cls, value))
        first: R = cls.__dict__[name][1]
        return first

    return get
