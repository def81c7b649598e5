"""Configuration files in TOML."""

from __future__ import annotations

import re
from pathlib import Path

import pytest

from robocomp_dsl.runtime.parameters import ConfigError
from tests.runtime.arm_parameters import error_lines, load


def test_parameters_load_reads_toml_with_same_values_and_positions(tmp_path: Path) -> None:
    good = 'rate = 20\nmode = "off"\n[[motors]]\nname = "a"\n[motors.limits]\nlow = -2.5\n'
    params = load(tmp_path, good, suffix=".toml")
    assert (params.rate, params.mode, params.motors[0].limits.low) == (20.0, "off", -2.5)
    bad = 'rate = 5000\n[[motors]]\nname = 7\n[[motors]]\nname = "b"\nlimits.low = "x"\nids = 3\n'
    with pytest.raises(ConfigError) as caught:
        load(tmp_path, bad, suffix=".toml")
    assert error_lines(caught.value) == [
        "1:8 `rate` is 5000 Hz, its highest value is 1000 Hz",
        "3:8 `motors[0].name` must be a string, not the number 7",
        "6:14 `motors[1].limits.low` must be a number, not a quoted string",
        "7:1 `motors[1]` has no parameter `ids`",
    ]


@pytest.mark.parametrize(
    ("text", "line"),
    [
        ("rate = ", "1"),
        ("mode = 'a'\nrate = 1\nrate = 2\n", "3"),
        ("[[motors]\n", "1"),
    ],
)
def test_parameters_load_reports_toml_syntax_error(tmp_path: Path, text: str, line: str) -> None:
    with pytest.raises(ConfigError) as caught:
        load(tmp_path, text, suffix=".toml")
    assert len(caught.value.findings) == 1
    found = error_lines(caught.value)[0]
    assert re.fullmatch(rf"{line}:\d+ this is not TOML: .+", found)


def test_parameters_load_converts_toml_types(tmp_path: Path) -> None:
    assert load(tmp_path, "device = 2024-01-01", suffix=".toml").device == "2024-01-01"
    with pytest.raises(ConfigError, match="`rate` is `inf`, it must be a finite number"):
        load(tmp_path, "rate = inf", suffix=".toml")
