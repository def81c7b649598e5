"""Hypothesis strategies for types, as generated code would declare them, and for their values."""

from __future__ import annotations

import itertools
from dataclasses import replace
from typing import Any

import numpy as np
from hypothesis import strategies as st

from robocomp_dsl.runtime import types as rt

ROS_NUMBERS = (rt.INT8, rt.OCTET, rt.UINT16, rt.UINT32, rt.UINT64)
NUMBERS = (rt.BYTE, rt.SHORT, rt.INT, rt.LONG, rt.FLOAT, rt.DOUBLE, *ROS_NUMBERS)
FIXED = (*NUMBERS, rt.BOOL)
PRIMITIVES = (*FIXED, rt.STRING)

_serial = itertools.count()


def struct_of(fields: list[Any], base: type[Any] = rt.Struct) -> type[Any]:
    """A class like a generated one, with fields f0, f1, ... of these types."""
    names = tuple(f"f{i}" for i in range(len(fields)))
    members = {"__annotations__": dict(zip(names, fields, strict=True)), "__module__": __name__}
    return type(f"Struct{next(_serial)}", (base,), members)


def array_of(element: type[Any]) -> type[rt.StructArray[Any]]:
    return type(
        f"{element.__name__}List", (rt.StructArray,), {"__slots__": (), "_element_": element}
    )


def enumeration(values: list[int]) -> type[rt.Enum]:
    return rt.Enum(f"Enum{next(_serial)}", {f"E{i}": value for i, value in enumerate(values)})  # type: ignore[return-value]


limits = (
    st.just({})
    | st.integers(1, 5).map(lambda size: {"size": size})
    | st.integers(1, 5).map(lambda bound: {"bound": bound})
)
few = st.sampled_from([{}, {"size": 1}, {"size": 2}, {"bound": 2}])
bounded_strings = st.integers(1, 9).map(lambda bound: replace(rt.STRING, bound=bound))


def _enums(minimum: int, maximum: int) -> st.SearchStrategy[Any]:
    numbers = st.integers(minimum, maximum)
    return st.lists(numbers, min_size=1, max_size=4, unique=True).map(enumeration)


def _sequence(element: Any, limit: dict[str, int]) -> Any:
    is_number = isinstance(element, rt.Primitive) and not element.is_text
    return (rt.Array if is_number else rt.Sequence)(element, **limit)


def _types(
    enums: st.SearchStrategy[Any], *, struct_keys: bool, ros: bool
) -> st.SearchStrategy[Any]:
    """Types with these enums; dictionaries may have structs of numbers as keys.

    `ros`: also the numbers, arrays and strings that only ROS definitions have.
    """
    fixed = [type_ for type_ in FIXED if ros or type_ not in ROS_NUMBERS]
    any_length, short = (limits, few) if ros else (st.just({}), st.just({}))
    texts = bounded_strings | st.just(rt.STRING) if ros else st.just(rt.STRING)
    leaves = st.sampled_from(fixed) | enums
    fixed_structs = st.recursive(
        st.lists(leaves, min_size=1, max_size=5).map(struct_of),
        lambda inner: st.lists(leaves | inner, min_size=1, max_size=4).map(struct_of),
        max_leaves=4,
    )
    keys = st.sampled_from((rt.BYTE, rt.SHORT, rt.INT, rt.LONG, rt.STRING, rt.BOOL)) | enums
    if struct_keys:
        keys |= fixed_structs
    flat = st.sampled_from(fixed) | texts | enums
    flat |= st.builds(_sequence, st.sampled_from(fixed), any_length)
    return st.recursive(
        flat,
        lambda inner: (
            st.lists(inner, max_size=5).map(struct_of)
            | st.builds(_sequence, inner, short)
            | fixed_structs.map(array_of)
            | st.builds(rt.Dictionary, keys, inner)
        ),
        max_leaves=6,
    )


types = _types(_enums(-(2**31), 2**31 - 1), struct_keys=True, ros=True)
slice_types = _types(_enums(0, 300) | _enums(0, 2**31 - 1), struct_keys=False, ros=False)
"""Types that Slice has, too."""

structs = st.lists(types, max_size=5).map(struct_of)
slice_structs = st.lists(slice_types, max_size=5).map(struct_of)

_BOUNDS = {
    rt.BYTE: (0, 2**8 - 1),
    rt.SHORT: (-(2**15), 2**15 - 1),
    rt.INT: (-(2**31), 2**31 - 1),
    rt.LONG: (-(2**63), 2**63 - 1),
    rt.INT8: (-(2**7), 2**7 - 1),
    rt.OCTET: (0, 2**8 - 1),
    rt.UINT16: (0, 2**16 - 1),
    rt.UINT32: (0, 2**32 - 1),
    rt.UINT64: (0, 2**64 - 1),
}


def _lengths(type_: rt.Array | rt.Sequence, most: int) -> dict[str, int]:
    return {"min_size": type_.size, "max_size": type_.size or min(type_.bound or most, most)}


def values(type_: Any, *, nan: bool = True) -> st.SearchStrategy[Any]:
    """Values of a type as decoders make them; without `nan`, all equal themselves."""
    if isinstance(type_, rt.Primitive):
        return _primitives(type_, nan)
    if isinstance(type_, rt.Array):
        items = st.lists(_primitives(type_.element, nan), **_lengths(type_, 4))
        return items.map(lambda v: np.array(v, type_.element.dtype))
    if isinstance(type_, rt.Sequence):
        return st.lists(values(type_.element, nan=nan), **_lengths(type_, 3))
    if isinstance(type_, rt.Dictionary):
        keys = values(type_.key, nan=False)
        return st.dictionaries(keys, values(type_.value, nan=nan), max_size=3)
    if issubclass(type_, rt.StructArray):
        return st.lists(values(type_._element_, nan=nan), max_size=4).map(type_)
    if issubclass(type_, rt.Enum):
        return st.sampled_from(list(type_))
    fields = [values(inner, nan=nan) for _, inner in type_._fields_]
    return st.tuples(*fields).map(lambda v: type_(*v))


def _primitives(type_: rt.Primitive, nan: bool) -> st.SearchStrategy[Any]:
    if type_ is rt.BOOL:
        return st.booleans()
    if type_.is_text:
        texts = st.text(max_size=type_.bound or 9)
        return texts.filter(lambda text: not type_.bound or len(text.encode()) <= type_.bound)
    if type_ in _BOUNDS:
        return st.integers(*_BOUNDS[type_])
    # NaN has payloads that a change of width may not keep; one is enough.
    numbers = st.floats(width=type_.size * 8, allow_nan=False)
    return numbers | st.just(float("nan")) if nan else numbers


@st.composite
def messages(draw: st.DrawFn, *, nan: bool = True) -> Any:
    """A value of a random struct."""
    return draw(values(draw(structs), nan=nan))
