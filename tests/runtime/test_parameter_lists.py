"""Lists of plain values: read from every format, overridden, changed while the component runs."""

from __future__ import annotations

from pathlib import Path
from typing import Any, Literal

import numpy as np
import pytest

from robocomp_dsl.runtime.parameters import (
    ConfigError,
    Group,
    Parameter,
    ParameterGroup,
    ParameterRejected,
    Parameters,
)
from robocomp_dsl.runtime.parameters.shown import describe_parameters


class LegsGroup(ParameterGroup):
    SCHEMA = (
        Parameter("limits", "float", default=(-1.0, 1.0), live=True, shortest=2, longest=2),
        Parameter("name", "string", default="leg"),
    )
    limits: list[float]
    name: str


class ListParams(Parameters):
    SCHEMA = (
        Parameter(
            "weights",
            "float",
            default=(1.0,),
            low=0.0,
            high=10.0,
            unit="kg",
            live=True,
            shortest=1,
            longest=4,
        ),
        Parameter("ids", "int", default=(5, 6, 7), shortest=3, longest=3),
        Parameter("names", "string", default=(), live=True, shortest=0),
        Parameter(
            "modes", "choice", default=("a",), choices=("a", "b"), live=True, shortest=1, longest=2
        ),
        Parameter("flags", "bool", default=(), shortest=0, longest=2),
        Group("legs", LegsGroup),
        Parameter("rate", "float", default=1.0, live=True),
    )
    weights: list[float]
    ids: list[int]
    names: list[str]
    modes: list[Literal["a", "b"]]
    flags: list[bool]
    legs: list[LegsGroup]
    rate: float


class RequiredParams(Parameters):
    SCHEMA = (Parameter("gains", "float", unit="N", shortest=2, longest=2),)
    gains: list[float]


def load(folder: Path, text: str, *overrides: str, suffix: str = ".yaml") -> ListParams:
    file = folder / f"config{suffix}"
    file.write_text(text, encoding="utf-8")
    return ListParams.load(file, overrides)


def problems(error: ConfigError) -> list[str]:
    return [f"{f.location.line}:{f.location.column} {f.message}" for f in error.findings]


def test_list_parameters_have_defaults_of_their_own() -> None:
    first, second = ListParams.load(), ListParams.load()
    assert (first.weights, first.ids, first.names) == ([1.0], [5, 6, 7], [])
    first.ids.append(9)
    assert second.ids == [5, 6, 7] == ListParams.load().ids


YAML = """\
weights: [1, 2.5]
ids:
  - 1
  - 0x10
  - 3
names: [left, "x, y", '[]']
modes: [b, a]
flags: [true, off]
legs:
  - limits: [-2, 2]
"""
TOML = """\
weights = [1, 2.5]
ids = [
    1, # one
    0x10,
    3,
]
names = ["left", "x, y", '[]']
modes = ["b", "a"]
flags = [true, false]
[[legs]]
limits = [-2, 2.0]
"""
TEXT = """\
weights = 1, 2.5
ids = 1,0x10,3 # three
names = "left", "x, y", "[]"
modes = b,a
flags = {true, off}
"""


@pytest.mark.parametrize(("text", "suffix"), [(YAML, ".yaml"), (TOML, ".toml"), (TEXT, "")])
def test_load_reads_lists_in_every_format(tmp_path: Path, text: str, suffix: str) -> None:
    params = load(tmp_path, text, suffix=suffix)
    assert params.weights == [1.0, 2.5]
    assert [type(weight) for weight in params.weights] == [float, float]
    assert params.ids == [1, 16, 3]
    assert params.names == ["left", "x, y", "[]"]
    assert params.modes == ["b", "a"]
    assert params.flags == [True, False]
    if params.legs:
        assert params.legs[0].limits == [-2.0, 2.0]


WRONG_YAML = """\
weights: [1, fast, 50]
ids: [1, 2]
names:
  - a
  - 5
  - [b]
modes: [c]
flags: true
legs:
  - limits: 3
"""
YAML_PROBLEMS = [
    "1:14 `weights[1]` must be a number, not `fast`",
    "1:20 `weights[2]` is 50 kg, its highest value is 10 kg",
    "2:6 `ids` has 2 elements, it must have 3",
    "5:5 `names[1]` must be a string, not the number 5",
    "6:5 `names[2]` must be a string, not a list",
    "7:9 `modes[0]` cannot be `c`",
    "8:8 `flags` must be a list of true and false, not a single value",
    "10:13 `legs[0].limits` must be a list of numbers, not a single value",
]
WRONG_TOML = """\
weights = [1, "fast", 50]
ids = [
    1,    # [comment
    2.5,
    "a]b",
]
modes = []
"""
TOML_PROBLEMS = [
    "1:15 `weights[1]` must be a number, not a quoted string",
    "1:23 `weights[2]` is 50 kg, its highest value is 10 kg",
    "4:5 `ids[1]` must be a whole number, not `2.5`",
    "5:5 `ids[2]` must be a whole number, not a quoted string",
    "7:9 `modes` has 0 elements, it must have 1 to 2",
]
WRONG_TEXT = "weights = 1, fast,50\nids = 1,2\n"
TEXT_PROBLEMS = [
    "1:14 `weights[1]` must be a number, not `fast`",
    "1:19 `weights[2]` is 50 kg, its highest value is 10 kg",
    "2:7 `ids` has 2 elements, it must have 3",
]


