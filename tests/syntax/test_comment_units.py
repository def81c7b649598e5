"""Units that the comments of definitions state, and comments that state none."""

from __future__ import annotations

import pytest

from robocomp_dsl.syntax.comment_units import unit_in


@pytest.mark.parametrize(
    ("comment", "expected"),
    [
        ("start angle of the scan [rad]", ("rad", "start angle of the scan")),
        ("[m/s^2]", ("m/s^2", "")),
        ("[seconds] between scans", ("s", "between scans")),
        ("range data [m] (others are discarded)", ("m", "range data [m] (others are discarded)")),
        ("radians", ("rad", "")),
        ("Meters per second.", ("m/s", "")),
        ("m/s", ("m/s", "")),
        ("m", ("m", "")),
        ("speed (m/s), forward", ("m/s", "speed (m/s), forward")),
        ("Negative when discharging (A)", ("A", "Negative when discharging (A)")),
        ("range in meters", ("m", "range in meters")),
        ("In Degrees Celsius (or NaN)", ("degC", "In Degrees Celsius (or NaN)")),
        ("time since start, in milliseconds", ("ms", "time since start, in milliseconds")),
    ],
)  # fmt: skip
def test_unit_in_comment(comment: str, expected: tuple[str, str]) -> None:
    assert unit_in(comment) == expected


@pytest.mark.parametrize(
    "comment",
    [
        "", "[0, 1]", "[optional]", "A", "N", "V", "angle in radians or in degrees", "in a frame",
        "number of seconds", "in m", "second joint", "(see below)", "the meters", "in secondsample",
        "ms of [x]", "a [px", "in volts per meter", "in meters squared", "charge in Ah",
    ],
)  # fmt: skip
def test_ambiguous_comment_has_no_unit(comment: str) -> None:
    assert unit_in(comment) == ("", comment)
