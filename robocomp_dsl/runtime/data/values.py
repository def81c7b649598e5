"""Compare, hash and format field values. In: field values. Out: bools, hashables, text.

Plain `==` and `hash` fail for numpy arrays, and for lists and dictionaries that contain them.
"""

from __future__ import annotations

from collections.abc import Hashable
from typing import Any

import numpy as np

_ITEMS_SHOWN = 8


def same(a: Any, b: Any) -> bool:
    """Whether two field values are equal; NaN differs from itself, as usual in Python."""
    if isinstance(a, np.ndarray) or isinstance(b, np.ndarray):
        return bool(np.array_equal(a, b))
    if isinstance(a, list) and isinstance(b, list):
        return len(a) == len(b) and all(map(same, a, b))
    if isinstance(a, dict) and isinstance(b, dict):
        return a.keys() == b.keys() and all(same(v, b[k]) for k, v in a.items())
    return bool(a == b)


def hashed(value: Any) -> Hashable:
    """A hashable object that is equal for equal field values.

    Arrays and lists give the same object, because `same` treats them as equal.
    """
    if isinstance(value, np.ndarray):
        return hashed(value.tolist())
    if isinstance(value, dict):
        return frozenset((k, hashed(v)) for k, v in value.items())
    if isinstance(value, Hashable):
        return value
    return tuple(hashed(v) for v in value)


def shown(value: Any) -> str:
    """The value as readable text; long values are cut, with their length."""
    if isinstance(value, np.ndarray):
        if value.size > _ITEMS_SHOWN:
            head = ", ".join(map(repr, value.ravel()[:_ITEMS_SHOWN].tolist()))
            return f"[{head}, … {value.size} {value.dtype}]"
        return repr(value.tolist())
    if isinstance(value, list):
        return shown_items(value)
    if isinstance(value, dict):
        return "{" + ", ".join(f"{k!r}: {shown(v)}" for k, v in value.items()) + "}"
    return repr(value)


def shown_items(items: Any) -> str:
    """A list as readable text, cut after the first elements."""
    text = ", ".join(shown(item) for item in items[:_ITEMS_SHOWN])
    return f"[{text}, … {len(items)} in all]" if len(items) > _ITEMS_SHOWN else f"[{text}]"
