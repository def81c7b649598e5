"""Random files, overrides and changes give values within their ranges, or findings."""

from __future__ import annotations

import math
from pathlib import Path
from typing import Any

from hypothesis import HealthCheck, given, settings
from hypothesis import strategies as st

from robocomp_dsl.runtime.parameters import (
    ConfigError,
    Group,
    Parameter,
    ParameterGroup,
    ParameterRejected,
    Parameters,
)


class Joint(ParameterGroup):
    SCHEMA = (
        Parameter("name", "string", default="j"),
        Parameter("max", "float", default=1.0, low=-6.5, high=6.5, live=True),
    )
    name: str
    max: float


class Params(Parameters):
    SCHEMA = (
        Parameter("rate", "float", default=50.0, low=1, high=1000, live=True),
        Parameter("count", "int", default=1, low=0, high=9, live=True),
        Parameter("mode", "choice", default="a", choices=("a", "off", "5"), live=True),
        Parameter("on", "bool", default=False, live=True),
        Parameter("label", "string", default="", live=True),
        Group("joints", Joint, low=0, high=4),
    )
    rate: float
    count: int
    mode: str
    on: bool
    label: str
    joints: list[Joint]


def assert_sound(params: Params) -> None:
    """Every value has its type and is in its range."""
    assert type(params.rate) is float
    assert 1 <= params.rate <= 1000
    assert type(params.count) is int
    assert 0 <= params.count <= 9
    assert params.mode in ("a", "off", "5")
    assert type(params.on) is bool
    assert type(params.label) is str
    assert len(params.joints) <= 4
    assert all(math.isfinite(j.max) and abs(j.max) <= 6.5 for j in params.joints)


NAMES = ("rate", "count", "mode", "on", "label", "joints", "joints[0].max", "jonts", "Rate", "")
SCALARS = st.one_of(
    st.text(max_size=20),
    st.sampled_from(
        ["1e3", "0x10", "010", ".nan", "-.inf", "~", "yes", "5", "-1", "1_0", "!!int 5", "*x",
         "&x 5", "|\n  a", "[1, 2]", "{a: 1}", "- 1", '"5"', "'a", "<<", "9" * 500, "1:30",
         "a", "off"]
    ),
    st.integers().map(str),
    st.floats().map(str),
)  # fmt: skip
LINES = st.one_of(
    st.builds("{}: {}".format, st.sampled_from(NAMES), SCALARS),
    st.builds("  - max: {}".format, SCALARS),
    st.builds("{} = {}".format, st.sampled_from(NAMES), SCALARS),
    st.sampled_from(["---", "...", "%YAML 1.1", "joints:", "[[joints]]", "<<: *x", "? [a]", "\t"]),
)
RELAXED = settings(
    suppress_health_check=[HealthCheck.function_scoped_fixture, HealthCheck.too_slow]
)


def assert_loads_or_reports(path: Path, overrides: list[str]) -> None:
    found = load_or_error(path, overrides)
    if isinstance(found, Params):
        assert_sound(found)
        return
    assert found.findings
    assert all(f.location.line >= 1 and f.location.column >= 1 for f in found.findings)
    assert "error: " in str(found)


def load_or_error(path: Path, overrides: list[str]) -> Params | ConfigError:
    try:
        return Params.load(path, overrides)
    except ConfigError as error:
        return error


@RELAXED
@given(
    lines=st.lists(LINES, max_size=8),
    overrides=st.lists(st.builds("{}={}".format, st.sampled_from(NAMES), SCALARS), max_size=3),
    suffix=st.sampled_from([".yaml", ".toml"]),
)
def test_parameters_load_gives_sound_values_or_findings_for_random_text(
    tmp_path: Path, lines: list[str], overrides: list[str], suffix: str
) -> None:
    path = tmp_path / f"config{suffix}"
    path.write_text("\n".join(lines), encoding="utf-8", errors="surrogatepass")
    assert_loads_or_reports(path, overrides)


@RELAXED
@given(data=st.binary(max_size=200), suffix=st.sampled_from([".yaml", ".toml"]))
def test_parameters_load_gives_sound_values_or_findings_for_random_bytes(
    tmp_path: Path, data: bytes, suffix: str
) -> None:
    path = tmp_path / f"config{suffix}"
    path.write_bytes(data)
    assert_loads_or_reports(path, [])


OBJECTS = st.one_of(
    st.none(), st.booleans(), st.integers(), st.floats(), st.text(max_size=9),
    st.binary(max_size=3), st.complex_numbers(), st.decimals(), st.fractions(),
    st.lists(st.integers(), max_size=2),
)  # fmt: skip


@RELAXED
@given(changes=st.dictionaries(st.sampled_from(NAMES), OBJECTS, max_size=4))
def test_parameters_set_applies_or_rejects_random_changes(changes: dict[str, Any]) -> None:
    params = Params.load(None, ["joints[0].name=x"])
    before = params.values()
    reason = rejection_reason(params, changes)
    if reason is None:
        assert all(name in before for name in changes)
    else:
        assert reason
        assert params.values() == before
    assert_sound(params)


def rejection_reason(params: Params, changes: dict[str, Any]) -> str | None:
    try:
        params.set(changes)
    except ParameterRejected as refusal:
        return refusal.reason
    return None
