"""Values of messages in a bridge: joined, selected, converted. Arrays of numbers stay arrays.

What does not fit raises `DoesNotFit`. Generated code calls these functions.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Iterator, Sequence
from operator import add, mul, sub, truediv
from typing import Any, TypeVar

import numpy as np
from numpy.typing import NDArray

from robocomp_dsl.runtime.bridge.context import NANOSECONDS
from robocomp_dsl.runtime.bridge.errors import DoesNotFit

T = TypeVar("T")
_OPERATORS: dict[str, Callable[[Any, Any], Any]] = {"+": add, "-": sub, "*": mul, "/": truediv}


def joined(dtype: Any, *parts: Any) -> NDArray[Any]:
    """The numbers of all parts in order: scalars one item, arrays theirs.

    One array alone is returned as it is if its type is `dtype`.
    """
    if len(parts) == 1:
        return np.atleast_1d(np.asarray(parts[0], dtype))
    if any(isinstance(part, np.ndarray | list) for part in parts):
        arrays = [part if isinstance(part, np.ndarray) else np.atleast_1d(part) for part in parts]
        return np.concatenate(arrays, dtype=dtype, casting="unsafe")
    return np.array(parts, dtype)


def listed(*parts: Any) -> list[Any]:
    """The items of all parts in order: scalars one item, sequences theirs; numbers as Python's."""
    return list(_items(parts))


def _items(parts: Sequence[Any]) -> Iterator[Any]:
    for part in parts:
        if isinstance(part, np.ndarray):
            yield from part.tolist()
        elif isinstance(part, Sequence) and not isinstance(part, str):
            yield from part
        else:
            yield part


def element(values: Any, index: int) -> Any:
    """One element of a sequence; numbers as Python's."""
    if index >= len(values):
        raise DoesNotFit(f"there is no item {index}: the sequence has {len(values)}")
    found = values[index]
    return found.item() if isinstance(found, np.generic) else found


def elements(values: Any, indices: Sequence[int]) -> Any:
    """Some elements of a sequence in the order of `indices`."""
    if indices and max(indices) >= len(values):
        raise DoesNotFit(f"there is no item {max(indices)}: the sequence has {len(values)}")
    if isinstance(values, np.ndarray):
        return values[list(indices)]
    return [values[index] for index in indices]


def part_of(values: Any, start: int, stop: int) -> Any:
    """The elements from `start` up to `stop`, which is excluded; a view of an array."""
    if stop > len(values):
        raise DoesNotFit(f"there is no item {stop - 1}: the sequence has {len(values)}")
    return values[start:stop]


def with_length(values: T, minimum: int, maximum: int) -> T:
    """`values`, which must have `minimum` to `maximum` items."""
    count = len(values)  # type: ignore[arg-type]  # a sequence of any kind
    if not minimum <= count <= maximum:
        takes = f"{minimum}" if minimum == maximum else f"{minimum} to {maximum}"
        raise DoesNotFit(f"takes {takes} item{'s' * (takes != '1')}, not {count}")
    return values


def item_by_item(operator: str, left: Any, right: Any) -> Any:
    """`left operator right` for two lists of numbers, which must have the same length."""
    if len(left) != len(right):
        raise DoesNotFit(f"`{operator}` joins lists of {len(left)} and {len(right)} items")
    return _OPERATORS[operator](np.asarray(left), np.asarray(right))


def number(value: Any) -> float:
    """A number from its text, or a number as it is. Raises `DoesNotFit` for other texts."""
    try:
        return float(value)
    except (TypeError, ValueError):
        raise DoesNotFit(f"{value!r:.80} is not a number") from None


def numbers(values: Any) -> NDArray[Any]:
    """The numbers of a list of texts and numbers. Raises `DoesNotFit` for other texts."""
    if isinstance(values, np.ndarray):
        return values.astype(np.float64)
    return np.array([number(value) for value in values], np.float64)


def text(value: Any) -> str:
    """The shortest text of a number that reads as the same number; a text as it is."""
    if isinstance(value, np.generic):
        value = value.item()
    if isinstance(value, bool):
        return "true" if value else "false"
    return str(value)


def integer(value: Any, low: int, high: int) -> int:
    """A number as an integer between `low` and `high`, rounded to the nearest one."""
    if isinstance(value, float) and not math.isfinite(value):
        raise DoesNotFit(f"{value!r} is not an integer")
    whole: int = round(value)
    if not low <= whole <= high:
        raise DoesNotFit(f"{value!r} does not fit ({low} to {high})")
    return whole


def integers(values: Any, dtype: Any) -> NDArray[Any]:
    """Numbers as integers of `dtype`, rounded to the nearest ones; arrays of it are not copied."""
    array = np.asarray(values)
    if array.dtype == dtype:
        return array
    limits = np.iinfo(dtype)
    if array.dtype.kind == "f":
        array = np.rint(array)
    fits = (array >= limits.min) & (array <= limits.max)
    if not fits.all():
        at = int(np.argmin(fits))
        raise DoesNotFit(f"item {at}: {array[at]} does not fit ({limits.min} to {limits.max})")
    return array.astype(dtype)


def wrapped(value: int, low: int, high: int) -> int:
    """A counter in the range `low` to `high`, after which it starts again."""
    return (value - low) % (high - low + 1) + low


def ros_time(time_type: Callable[..., T], nanoseconds: int, second: str, part: str) -> T:
    """An instant as a ROS time; `second` and `part` are its fields."""
    seconds, rest = divmod(nanoseconds, NANOSECONDS)
    return time_type(**{second: seconds, part: rest})


def nanoseconds_of(value: Any, unit_ns: float) -> int:
    """A time stamp in ns; `unit_ns` is the length of its unit in ns."""
    if isinstance(value, float) and not math.isfinite(value):
        raise DoesNotFit(f"the time stamp {value!r} is no time")
    nanoseconds: int = round(value * unit_ns)
    return nanoseconds
