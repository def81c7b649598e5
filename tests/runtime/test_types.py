"""Structs, exceptions and interfaces as generated code declares them."""

from __future__ import annotations

import copy
import pickle
import subprocess
import sys
from typing import Any

import numpy as np
import pytest
from random_schemas import array_of, enumeration, record

from robocomp_dsl.runtime import types as rt


class Pose(rt.Struct):
    __slots__ = ("None_", "joints", "parts")
    _fields_ = (
        ("joints", rt.Array(rt.DOUBLE)),
        ("None", rt.STRING),
        ("parts", rt.Dictionary(rt.STRING, rt.Array(rt.INT))),
    )

    def __init__(
        self,
        joints: rt.Float64Array | None = None,
        None_: str = "",  # noqa: N803 - as the generator spells a word of Python
        parts: dict[str, rt.Int32Array] | None = None,
    ) -> None:
        self.joints = np.zeros(0) if joints is None else joints
        self.None_ = None_
        self.parts = {} if parts is None else parts


class HardwareFailed(rt.DeclaredError):
    __slots__ = ("what",)
    _fields_ = (("what", rt.STRING),)

    def __init__(self, what: str = "") -> None:
        self.what = what


def pose(last: float = 2.0) -> Pose:
    return Pose(np.array([1.0, last]), "a", {"b": np.array([3], np.int32)})


def test_structs_compare_by_value() -> None:
    assert pose() == pose()
    assert pose() != pose(3.0)
    assert pose() != HardwareFailed("a")
    assert len({pose(), pose(), pose(3.0)}) == 2
    assert hash(Pose([1.0, 2.0])) == hash(Pose(np.array([1.0, 2.0])))  # type: ignore[arg-type]


def test_structs_are_slotted() -> None:
    with pytest.raises(AttributeError):
        pose().joint = 5  # type: ignore[attr-defined]


def test_structs_are_shown_as_they_are_made() -> None:
    assert repr(pose()) == "Pose(joints=[1.0, 2.0], None_='a', parts={'b': [3]})"
    assert "… 100 float64]" in repr(Pose(np.zeros(100)))


@pytest.mark.parametrize("one", [pose(), HardwareFailed("x")], ids=["struct", "exception"])
def test_records_are_copied_and_pickled(one: Any) -> None:
    for again in (copy.copy(one), copy.deepcopy(one), pickle.loads(pickle.dumps(one))):
        assert again == one
        assert type(again) is type(one)


def test_declared_exceptions_are_raised_and_told() -> None:
    with pytest.raises(HardwareFailed) as caught:
        raise HardwareFailed(what="motor 3")
    assert str(caught.value) == "HardwareFailed(what='motor 3')"
    assert caught.value == HardwareFailed("motor 3")


def test_slots_and_fields_go_together() -> None:
    spec = {"__slots__": ("a", "lambda_", "lambda__"), "_fields_": ()}
    names = ("lambda", "lambda_", "a")
    good: Any = type("Good", (rt.Struct,), {**spec, "_fields_": tuple((n, rt.INT) for n in names)})
    assert good._names_ == ("lambda__", "lambda_", "a")
    with pytest.raises(TypeError, match="do not agree"):
        type("Bad", (rt.Struct,), spec)


@pytest.mark.parametrize(
    "make",
    [
        lambda: rt.Array(rt.STRING),
        lambda: rt.Sequence(rt.INT),
        lambda: rt.Dictionary(rt.Array(rt.INT), rt.INT),
    ],
)
def test_types_that_do_not_exist(make: Any) -> None:
    with pytest.raises(TypeError):
        make()


def interface(**changed: Any) -> rt.Interface:
    spec: dict[str, Any] = {
        "name": "move",
        "pattern": rt.Pattern.QUERY,
        "inputs": (("to", record([rt.INT])),),
        "outputs": (("", enumeration([1, 2])), ("l", rt.Sequence(rt.STRING))),
        "throws": (record([rt.STRING], rt.DeclaredError),),
    }
    return rt.Interface("Arm::Arm", (rt.Operation(**{**spec, **changed}),))


def test_equal_shapes_have_equal_hashes_whatever_their_types_are_called() -> None:
    assert interface().hash == interface().hash
    assert len(interface().hash) == 8
    assert interface(idempotent=True).hash == interface().hash
    rows, objects = array_of(record([rt.INT])), rt.Sequence(record([rt.INT]))
    assert interface(inputs=(("a", rows),)).hash == interface(inputs=(("a", objects),)).hash


@pytest.mark.parametrize(
    "changed",
    [
        {"name": "moveTo"},
        {"pattern": rt.Pattern.COMMAND},
        {"inputs": (("to", record([rt.LONG])),)},
        {"inputs": (("at", record([rt.INT])),)},
        {"inputs": (("to", rt.INT),)},
        {"inputs": (("to", record([rt.INT])), ("x", rt.INT))},
        {"outputs": (("", enumeration([1, 3])), ("l", rt.Sequence(rt.STRING)))},
        {"outputs": (("", enumeration([1, 2])), ("l", rt.Dictionary(rt.INT, rt.STRING)))},
        {"throws": ()},
        {"throws": (record([rt.INT], rt.DeclaredError),)},
    ],
)
def test_the_hash_sees_a_change(changed: dict[str, Any]) -> None:
    assert interface(**changed).hash != interface().hash


def test_the_hash_is_that_of_other_processes() -> None:
    # Fixed here, for components of different releases of this project must understand each other.
    operation = rt.Operation("stop", rt.Pattern.COMMAND, inputs=(("hard", rt.BOOL),))
    assert rt.Interface("A::B", (operation,)).hash.hex() == "f63fcdb396d27f2d"


def test_the_order_of_operations_means_nothing() -> None:
    one, two = rt.Operation("a", rt.Pattern.QUERY), rt.Operation("b", rt.Pattern.QUERY)
    assert rt.Interface("A::B", (one, two)).hash == rt.Interface("A::B", (two, one)).hash
    assert rt.Interface("A::B", (one, two)).operation("b") is two


def test_types_load_nothing_heavy() -> None:
    code = "import sys, robocomp_dsl.runtime.types; print(*sys.modules)"
    loaded = subprocess.run(
        [sys.executable, "-c", code], capture_output=True, text=True, check=True
    ).stdout.split()
    heavy = {"zenoh", "yaml", "lark", "jinja2", "click", "asyncio", "ssl", "mujoco"}
    assert heavy.isdisjoint(loaded)
