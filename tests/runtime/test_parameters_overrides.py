"""Overrides of parameters on the command line."""

from __future__ import annotations

from pathlib import Path

import pytest

from robocomp_dsl.runtime.parameters import ConfigError
from tests.runtime.arm_parameters import ArmParams, RequiredParams, error_lines, load


def test_overrides_take_precedence_over_file_and_reach_into_lists(tmp_path: Path) -> None:
    params = load(
        tmp_path,
        "rate: 5\nmotors: [{name: a}, &b {name: b, limits: {low: -3}}, *b]\n",
        "rate=6", "rate=7", "motors[1].limits.low=-2", "device=5", "motors[0].name=true",
    )  # fmt: skip
    assert params.rate == 7.0
    assert [m.limits.low for m in params.motors] == [-1.0, -2.0, -3.0]
    assert (params.device, params.motors[0].name) == ("5", "true")


def test_overrides_can_give_a_required_list() -> None:
    params = RequiredParams.load(None, ["serial=x=y", "motors[0].name=a", "motors[1].name=b"])
    assert params.serial == "x=y"
    assert [m.name for m in params.motors] == ["a", "b"]


@pytest.mark.parametrize(
    ("override", "expected"),
    [
        ("rate", "1:1 `--set rate` is not of the form `key=value`"),
        ("=5", "1:1 `--set =5` is not of the form `key=value`"),
        ("a..b=5", "1:1 `--set a..b=5` is not of the form `key=value`"),
        ("a[x]=5", "1:1 `--set a[x]=5` is not of the form `key=value`"),
        ("[0]=5", "1:1 `--set [0]=5` is not of the form `key=value`"),
        ("rte=5", "1:1 unknown parameter `rte`"),
        ("rate=", "1:6 `rate` must be a number, not ``"),
        ("rate=5000", "1:6 `rate` is 5000 Hz, its highest value is 1000 Hz"),
        ("motors[1].name=a", "1:1 `motors` has 0 entries, there is no [1] (they count from 0)"),
        ("rate.x=5", "1:1 `rate` must be a number, not a group"),
        ("motors.x=5", "1:1 `motors` must be a list, not a group"),
    ],
)
def test_overrides_report_errors(override: str, expected: str) -> None:
    with pytest.raises(ConfigError) as caught:
        ArmParams.load(None, [override])
    assert error_lines(caught.value) == [expected]
