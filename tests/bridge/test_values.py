"""Values in a bridge: arrays stay arrays; what does not fit is reported."""

from __future__ import annotations

from collections.abc import Callable

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from robocomp_dsl.runtime.bridge import values
from robocomp_dsl.runtime.bridge.errors import DoesNotFit

PART = st.one_of(
    st.floats(-10, 10),
    st.lists(st.floats(-10, 10), max_size=4).map(lambda v: np.array(v, np.float64)),
    st.integers(-9, 9),
)


@given(st.lists(PART, min_size=1, max_size=6))
def test_joined_numbers_are_one_array_in_order(parts: list[object]) -> None:
    joined = values.joined(np.float64, *parts)
    assert joined.dtype == np.float64
    assert joined.tolist() == [x for part in parts for x in np.atleast_1d(part).tolist()]


def test_joined_single_array_is_not_copied() -> None:
    image = np.zeros(1_000_000, np.uint8)
    assert values.joined(np.uint8, image) is image
    assert values.part_of(image, 10, 20).base is image
    assert values.integers(image, np.uint8) is image


def test_listed_items_are_values_of_python() -> None:
    assert values.listed("a", [1, "b"], np.array([0.5])) == ["a", 1, "b", 0.5]


@pytest.mark.parametrize(
    ("call", "message"),
    [
        (lambda: values.element([1], 1), "there is no item 1: the sequence has 1"),
        (lambda: values.elements([1], (0, 3)), "there is no item 3: the sequence has 1"),
        (lambda: values.part_of([1, 2], 0, 3), "there is no item 2: the sequence has 2"),
        (lambda: values.with_length([1], 2, 2), "takes 2 items, not 1"),
        (lambda: values.with_length([1], 0, 0), "takes 0 items, not 1"),
        (lambda: values.with_length([1], 2, 4), "takes 2 to 4 items, not 1"),
        (lambda: values.number("far"), "'far' is not a number"),
        (lambda: values.integer(300.0, 0, 255), "300.0 does not fit (0 to 255)"),
        (lambda: values.integer(float("nan"), 0, 255), "nan is not an integer"),
        (
            lambda: values.integers([1.0, 300.0], np.uint8),
            "item 1: 300.0 does not fit (0 to 255)",
        ),
        (
            lambda: values.integers(np.array([np.nan]), np.int32),
            "item 0: nan does not fit (-2147483648 to 2147483647)",
        ),
        (lambda: values.item_by_item("+", [1], [1, 2]), "`+` joins lists of 1 and 2 items"),
        (lambda: values.nanoseconds_of(float("inf"), 1e9), "the time stamp inf is no time"),
    ],
)
def test_value_that_does_not_fit_is_reported(call: Callable[[], object], message: str) -> None:
    with pytest.raises(DoesNotFit) as failure:
        call()
    assert str(failure.value) == message


@given(st.floats(allow_nan=False))
def test_text_of_number_reads_as_same_number(value: float) -> None:
    assert values.number(values.text(value)) == value
    assert values.number(values.text(np.float64(value))) == value


@given(st.integers(0, 2**40), st.sampled_from([(0, 255), (-128, 127), (-(2**31), 2**31 - 1)]))
def test_wrapped_counter_stays_in_range_and_counts_up(count: int, limits: tuple[int, int]) -> None:
    wrapped = values.wrapped(count, *limits)
    assert limits[0] <= wrapped <= limits[1]
    following = values.wrapped(count + 1, *limits)
    assert following == (limits[0] if wrapped == limits[1] else wrapped + 1)


@given(st.lists(st.floats(-1000, 1000), max_size=8))
def test_integers_are_rounded_to_nearest(numbers: list[float]) -> None:
    rounded = values.integers(np.array(numbers, np.float64), np.int32)
    assert rounded.dtype == np.int32
    assert rounded.tolist() == [values.integer(number, -1000, 1000) for number in numbers]


def test_elements_of_array_and_list() -> None:
    assert values.elements(np.array([5, 6, 7]), (2, 0)).tolist() == [7, 5]
    assert values.elements(["a", "b"], (1,)) == ["b"]
    assert type(values.element(np.array([1.5]), 0)) is float
    assert values.item_by_item("*", [1, 2], np.array([0.5, 2])).tolist() == [0.5, 4]
