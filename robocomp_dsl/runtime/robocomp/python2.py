"""What Python 2 computed otherwise: `/` of whole numbers, and `round`.

In: operands of converted code. Out: the results that Python 2 had.
"""

from __future__ import annotations

import math
from typing import Any

WHOLE_KINDS = ("i", "u", "b")
"""Kinds of numpy's types whose quotient was whole, too."""


def divide(left: Any, right: Any) -> Any:
    """`left / right` in Python 2: the quotient of two whole numbers is rounded down."""
    return left // right if _is_whole(left) and _is_whole(right) else left / right


def round_half_up(number: Any, digits: int = 0) -> Any:
    """`round` in Python 2: halves are rounded away from zero, and the result is a float."""
    if not isinstance(number, int | float):
        return round(number, digits)
    scale = 10.0**digits
    return math.copysign(math.floor(abs(number) * scale + 0.5) / scale, number)


def _is_whole(value: Any) -> bool:
    kind = getattr(getattr(value, "dtype", None), "kind", "")
    return isinstance(value, int) or kind in WHOLE_KINDS
