"""Structs, exceptions and interfaces as generated code declares them."""

from __future__ import annotations

import copy
import pickle
import subprocess
import sys
from typing import Any

import numpy as np
import pytest

from robocomp_dsl.runtime import types as rt
from tests.runtime.random_schemas import array_of, enumeration, struct_of


class Pose(rt.Struct, rename={"None_": "None"}):
    joints: rt.Float64Array = rt.default()
    None_: rt.String = ""
    parts: dict[rt.String, rt.Int32Array] = rt.default()


class HardwareFailed(rt.DeclaredError):
    what: rt.String = ""


def pose(last: float = 2.0) -> Pose:
    return Pose(np.array([1.0, last]), "a", {"b": np.array([3], np.int32)})


def test_struct_compares_by_value() -> None:
    assert pose() == pose()
    assert pose() != pose(3.0)
    assert pose() != HardwareFailed("a")
    assert len({pose(), pose(), pose(3.0)}) == 2
    assert hash(Pose([1.0, 2.0])) == hash(Pose(np.array([1.0, 2.0])))  # type: ignore[arg-type]


def test_struct_rejects_unknown_attribute() -> None:
    with pytest.raises(AttributeError):
        pose().joint = 5  # type: ignore[attr-defined]


def test_struct_repr_is_constructor_call() -> None:
    assert repr(pose()) == "Pose(joints=[1.0, 2.0], None_='a', parts={'b': [3]})"
    assert "… 100 float64]" in repr(Pose(np.zeros(100)))


@pytest.mark.parametrize("value", [pose(), HardwareFailed("x")], ids=["struct", "exception"])
def test_struct_and_exception_are_copied_and_pickled(value: Any) -> None:
    for again in (copy.copy(value), copy.deepcopy(value), pickle.loads(pickle.dumps(value))):
        assert again == value
        assert type(again) is type(value)


def test_struct_knows_its_name_in_the_idsl_file() -> None:
    class Beam(rt.Struct, type_id="RoboCompLaser::Beam"):
        angle: rt.Float = 0.0

    class UsersBeam(Beam):
        pass

    assert (Beam._type_id_, UsersBeam._type_id_) == ("RoboCompLaser::Beam",) * 2
    assert Pose._type_id_ == ""  # written by hand


def test_declared_exception_message_shows_fields() -> None:
    with pytest.raises(HardwareFailed) as caught:
        raise HardwareFailed(what="motor 3")
    assert str(caught.value) == "HardwareFailed(what='motor 3')"
    assert caught.value == HardwareFailed("motor 3")


def test_struct_fields_use_names_of_idsl() -> None:
    assert Pose._names_ == ("joints", "None_", "parts")
    assert [name for name, _ in Pose._fields_] == ["joints", "None", "parts"]
    assert dict(Pose._fields_)["parts"] == rt.Dictionary(rt.STRING, rt.Array(rt.INT))


def test_struct_defaults_are_fresh_for_each_struct() -> None:
    first, second = Pose(), Pose()
    first.parts["a"] = np.zeros(1, np.int32)
    assert second.parts == {}
    assert first.joints is not second.joints
    assert first.joints.dtype == np.float64


def test_struct_is_constructed_by_position_and_by_name() -> None:
    class Range(rt.Struct):
        low: rt.Int
        high: rt.Int = 5

    assert Range(1) == Range(low=1, high=5) == Range(1, 5)
    with pytest.raises(TypeError, match="low"):
        Range()  # type: ignore[call-arg]
    with pytest.raises(TypeError, match="width"):
        Range(1, width=3)  # type: ignore[call-arg]
    match Range(1, 2):
        case Range(low, high):
            assert (low, high) == (1, 2)


def test_struct_subclass_of_user_inherits_fields() -> None:
    class Marked(Pose):
        mark: int

        def __init__(self, mark: int) -> None:
            super().__init__(None_="x")
            self.mark = mark

    assert Marked(3).mark == 3
    assert Marked(3) == Pose(None_="x")


