"""ROS types in the schema that a component returns: a client gets the same types."""

from __future__ import annotations

from pathlib import Path

import pytest

from robocomp_dsl.client import build_types
from robocomp_dsl.runtime import types as rt
from robocomp_dsl.runtime.codec import codec
from robocomp_dsl.runtime.data.ros_type_hash import message_hash
from robocomp_dsl.runtime.dynamic.schema_interface import FieldInfo, Schema, TypeInfo
from robocomp_dsl.runtime.errors import SchemaError
from tests.generate.golden_cases import GOLDEN
from tests.runtime.dynamic.test_schema_codec import rebuild
from tests.support.ros_types import ros_types


def test_schema_keeps_ros_types(tmp_path: Path) -> None:
    types = ros_types(
        ["demo_msgs/msg/Cloud.msg"], tmp_path, {"AMENT_PREFIX_PATH": str(GOLDEN / "ros")}
    )
    cloud = types["demo_msgs/msg/Cloud"]
    interface = rt.Interface("M::I", rt.Operation("put", inputs={"cloud": cloud}))
    built = rebuild(interface)
    assert built.hash == interface.hash
    ((_, dynamic),) = built.operation("put").inputs
    assert isinstance(dynamic, type)
    assert issubclass(dynamic, rt.Struct)
    assert dynamic._type_id_ == "demo_msgs/msg/Cloud"
    assert message_hash(dynamic) == message_hash(cloud)
    encoded = codec.encode(
        cloud(height=3, labels=["x"], corners=[types["demo_msgs/msg/Point"]()] * 2)
    )
    assert codec.encode(codec.decode(dynamic, encoded)) == encoded


@pytest.mark.parametrize(
    "type_",
    ["array<int>", "array<int,0>", "array<int,-1>", "array<int,9999999>", "sequence<int,>",
     "sequence<int,x>", "string<>", "string<4", "string<4,5>", "array<3,int>", "array<int,3,4>",
     "int<4>", "array<string,1000000>"],
)  # fmt: skip
def test_invalid_length_in_schema_is_rejected(type_: str) -> None:
    schema = Schema([TypeInfo("M::T", "struct", "", [FieldInfo("field", type_)])])
    with pytest.raises(SchemaError):
        build_types(schema)
