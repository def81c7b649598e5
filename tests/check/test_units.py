"""Units of measurement: what they mean, and conversions between them."""

from __future__ import annotations

import math

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from robocomp_dsl.check.idsl.units import KNOWN
from robocomp_dsl.model.units import (
    InvalidUnit,
    conversion,
    known_units,
    parse_unit,
    unknown_words,
)


@pytest.mark.parametrize(
    ("source", "target", "factor", "offset"),
    [
        ("deg", "rad", math.pi / 180, 0),
        ("rad/s", "deg/s", 180 / math.pi, 0),
        ("mm", "m", 1e-3, 0),
        ("mm", "um", 1000, 0),
        ("mm", "µm", 1000, 0),
        ("m/s^2", "m/s2", 1, 0),
        ("m/s²", "m s^-2", 1, 0),
        ("m/s/s", "mm/s2", 1000, 0),
        ("N m", "Nm", 1, 0),
        ("N*m", "kN m", 1e-3, 0),
        ("N·m/rad", "Nm/rad", 1, 0),
        ("degC", "K", 1, 273.15),
        ("K", "degC", 1, -273.15),
        ("degF", "degC", 5 / 9, -160 / 9),
        ("degC/s", "K/s", 1, 0),
        ("%", "1", 0.01, 0),
        ("min", "s", 60, 0),
        ("km/h", "m/s", 1 / 3.6, 0),
        ("1/s", "Hz", 1, 0),
        ("rpm", "rad/s", math.pi / 30, 0),
        ("rev/min", "rpm", 1, 0),
        ("kPa", "bar", 0.01, 0),
        ("mAh", "C", 3.6, 0),
        ("W/(m^2 K)", "W/m^2/K", 1, 0),
        ("gauss", "uT", 100, 0),
        ("kB", "bit", 8000, 0),
        ("in", "mm", 25.4, 0),
    ],
)
def test_unit_conversion(source: str, target: str, factor: float, offset: float) -> None:
    factors = conversion(parse_unit(source), parse_unit(target))
    assert factors == pytest.approx((factor, offset), rel=1e-14)


@pytest.mark.parametrize(
    ("source", "target"),
    [("deg", "m"), ("rad/s", "Hz"), ("rad", "1"), ("px", "m"), ("ticks", "counts"), ("K", "J")],
)
def test_units_of_different_dimensions_have_no_conversion(source: str, target: str) -> None:
    assert conversion(parse_unit(source), parse_unit(target)) is None


@pytest.mark.parametrize(
    "text", ["", " ", "m//s", "m/", "(m", "m)", "^2", "m^x", "m^99", "m [s]", "2 m", "*", "m**"]
)
def test_invalid_unit_is_rejected(text: str) -> None:
    with pytest.raises(InvalidUnit, match="`"):
        parse_unit(text)


def test_units_of_idsl_are_known() -> None:
    assert [unit for unit in sorted(KNOWN) if unknown_words(unit)] == []


def test_unknown_unit_converts_to_itself_only() -> None:
    assert unknown_words("furlongs/s") == ["furlongs"]
    assert conversion(parse_unit("furlongs/s"), parse_unit("furlongs/min")) == (60, 0)
    assert conversion(parse_unit("furlongs"), parse_unit("m")) is None


def test_conversion_factor_between_prefixes_is_exact() -> None:
    for prefix, power in {"u": 6, "m": 3, "c": 2}.items():
        assert conversion(parse_unit("m"), parse_unit(f"{prefix}m")) == (10.0**power, 0)
        assert conversion(parse_unit(f"{prefix}m"), parse_unit("m")) == (10.0**-power, 0)


@pytest.mark.parametrize("unit", known_units())
def test_known_unit_can_be_parsed_and_converted_to_itself(unit: str) -> None:
    assert not unknown_words(unit)
    assert conversion(parse_unit(unit), parse_unit(unit)) == (1, 0)


@settings(deadline=None, max_examples=200)
@given(st.text(alphabet="mskgradNPaHz%°µ12/*^() ²[", max_size=12))
def test_unit_parser_accepts_or_rejects_any_text(text: str) -> None:
    try:
        unit = parse_unit(text)
    except InvalidUnit as error:
        assert str(error)  # noqa: PT017
    else:
        assert conversion(unit, unit) == (1, 0)


@settings(deadline=None, max_examples=100)
@given(
    st.floats(-1e6, 1e6),
    st.sampled_from([("deg", "rad"), ("degC", "degF"), ("km/h", "mm/s"), ("rpm", "deg/s")]),
)
def test_unit_conversion_can_be_undone(value: float, pair: tuple[str, str]) -> None:
    forth = conversion(parse_unit(pair[0]), parse_unit(pair[1]))
    back = conversion(parse_unit(pair[1]), parse_unit(pair[0]))
    assert forth is not None
    assert back is not None
    converted = value * forth[0] + forth[1]
    assert converted * back[0] + back[1] == pytest.approx(value, abs=1e-6)
