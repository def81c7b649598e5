"""Convert Python values to field types. In: values that users assign. Out: canonical values.

A conversion never changes a value except for float rounding; an invalid value raises
`EncodeError`, with its index as the path.
"""

from __future__ import annotations

import operator
from collections.abc import Iterable
from typing import Any

import numpy as np
from numpy.typing import NDArray

from robocomp_dsl.runtime.data.errors import EncodeError
from robocomp_dsl.runtime.data.schema import (
    BOOL,
    DOUBLE,
    FLOAT,
    Array,
    Enum,
    Primitive,
    Sequence,
)

FLAGS = {False: False, True: True}
"""The accepted values of a bool field; by equality also 0, 1 and numpy's bools."""


def as_array(value: Any, dtype: np.dtype[Any]) -> NDArray[Any]:
    """A one-dimensional contiguous array of `dtype` with the same values, copied only if needed.

    Accepts integral floats for integers, 0 and 1 for bools, bytes for a sequence of byte.
    """
    if isinstance(value, bytes | bytearray):
        value = np.frombuffer(value, np.uint8)
    try:
        array = np.asarray(value)
    except (ValueError, TypeError, OverflowError):
        raise EncodeError(f"takes a sequence of {dtype.name}, not {described(value)}") from None
    if array.ndim != 1:
        what = described(value) if array.ndim == 0 else f"an array of shape {array.shape}"
        hint = "; .ravel() makes it one-dimensional" if array.ndim > 1 else ""
        raise EncodeError(f"takes a one-dimensional sequence of {dtype.name}, not {what}{hint}")
    if array.dtype.kind in "US":
        at, text = next(
            (at, item) for at, item in enumerate(value) if isinstance(item, str | bytes)
        )
        raise EncodeError(f"takes numbers ({dtype.name}), not {described(text)}", f"[{at}]")
    if array.dtype != dtype:
        array = _converted(array, dtype) if array.size else np.empty(0, dtype)
    return np.ascontiguousarray(array, dtype)


def _converted(array: NDArray[Any], dtype: np.dtype[Any]) -> NDArray[Any]:
    if array.dtype.kind == "O":
        array = _unboxed(array, dtype)
    if array.dtype.kind not in "biuf":
        raise EncodeError(f"takes numbers ({dtype.name}), not {array.dtype.name}")
    with np.errstate(all="ignore"):
        result = array.astype(dtype)
        if dtype.kind == "f":
            wrong = np.isinf(result) & ~np.isinf(array)
        else:
            wrong = _changed(array, result)
    if wrong.any():
        at = int(wrong.argmax())
        raise EncodeError(f"{array[at]!s} does not fit into {dtype.name}", f"[{at}]")
    return result


def _changed(array: NDArray[Any], result: NDArray[Any]) -> NDArray[np.bool_]:
    """Index of a number changed by the conversion; converting back shows sign and overflow."""
    back = result.astype(array.dtype)
    changed: NDArray[np.bool_] = (back != array) | ((result < 0) != (array < 0))
    return changed


def _unboxed(array: NDArray[Any], dtype: np.dtype[Any]) -> NDArray[Any]:
    """Convert an array of Python objects: integers too large for numpy, or other types."""
    low, high = (0, 2**64) if dtype == np.uint64 else (-(2**63), 2**63)
    for at, item in enumerate(array):
        if not isinstance(item, int | float | np.number | np.bool_):
            raise EncodeError(f"takes numbers ({dtype.name}), not {described(item)}", f"[{at}]")
        if isinstance(item, int) and not low <= item < high:
            raise EncodeError(f"{item} does not fit into {dtype.name}", f"[{at}]")
    return np.array(array.tolist())


def as_scalar(type_: Primitive | type[Enum], value: Any) -> Any:
    """`value` as a bool, int, float, str or enumerator."""
    if not isinstance(type_, Primitive):
        return _member(type_, value)
    if type_.is_text:
        return _text(type_, value)
    if type_ is BOOL:
        return _flag(value)
    if type_ is FLOAT or type_ is DOUBLE:
        return _float(type_, value)
    return _int(type_, value)


def _text(type_: Primitive, value: Any) -> str:
    if not isinstance(value, str):
        raise EncodeError(f"takes a text, not {described(value)}")
    try:
        size = len(value.encode())
    except UnicodeEncodeError as error:
        raise EncodeError(
            f"the character {value[error.start]!r} at {error.start} cannot be sent as UTF-8"
        ) from None
    if type_.bound and size > type_.bound:
        raise EncodeError(f"takes at most {type_.bound} bytes of text, not {size}")
    return value


def _flag(value: Any) -> bool:
    try:
        return FLAGS[value]
    except (KeyError, TypeError):
        raise EncodeError(f"takes True or False, not {described(value)}") from None


def _article(name: str) -> str:
    return "an" if name[0] in "aeio" else "a"


def _int(type_: Primitive, value: Any) -> int:
    try:
        number = operator.index(value)
    except TypeError:
        raise EncodeError(f"takes an integer ({type_.name}), not {described(value)}") from None
    bits = 8 * type_.size
    low, high = (
        (0, 2**bits - 1) if type_.code.isupper() else (-(2 ** (bits - 1)), 2 ** (bits - 1) - 1)
    )
    if not low <= number <= high:
        name = f"{_article(type_.name)} {type_.name}"
        raise EncodeError(f"{number} does not fit into {name} ({low} to {high})")
    return number


def _float(type_: Primitive, value: Any) -> float:
    if not (hasattr(value, "__float__") or hasattr(value, "__index__")):
        raise EncodeError(f"takes a number ({type_.name}), not {described(value)}")
    try:
        number = float(value)
    except (TypeError, ValueError, OverflowError) as error:
        raise EncodeError(f"takes a number ({type_.name}): {error}") from None
    if type_ is FLOAT and abs(number) > _FLOAT_LIMIT and number not in _INFINITIES:
        raise EncodeError(f"{number!r} does not fit into a float")
    return number


_FLOAT_LIMIT = (2 - 2**-24) * 2**127  # larger values round to infinity
_INFINITIES = (float("inf"), float("-inf"))


def _member(type_: type[Enum], value: Any) -> Enum:
    try:
        return type_(value)
    except ValueError:
        names = ", ".join(type_.__members__)
        raise EncodeError(f"takes a {type_.__name__} ({names}), not {described(value)}") from None


def check_count(type_: Array | Sequence, count: int) -> None:
    """Raise `EncodeError` if a sequence of `count` elements has not the length of its type."""
    if type_.size and count != type_.size:
        raise EncodeError(f"has {_values(count)}, it needs {type_.size}")
    if type_.bound and count > type_.bound:
        raise EncodeError(f"has {_values(count)}, at most {type_.bound} are allowed")


def _values(count: int) -> str:
    return "1 value" if count == 1 else f"{count} values"


def described(value: Any) -> str:
    """A value of the wrong type, for a message: short, with its type."""
    text = repr(value)
    text = text if len(text) <= 40 else text[:39] + "…"
    return f"{text} ({type(value).__name__})"


def as_list(value: Any) -> list[Any]:
    """The elements of a sequence. Strings and dicts are rejected: they are usually mistakes."""
    if isinstance(value, list):
        return value
    if isinstance(value, str | bytes | dict) or not isinstance(value, Iterable):
        raise EncodeError(f"takes a list, not {described(value)}")
    return list(value)