def wrong(**annotations: Any) -> Any:
    return type("Wrong", (rt.Struct,), {"__annotations__": annotations, "__module__": __name__})


def test_struct_rejects_annotation_that_is_no_idsl_type() -> None:
    with pytest.raises(TypeError, match=r"float.* is no type of IDSL"):
        wrong(x=float)
    with pytest.raises(TypeError, match="must be defined above"):
        wrong(x="Missing")


def test_struct_rejects_shared_mutable_default() -> None:
    class Shared(rt.Struct):
        names: list[rt.String] = []  # noqa: RUF012 - that is the mistake

    class Empty(rt.Struct):
        x: rt.Int = rt.default()

    for cls in (Shared, Empty):
        with pytest.raises(TypeError, match="its default must be"):
            cls()


@pytest.mark.parametrize(
    "make",
    [
        lambda: rt.Array(rt.STRING),
        lambda: rt.Sequence(rt.INT),
        lambda: rt.Dictionary(rt.Array(rt.INT), rt.INT),
    ],
)
def test_container_types_reject_invalid_element(make: Any) -> None:
    with pytest.raises(TypeError):
        make()


def interface(**changed: Any) -> rt.Interface:
    spec: dict[str, Any] = {
        "name": "move",
        "pattern": rt.Pattern.QUERY,
        "inputs": (("to", struct_of([rt.INT])),),
        "outputs": (("", enumeration([1, 2])), ("l", rt.Sequence(rt.STRING))),
        "throws": (struct_of([rt.STRING], rt.DeclaredError),),
    }
    return rt.Interface("Arm::Arm", rt.Operation(**{**spec, **changed}))


def test_interface_hash_ignores_type_names() -> None:
    assert interface().hash == interface().hash
    assert len(interface().hash) == 8
    assert interface(idempotent=True).hash == interface().hash
    rows, objects = array_of(struct_of([rt.INT])), rt.Sequence(struct_of([rt.INT]))
    assert interface(inputs=(("a", rows),)).hash == interface(inputs=(("a", objects),)).hash


@pytest.mark.parametrize(
    "changed",
    [
        {"name": "moveTo"},
        {"pattern": rt.Pattern.COMMAND},
        {"inputs": (("to", struct_of([rt.LONG])),)},
        {"inputs": (("at", struct_of([rt.INT])),)},
        {"inputs": (("to", rt.INT),)},
        {"inputs": (("to", struct_of([rt.INT])), ("x", rt.INT))},
        {"outputs": (("", enumeration([1, 3])), ("l", rt.Sequence(rt.STRING)))},
        {"outputs": (("", enumeration([1, 2])), ("l", rt.Dictionary(rt.INT, rt.STRING)))},
        {"throws": ()},
        {"throws": (struct_of([rt.INT], rt.DeclaredError),)},
    ],
)
def test_interface_hash_detects_change(changed: dict[str, Any]) -> None:
    assert interface(**changed).hash != interface().hash


def test_interface_hash_is_stable_across_releases() -> None:
    # Fixed here, for components of different releases of this project must understand each other.
    operation = rt.Operation("stop", rt.Pattern.COMMAND, inputs=(("hard", rt.BOOL),))
    assert rt.Interface("A::B", operation).hash.hex() == "f63fcdb396d27f2d"


def test_interface_hash_ignores_order_of_operations() -> None:
    first, second = rt.Operation("a", rt.Pattern.QUERY), rt.Operation("b", rt.Pattern.QUERY)
    assert rt.Interface("A::B", first, second).hash == rt.Interface("A::B", second, first).hash
    assert rt.Interface("A::B", first, second).operation("b") is second


def test_types_module_imports_nothing_heavy() -> None:
    code = "import sys, robocomp_dsl.runtime.types; print(*sys.modules)"
    loaded = subprocess.run(
        [sys.executable, "-c", code], capture_output=True, text=True, check=True
    ).stdout.split()
    heavy = {"zenoh", "yaml", "lark", "jinja2", "click", "asyncio", "ssl", "mujoco"}
    assert heavy.isdisjoint(loaded)