@pytest.mark.parametrize(
    ("text", "suffix", "expected"),
    [
        (WRONG_YAML, ".yaml", YAML_PROBLEMS),
        (WRONG_TOML, ".toml", TOML_PROBLEMS),
        (WRONG_TEXT, "", TEXT_PROBLEMS),
    ],
)
def test_load_locates_wrong_elements(
    tmp_path: Path, text: str, suffix: str, expected: list[str]
) -> None:
    with pytest.raises(ConfigError) as caught:
        load(tmp_path, text, suffix=suffix)
    assert problems(caught.value) == expected


def test_load_suggests_brackets_for_a_single_value(tmp_path: Path) -> None:
    with pytest.raises(ConfigError) as caught:
        load(tmp_path, "weights: 1, 2\n")
    assert caught.value.findings[0].help == "write `weights: [1, 2]`"


def test_load_needs_a_list_without_default() -> None:
    with pytest.raises(ConfigError) as caught:
        RequiredParams.load()
    (finding,) = caught.value.findings
    assert finding.message == "`gains` is not given and has no default"
    assert finding.help == "add `gains: [<float [N]>, …]`"
    assert RequiredParams.load(None, ["gains=1,2"]).gains == [1.0, 2.0]


@pytest.mark.parametrize(
    ("overrides", "name", "value"),
    [
        (["weights=2,3"], "weights", [2.0, 3.0]),
        (["weights=[2, 3]"], "weights", [2.0, 3.0]),
        (["weights={2, 3,}"], "weights", [2.0, 3.0]),
        (["weights=7"], "weights", [7.0]),
        (["names="], "names", []),
        (["names=[]"], "names", []),
        (['names=["a, b", c]'], "names", ["a, b", "c"]),
        ([r'names="a\"b"'], "names", ['a"b']),
        (["ids[1]=9"], "ids", [5, 9, 7]),
        (["ids[0]=1", "ids[2]=3"], "ids", [1, 6, 3]),
        (["weights[0]=2", "weights[1]=3"], "weights", [2.0, 3.0]),
        (["weights=1,2", "weights[1]=3"], "weights", [1.0, 3.0]),
        (["legs[0].limits[1]=4"], "legs[0].limits", [-1.0, 4.0]),
    ],
)
def test_overrides_set_lists_and_elements(
    overrides: list[str], name: str, value: list[Any]
) -> None:
    assert ListParams.load(None, overrides).values()[name] == value


def test_overrides_set_an_element_of_a_list_in_a_file(tmp_path: Path) -> None:
    assert load(tmp_path, "weights: [1, 2]\n", "weights[0]=3").weights == [3.0, 2.0]
    assert load(tmp_path, "weights = 1, 2\n", "weights[0]=3", suffix="").weights == [3.0, 2.0]
    text = "legs:\n  - {name: a}\n"
    assert load(tmp_path, text, "legs[0].limits[0]=-3").legs[0].limits == [-3.0, 1.0]


@pytest.mark.parametrize(
    ("override", "problem"),
    [
        ("weights=1,x,3", "1:11 `weights[1]` must be a number, not `x`"),
        ("weights=[1, 99]", "1:13 `weights[1]` is 99 kg, its highest value is 10 kg"),
        ("ids=1,2", "1:5 `ids` has 2 elements, it must have 3"),
        ("ids[1]=x", "1:8 `ids[1]` must be a whole number, not `x`"),
        ("ids[5]=1", "1:1 `ids` has 3 entries, there is no [5] (they count from 0)"),
        ("weights[2]=1", "1:1 `weights` has 1 entries, there is no [2] (they count from 0)"),
        ("rate=1,2", "1:6 `rate` must be a number, not `1,2`"),
    ],
)
def test_overrides_locate_wrong_elements(override: str, problem: str) -> None:
    with pytest.raises(ConfigError) as caught:
        ListParams.load(None, [override])
    assert problems(caught.value) == [problem]


