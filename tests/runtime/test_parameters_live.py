"""Live changes: atomic, with hooks of the worker, and consistent for other threads."""

from __future__ import annotations

import threading
from typing import Any

import numpy as np
import pytest

from robocomp_dsl.runtime.parameters import (
    Group,
    Parameter,
    ParameterGroup,
    ParameterRejected,
    Parameters,
)


class MotorsGroup(ParameterGroup):
    SCHEMA = (
        Parameter("name", "string"),
        Parameter("min", "float", default=-1.0, live=True),
        Parameter("max", "float", default=1.0, live=True),
    )
    name: str
    min: float
    max: float


class Params(Parameters):
    SCHEMA = (
        Parameter("rate", "float", default=50.0, low=1, high=1000, unit="Hz", live=True, doc="R."),
        Parameter("count", "int", default=1, low=0, high=9, live=True),
        Parameter("mode", "choice", default="a", choices=("a", "b"), live=True),
        Parameter("on", "bool", default=False, live=True),
        Parameter("label", "string", default="", live=True),
        Parameter("device", "string", default="x"),
        Group("motors", MotorsGroup, low=1),
    )
    rate: float
    count: int
    mode: str
    on: bool
    label: str
    device: str
    motors: list[MotorsGroup]


@pytest.fixture
def params() -> Params:
    return Params.load(None, ["motors[0].name=m", "motors[1].name=n"])


@pytest.mark.parametrize(
    ("change", "expected"),
    [
        ({"rate": 20}, {"rate": 20.0}),
        ({"rate": np.float32(20.5)}, {"rate": 20.5}),
        ({"count": np.int64(3)}, {"count": 3}),
        ({"mode": "b", "on": True, "label": "x"}, {"mode": "b", "on": True, "label": "x"}),
        ({"motors[1].min": -2}, {"motors[1].min": -2.0}),
        ({}, {}),
    ],
)
def test_parameters_set_changes_values(
    params: Params, change: dict[str, Any], expected: dict[str, Any]
) -> None:
    before = params.values()
    params.set(change)
    assert params.values() == {**before, **expected}
    assert all(type(params.values()[key]) is type(value) for key, value in expected.items())


@pytest.mark.parametrize(
    ("change", "reason"),
    [
        ({"rate": 5000.0}, "`rate` is 5000 Hz, its highest value is 1000 Hz; too high"),
        ({"rate": float("nan")}, "`rate` is nan, it must be a finite number"),
        ({"rate": 10**400}, "`rate` is inf, it must be a finite number"),
        ({"rate": True}, "`rate` must be a number, not True; expected float"),
        ({"rate": "20"}, "`rate` must be a number, not '20'; expected float"),
        ({"rate": None}, "`rate` must be a number, not None; expected float"),
        ({"count": 2.0}, "`count` must be a whole number, not 2.0; expected int"),
        ({"count": False}, "`count` must be a whole number, not False; expected int"),
        ({"on": 1}, "`on` must be true or false, not 1; expected bool"),
        ({"mode": "c"}, "`mode` cannot be `c`; it is one of: a, b"),
        ({"device": "y"}, "`device` is not live: it is read at the start only"),
        ({"rat": 5}, "unknown parameter `rat`; did you mean `rate`?"),
        (
            {"motors[1].mn": 5},
            "unknown parameter `motors[1].mn`; did you mean `motors[1].min`?",
        ),
        ({"motors[7].min": 5}, "unknown parameter `motors[7].min`; `motors` has 2 entries"),
        ({"motors": []}, "`motors` is a group: change one of its members, as in `motors[0].name`"),
    ],
)
def test_parameters_set_rejects_whole_change_with_invalid_value(
    params: Params, change: dict[str, Any], reason: str
) -> None:
    before = params.values()
    with pytest.raises(ParameterRejected) as caught:
        params.set({"label": "good", **change})
    assert caught.value.reason == reason
    assert params.values() == before


def test_parameters_set_reports_all_reasons_at_once(params: Params) -> None:
    with pytest.raises(ParameterRejected) as caught:
        params.set({"rate": 0, "count": 99, "device": "y"})
    assert len(caught.value.reason.splitlines()) == 3


def test_parameters_set_text_parses_as_command_line(params: Params) -> None:
    params.set_text({"rate": "1e2", "on": "yes", "label": "5", "motors[0].max": "3"})
    assert (params.rate, params.on, params.label, params.motors[0].max) == (100.0, True, "5", 3.0)
    with pytest.raises(ParameterRejected, match="must be a number"):
        params.set_text({"rate": "fast"})


