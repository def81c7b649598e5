"""Values of messages in a bridge: joined, selected, converted. Arrays of numbers stay arrays.

What does not fit raises `DoesNotFit` with the path of the field; callers know it, values do not.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from typing import Any

import numpy as np
from numpy.typing import NDArray

from robocomp_dsl.runtime.bridge.errors import DoesNotFit

_NUMBERS = (int, float, np.number)


def joined(*parts: Any) -> NDArray[Any] | list[Any]:
    """The items of all parts in order: scalars one item, sequences theirs.

    Numbers give an array, one array alone is returned as it is; anything else gives a list.
    """
    if len(parts) == 1 and isinstance(parts[0], np.ndarray):
        return parts[0]
    if all(isinstance(part, _NUMBERS) and not isinstance(part, bool) for part in parts):
        return np.array(parts)
    if all(isinstance(part, np.ndarray | int | float | np.number) for part in parts) and not any(
        isinstance(part, bool) for part in parts
    ):
        return np.concatenate([np.atleast_1d(part) for part in parts])
    return list(_items(parts))


def _items(parts: Sequence[Any]) -> Iterator[Any]:
    for part in parts:
        if isinstance(part, np.ndarray):
            yield from part.tolist()
        elif isinstance(part, list | tuple):
            yield from part
        else:
            yield part


def element(values: Any, index: int, path: str) -> Any:
    """One element of a sequence; numbers as Python's."""
    if index >= len(values):
        raise DoesNotFit(path, f"there is no item {index} in a sequence of {len(values)}")
    found = values[index]
    return found.item() if isinstance(found, np.generic) else found


def elements(values: Any, indices: Sequence[int], path: str) -> Any:
    """Some elements of a sequence in the order of `indices`."""
    if len(indices) and max(indices) >= len(values):
        raise DoesNotFit(path, f"there is no item {max(indices)} in a sequence of {len(values)}")
    if isinstance(values, np.ndarray):
        return values[list(indices)]
    return [values[index] for index in indices]


def part_of(values: Any, start: int, stop: int, path: str) -> Any:
    """The elements from `start` up to `stop`, which is excluded; a view of an array."""
    if stop > len(values):
        raise DoesNotFit(path, f"there is no item {stop - 1} in a sequence of {len(values)}")
    return values[start:stop]


def with_length(values: Any, length: int, path: str) -> Any:
    """`values`, which must have `length` items."""
    if len(values) != length:
        raise DoesNotFit(path, f"takes {length} items, not {len(values)}")
    return values


def converted(values: Any, factor: float, offset: float = 0.0) -> Any:
    """`values * factor + offset`, for a number or the numbers of a sequence."""
    if isinstance(values, list | tuple):
        values = np.array(values, np.float64)
    scaled = values * factor if factor != 1.0 else values
    return scaled + offset if offset else scaled


def numbers(values: Any) -> NDArray[Any]:
    """A sequence of numbers as an array, for arithmetic."""
    return values if isinstance(values, np.ndarray) else np.array(values)


def number(value: Any, path: str) -> float:
    """A number from its text, or a number as it is. Raises `DoesNotFit` for other texts."""
    try:
        return float(value)
    except (TypeError, ValueError):
        raise DoesNotFit(path, f"{value!r} is not a number") from None


def text(value: Any) -> str:
    """The shortest text of a number that reads as the same number; a text as it is."""
    if isinstance(value, np.generic):
        value = value.item()
    if isinstance(value, bool):
        return "true" if value else "false"
    return str(value)


def integer(value: Any, low: int, high: int, path: str) -> int:
    """A number as an integer between `low` and `high`, rounded towards zero."""
    try:
        whole = int(value)
    except (ValueError, OverflowError):
        raise DoesNotFit(path, f"{value!r} is not an integer") from None
    if not low <= whole <= high:
        raise DoesNotFit(path, f"{whole} does not fit ({low} to {high})")
    return whole
