"""Values in a bridge: arrays stay arrays; what does not fit is reported with its field."""

from __future__ import annotations

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
    joined = values.joined(*parts)
    assert isinstance(joined, np.ndarray)
    assert joined.tolist() == [x for part in parts for x in np.atleast_1d(part).tolist()]


def test_joined_single_array_is_not_copied() -> None:
    image = np.zeros(1_000_000, np.uint8)
    assert values.joined(image) is image
    assert values.part_of(image, 10, 20, "").base is image


@pytest.mark.parametrize("parts", [("a", 1), (["a"], np.zeros(1)), (True, 1.0), ([1, "x"],)])
def test_joined_other_items_are_a_list(parts: tuple[object, ...]) -> None:
    joined = values.joined(*parts)
    assert isinstance(joined, list)
    assert all(not isinstance(item, np.generic) for item in joined)


def test_converted_scales_numbers_arrays_and_lists() -> None:
    assert values.converted(2.0, 3.0) == 6.0
    assert values.converted(2.0, 1.0, 273.15) == 275.15
    assert values.converted([1, 2], 0.5).tolist() == [0.5, 1.0]
    array = np.ones(2)
    assert values.converted(array, 1.0) is array


@pytest.mark.parametrize(
    ("call", "message"),
    [
        (lambda: values.element([1], 1, "x"), "x: there is no item 1 in a sequence of 1"),
        (lambda: values.elements([1], (0, 3), "y"), "y: there is no item 3 in a sequence of 1"),
        (lambda: values.part_of([1, 2], 0, 3, "z"), "z: there is no item 2 in a sequence of 2"),
        (lambda: values.with_length([1], 2, "v"), "v: takes 2 items, not 1"),
        (lambda: values.number("far", "n"), "n: 'far' is not a number"),
        (lambda: values.integer(300.0, 0, 255, "b"), "b: 300 does not fit (0 to 255)"),
        (lambda: values.integer(float("nan"), 0, 255, ""), "nan is not an integer"),
    ],
)
def test_value_that_does_not_fit_is_located(call: object, message: str) -> None:
    with pytest.raises(DoesNotFit) as failure:
        call()  # type: ignore[operator]
    assert str(failure.value) == message


@given(st.floats(allow_nan=False))
def test_text_of_number_reads_as_same_number(value: float) -> None:
    assert values.number(values.text(value), "") == value
    assert values.number(values.text(np.float64(value)), "") == value


def test_elements_of_array_and_list() -> None:
    assert values.elements(np.array([5, 6, 7]), (2, 0), "").tolist() == [7, 5]
    assert values.elements(["a", "b"], (1,), "") == ["b"]
    assert type(values.element(np.array([1.5]), 0, "")) is float