def test_parameters_reject_assignment_and_suggest_set(params: Params) -> None:
    with pytest.raises(AttributeError, match=r'self\.params\.set\(\{"rate": 3\}\)'):
        params.rate = 3
    with pytest.raises(AttributeError, match="cannot be assigned"):
        params.motors[0].min = 3
    with pytest.raises(AttributeError, match="cannot be deleted"):
        del params.rate
    assert params.rate == 50.0


class Worker:
    """Records the calls of its hooks."""

    def __init__(self, params: Params) -> None:
        self.params = params
        self.log: list[tuple[Any, ...]] = []
        params.bind(self)

    def will_set_rate(self, value: float) -> None:
        self.log.append(("will rate", value, self.params.rate))
        if value == 13:
            raise ParameterRejected("13 brings bad luck")

    def did_set_rate(self, old: float) -> None:
        self.log.append(("did rate", old, self.params.rate))

    def will_set_motors_min(self, value: float, index: int) -> None:
        self.log.append(("will min", value, index))

    def did_set_motors_min(self, old: float, index: int) -> None:
        self.log.append(("did min", old, index))

    def will_set(self, changes: dict[str, Any]) -> None:
        self.log.append(("will", dict(changes)))
        low = changes.get("motors[0].min", self.params.motors[0].min)
        if low >= changes.get("motors[0].max", self.params.motors[0].max):
            raise ParameterRejected("min must be below max")

    def did_set_count(self, old: int) -> None:
        raise ValueError("a bug of the user")


def test_parameters_set_calls_will_set_before_and_did_set_after(params: Params) -> None:
    worker = Worker(params)
    params.set({"rate": 20, "motors[1].min": -2, "label": ""})
    assert worker.log == [
        ("will rate", 20.0, 50.0),
        ("will min", -2.0, 1),
        ("will", {"rate": 20.0, "motors[1].min": -2.0}),
        ("did rate", 50.0, 20.0),
        ("did min", -1.0, 1),
    ]


@pytest.mark.parametrize(
    ("change", "reason"),
    [
        ({"rate": 13}, "`rate` stays 50.0: 13 brings bad luck"),
        ({"motors[0].min": 5}, "min must be below max"),
    ],
)
def test_will_set_hook_rejects_whole_change(
    params: Params, change: dict[str, Any], reason: str
) -> None:
    before = params.values()
    worker = Worker(params)
    with pytest.raises(ParameterRejected) as caught:
        params.set({"label": "new", **change})
    assert caught.value.reason == reason
    assert params.values() == before
    assert not any(entry[0].startswith("did") for entry in worker.log)


def test_parameters_set_validates_combined_change(params: Params) -> None:
    Worker(params)
    params.set({"motors[0].min": 5, "motors[0].max": 6})
    assert (params.motors[0].min, params.motors[0].max) == (5.0, 6.0)


def test_failing_did_set_hook_is_logged_and_change_stays(
    params: Params, caplog: pytest.LogCaptureFixture
) -> None:
    Worker(params)
    params.set({"count": 5})
    assert params.count == 5
    assert "did_set of `count` failed" in caplog.text


def test_parameters_describe_lists_attributes(params: Params) -> None:
    rows = {row.name: row for row in params.describe()}
    assert list(rows)[-3:] == ["motors[1].name", "motors[1].min", "motors[1].max"]
    rate = rows["rate"]
    assert (rate.kind, rate.value, rate.default, rate.low, rate.high, rate.unit, rate.live) == (
        "float", 50.0, 50.0, 1, 1000, "Hz", True
    )  # fmt: skip
    assert rate.doc == "R."
    assert rows["mode"].choices == ("a", "b")
    assert rows["motors[0].name"].default is None


def test_parameters_values_is_atomic(params: Params) -> None:
    stop = threading.Event()
    torn: list[tuple[Any, Any]] = []

    def read() -> None:
        while not stop.is_set():
            seen = params.values()
            if seen["rate"] != seen["motors[0].max"]:
                torn.append((seen["rate"], seen["motors[0].max"]))

    params.set({"rate": 1, "motors[0].max": 1})
    readers = [threading.Thread(target=read) for _ in range(2)]
    for reader in readers:
        reader.start()
    for value in range(1, 500):
        params.set({"rate": value, "motors[0].max": value})
    stop.set()
    for reader in readers:
        reader.join()
    assert torn == []


def test_parameters_set_may_be_called_from_did_set_hook(params: Params) -> None:
    class Clamp:
        def did_set_rate(self, old: float) -> None:
            if params.rate > 100:
                params.set({"rate": 100})

    params.bind(Clamp())
    params.set({"rate": 500})
    assert params.rate == 100.0