class Worker:
    def __init__(self) -> None:
        self.calls: list[tuple[Any, ...]] = []

    def will_set_weights(self, value: list[float]) -> None:
        if sum(value) > 20:
            raise ParameterRejected("too heavy")
        self.calls.append(("will", value))

    def did_set_weights(self, old: list[float]) -> None:
        self.calls.append(("did", old))

    def will_set_legs_limits(self, value: list[float], index: int) -> None:
        self.calls.append((index, value))


def test_set_changes_lists_and_calls_hooks_with_the_whole_list() -> None:
    params = ListParams.load(None, ["weights=1,2,3", "legs[0].name=a"])
    worker = Worker()
    params.bind(worker)
    before = params.weights
    params.set({"weights[0]": 4, "weights[2]": np.float32(0.5), "legs[0].limits": (-2, 2)})
    assert params.weights == [4.0, 2.0, 0.5]
    assert before == [1.0, 2.0, 3.0], "a list that is in use does not change"
    assert worker.calls == [
        ("will", [4.0, 2.0, 0.5]),
        (0, [-2.0, 2.0]),
        ("did", [1.0, 2.0, 3.0]),
    ]
    params.set({"weights": np.array([1, 2])})
    assert params.weights == [1.0, 2.0]
    params.set_text({"weights": "3, 4", "names": '["x, y"]', "modes[0]": "b"})
    assert (params.weights, params.names, params.modes) == ([3.0, 4.0], ["x, y"], ["b"])


@pytest.mark.parametrize(
    ("change", "reason"),
    [
        ({"weights": 5}, "`weights` must be a list of numbers, not 5; expected float[1:4]"),
        ({"weights": "12"}, "`weights` must be a list of numbers, not '12'"),
        ({"weights": [1, "x", 50]}, "`weights[1]` must be a number, not 'x'; expected float\n"),
        ({"weights": [1, 2, 50]}, "`weights[2]` is 50 kg, its highest value is 10 kg; too high"),
        ({"weights": []}, "`weights` has 0 elements, it must have 1 to 4"),
        ({"weights[0]": [1]}, "`weights[0]` must be a number, not [1]; expected float"),
        ({"weights[0]": 11}, "`weights[0]` is 11 kg, its highest value is 10 kg; too high"),
        ({"weights[2]": 1}, "`weights` has 1 element, there is no [2] (they count from 0)"),
        ({"weights": [9, 9, 9]}, "`weights` stays [1.0]: too heavy"),
        ({"ids": [1, 2, 3]}, "`ids` is not live"),
        ({"ids[0]": 1}, "`ids[0]` is not live"),
        ({"rate[0]": 1.0}, "unknown parameter `rate[0]`"),
        ({"modes": ["a", "c"]}, "`modes[1]` cannot be `c`"),
    ],
)
def test_set_rejects_wrong_lists_and_changes_nothing(change: dict[str, Any], reason: str) -> None:
    params = ListParams.load()
    params.bind(Worker())
    before = params.values()
    with pytest.raises(ParameterRejected) as caught:
        params.set({"rate": 5.0, **change})
    assert caught.value.reason.startswith(reason)
    assert params.values() == before


def test_save_keeps_lists_for_the_next_start(tmp_path: Path) -> None:
    config = tmp_path / "config.yaml"
    config.write_text("weights: [9]\n")
    params = ListParams.load(config, save_beside=config)
    params.set({"weights": [1, 2.5], "names": ['a "b"', "x, y", "é\n"]})
    params.save()
    again = ListParams.load(config, save_beside=config)
    assert again.weights == [1.0, 2.5]
    assert again.names == ['a "b"', "x, y", "é\n"]
    assert ListParams.load(config, ["weights[0]=4"], save_beside=config).weights == [4.0, 2.5]


def test_describe_gives_the_type_with_the_length() -> None:
    described = {d.name: d for d in ListParams.load(None, ["legs[0].name=a"]).describe()}
    types = [described[n].type for n in ("weights", "ids", "names", "flags", "rate")]
    assert types == ["float[1:4]", "int[3]", "string[]", "bool[0:2]", "float"]
    assert described["legs[0].limits"].value == [-1.0, 1.0]


def test_describe_parameters_shows_lists_in_the_help() -> None:
    lines = list(describe_parameters(ListParams.SCHEMA))
    assert lines[:4] == [
        "  weights=<float>,…  1 to 4 values, 0 to 10 kg, [1] if not given, "
        "may change while running",
        "  ids=<int>,…  3 values, [5, 6, 7] if not given",
        "  names=<string>,…  any number of values, [] if not given, may change while running",
        '  modes=a|b,…  1 to 2 values, ["a"] if not given, may change while running',
    ]
