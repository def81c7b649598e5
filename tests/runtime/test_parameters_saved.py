"""Saved live values: they override the configuration, and the command line overrides them."""

from __future__ import annotations

import math
from pathlib import Path

import pytest
from hypothesis import given
from hypothesis import strategies as st

from robocomp_dsl.runtime.parameters import ConfigError, ParameterRejected
from robocomp_dsl.runtime.parameters.saved import saved_path
from tests.runtime.test_parameters_live import Params

CONFIG = "# mine\nrate: 30\nmotors:\n  - name: m\n"


@pytest.fixture
def config(tmp_path: Path) -> Path:
    path = tmp_path / "etc" / "config.yaml"
    path.parent.mkdir()
    path.write_text(CONFIG)
    return path


def load(config: Path, *overrides: str) -> Params:
    return Params.load(config, overrides, save_beside=config)


def test_saved_parameters_are_loaded_again(config: Path) -> None:
    params = load(config)
    params.set({"rate": 20, "motors[0].min": -3, "label": 'a "b" # c: \n é', "on": True})
    assert load(config).rate == 30, "only `save` writes a file"
    assert params.save() == saved_path(config)
    again = load(config)
    assert (again.rate, again.motors[0].min, again.on) == (20.0, -3.0, True)
    assert again.label == 'a "b" # c: \n é'
    assert config.read_text() == CONFIG
    assert load(config, "rate=7").rate == 7.0
    assert [p.name for p in config.parent.iterdir() if p.name != "config.yaml"] == [
        "config.saved.yaml"
    ]


def test_saved_parameters_keep_earlier_values(config: Path) -> None:
    first = load(config)
    first.set({"rate": 20})
    first.save()
    second = load(config)
    second.set({"count": 5})
    second.save()
    third = load(config)
    assert (third.rate, third.count) == (20.0, 5)
    assert "mode" not in saved_path(config).read_text()


@given(value=st.floats(1, 1000), text=st.text(st.characters(codec="utf-8"), max_size=20))
def test_saved_parameters_round_trip_random_values(
    tmp_path_factory: pytest.TempPathFactory, value: float, text: str
) -> None:
    config = tmp_path_factory.mktemp("any") / "c.yaml"
    config.write_text(CONFIG)
    params = load(config)
    try:
        params.set({"rate": value, "label": text})
    except ParameterRejected:  # a text that no configuration can hold
        return
    params.save()
    again = load(config)
    assert math.isclose(again.rate, value, rel_tol=0)
    assert again.label == text


@pytest.mark.parametrize(
    ("text", "message"),
    [
        ("speed: 3\n", "speed"),
        ("rate: fast\n", "number"),
        ("rate: [1]\n", "`rate` must be a number, not a list"),
        ("'a b': 1\n", "not of the form `path: value`"),
        ("motors[4].min: 1\n", "motors"),
        ("rate: {\n", "config.saved.yaml"),
    ],
)
def test_saved_parameters_report_damaged_file_with_position(
    config: Path, text: str, message: str
) -> None:
    saved_path(config).write_text(text)
    with pytest.raises(ConfigError) as caught:
        load(config)
    assert message in str(caught.value)
    assert "config.saved.yaml:" in str(caught.value)


def test_save_without_writable_file_is_rejected(config: Path, tmp_path: Path) -> None:
    with pytest.raises(ParameterRejected, match="without a file"):
        Params.load(config).save()
    blocked = tmp_path / "file"
    blocked.write_text("")
    params = Params.load(config, save_beside=blocked / "config.yaml")
    params.set({"rate": 20})
    with pytest.raises(ParameterRejected, match="cannot be written"):
        params.save()
