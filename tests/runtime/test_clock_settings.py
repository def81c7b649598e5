"""The option `--clock`: parsing and writing."""

from __future__ import annotations

import argparse

import pytest

from robocomp_dsl.runtime.time.clock_settings import ClockSettings, parse_clock


@pytest.mark.parametrize(
    ("text", "expected"),
    [
        ("wall", ClockSettings()),
        ("sim", ClockSettings("sim")),
        ("sim,from=body", ClockSettings("sim", "body")),
        ("lockstep,from=body,with=b+a", ClockSettings("lockstep", "body", ("a", "b"))),
        (
            "lockstep,limit=2.5,lost=stop",
            ClockSettings("lockstep", limit=2.5, stops_when_lost=True),
        ),
    ],
)
def test_parse_clock_reads_option(text: str, expected: ClockSettings) -> None:
    assert parse_clock(text) == expected
    assert parse_clock(expected.as_text()) == expected


@pytest.mark.parametrize(
    "text", ["", "ros", "sim,from=", "sim,by=x", "lockstep,limit=0", "lockstep,lost=maybe", "sim,"]
)
def test_parse_clock_rejects_invalid_option(text: str) -> None:
    with pytest.raises(argparse.ArgumentTypeError):
        parse_clock(text)
