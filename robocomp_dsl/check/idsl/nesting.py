"""Measures the depth and size of types, so that recursion over them is safe.

In: types. Out: their depth (a built-in type has 1) and the number of built-in values per value.
"""

from __future__ import annotations

from robocomp_dsl.model import types

MAX_DEPTH = 64
MAX_VALUES = 100_000
"""Built-in values per value, not counting the elements of sequences without a fixed size."""
NUMBERS_PER_VALUE = 100
"""Numbers of a fixed array that count as one value: they are one block of memory."""


class Nesting:
    """Measures types; every declaration once."""

    def __init__(self) -> None:
        self._known: dict[int, tuple[int, int]] = {}

    def measure(self, type_: types.Declaration | types.Primitive) -> tuple[int, int]:
        """Depth and number of values of `type_`."""
        known = self._known.get(id(type_))
        if known is None:
            inside = [self.measure(part) for part in _parts(type_)]
            depth = 1 + max((depth for depth, _ in inside), default=0)
            known = (depth, _repeated(type_, max(1, sum(values for _, values in inside))))
            self._known[id(type_)] = known
        return known

    def is_excessive(self, type_: types.Declaration) -> bool:
        """Whether `type_` exceeds the limits."""
        depth, values = self.measure(type_)
        return depth > MAX_DEPTH or values > MAX_VALUES


def _repeated(type_: types.Declaration | types.Primitive, values: int) -> int:
    """The number of values if `type_` contains `values` once; numbers of an array count less."""
    if not isinstance(type_, types.Sequence) or not type_.size:
        return values
    if isinstance(type_.element, types.Primitive) and not type_.element.is_text:
        return 1 + type_.size // NUMBERS_PER_VALUE
    return values * type_.size


def _parts(type_: types.Declaration | types.Primitive) -> list[types.Type]:
    match type_:
        case types.Struct() | types.ExceptionType():
            return [field.type for field in type_.fields]
        case types.Sequence():
            return [type_.element]
        case types.Dictionary():
            return [type_.key, type_.value]
        case types.Alias():
            return [type_.target]
    return []
