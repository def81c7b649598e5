"""Types of ROS definitions: their CDR bytes are those of rosbags, their hashes those of ROS 2."""

from __future__ import annotations

from collections.abc import Iterator
from pathlib import Path
from typing import Annotated, Any

import numpy as np
import pytest
from hypothesis import HealthCheck, given, settings
from hypothesis import strategies as st
from rosbags.typesys import Stores, get_types_from_msg, get_typestore

from robocomp_dsl.runtime import types as rt
from robocomp_dsl.runtime.codec import codec
from robocomp_dsl.runtime.data.ros_type_hash import message_hash, service_hash
from tests.runtime.random_schemas import values
from tests.support.ros_types import ros_types

PACKAGES = Path(__file__).parent.parent / "support" / "ros_packages"
HASHES = Path(__file__).with_name("ros_type_hashes.txt")
TEST_MESSAGES = [f"test_msgs/msg/{path.stem}" for path in sorted(PACKAGES.glob("*/msg/*.msg"))]
DEEP = "test_msgs/msg/MultiNested"  # arrays of all the others: its values take seconds to draw
STORE = get_typestore(Stores.ROS2_KILTED)
STD_MESSAGES = [name for name in STORE.fielddefs if name.startswith("std_msgs/")]
MESSAGES = [
    *STD_MESSAGES,
    *(name for name in TEST_MESSAGES if name != DEEP),
    "diagnostic_msgs/msg/DiagnosticArray",
    "geometry_msgs/msg/PoseStamped",
    "geometry_msgs/msg/Twist",
    "nav_msgs/msg/OccupancyGrid",
    "nav_msgs/msg/Odometry",
    "nav_msgs/msg/Path",
    "sensor_msgs/msg/CameraInfo",
    "sensor_msgs/msg/Image",
    "sensor_msgs/msg/JointState",
    "sensor_msgs/msg/LaserScan",
    "sensor_msgs/msg/PointCloud2",
    "shape_msgs/msg/Mesh",
    "shape_msgs/msg/SolidPrimitive",
    "tf2_msgs/msg/TFMessage",
    "trajectory_msgs/msg/JointTrajectory",
    "visualization_msgs/msg/MarkerArray",
]
SERVICES = [f"test_msgs/srv/{path.stem}" for path in sorted(PACKAGES.glob("*/srv/*.srv"))]
SERVICES += ["std_srvs/srv/Empty", "std_srvs/srv/SetBool", "std_srvs/srv/Trigger"]
ACTIONS = ["test_msgs/action/Fibonacci", "test_msgs/action/NestedMessage"]


@pytest.fixture(scope="module")
def types(tmp_path_factory: pytest.TempPathFactory) -> dict[str, type[rt.Struct]]:
    """The structs of all these definitions by ROS name."""
    for name in TEST_MESSAGES:
        text = (PACKAGES / f"{name}.msg").read_text()
        STORE.register(get_types_from_msg(text, name))
    imports = [f"{name}.msg" for name in MESSAGES] + [f"{name}.srv" for name in SERVICES]
    imports += [f"{name}.action" for name in ACTIONS]
    folder = tmp_path_factory.mktemp("ros")
    return ros_types(imports, folder, {"AMENT_PREFIX_PATH": str(PACKAGES)})


def peer_value(name: str, value: rt.Struct) -> Any:
    """Our value as an object of rosbags."""
    _, fields = STORE.fielddefs[name]
    attributes = value._names_ or ("",)
    found = [
        peer_field(descriptor, getattr(value, attribute, 0))
        for attribute, (_, descriptor) in zip(attributes, fields, strict=True)
    ]
    return STORE.types[name](*found)


def peer_field(descriptor: Any, value: Any) -> Any:
    kind, detail = descriptor
    if kind.name == "NAME":
        return peer_value(detail, value)
    if kind.name == "BASE":  # rosbags reads `byte` as signed
        return value - 256 if detail[0] == "byte" and value > 127 else value
    element, _ = detail
    if element[0].name == "NAME":
        return [peer_value(element[1], item) for item in value]
    if element[1][0] == "byte":
        return np.asarray(value).view(np.int8)
    return value


@pytest.mark.parametrize("name", MESSAGES)
@settings(max_examples=4, deadline=None, suppress_health_check=list(HealthCheck), derandomize=True)
@given(data=st.data())
def test_ros_message_has_the_bytes_of_rosbags(
    name: str, types: dict[str, type[rt.Struct]], data: st.DataObject
) -> None:
    message = data.draw(values(types[name], nan=False))
    encoded = codec.encode(message)
    assert encoded == bytes(STORE.serialize_cdr(peer_value(name, message), name))
    assert codec.decode(types[name], encoded) == message


def golden_hashes() -> Iterator[tuple[str, str]]:
    for line in HASHES.read_text().splitlines():
        if not line.startswith("#"):
            name, digest = line.split()
            yield name, f"RIHS01_{digest}"


def test_type_hashes_are_those_of_ros(tmp_path: Path) -> None:
    golden = dict(golden_hashes())
    parts = ("_Request", "_Response", "_Goal", "_Result", "_Feedback")
    names = [name for name in golden if not name.endswith(parts)]
    imports = [f"{name}.{name.split('/')[1]}" for name in names if "/action/" not in name]
    imports += [f"{name}.action" for name in ACTIONS]
    types = ros_types(imports, tmp_path, {"AMENT_PREFIX_PATH": str(PACKAGES)})
    hashes = {name: message_hash(type_) for name, type_ in types.items()}
    for name in names:
        if "/srv/" in name:
            hashes[name] = service_hash(types[f"{name}_Request"], types[f"{name}_Response"])
    assert {name: hashes.get(name) for name in golden if "/action/" not in name} == {
        name: digest for name, digest in golden.items() if "/action/" not in name
    }
    structs = {name: golden[name] for name in golden if "/action/" in name and name in types}
    assert len(structs) == 3 * len(ACTIONS)
    assert {name: hashes[name] for name in structs} == structs


def test_message_hash_rejects_type_of_idsl() -> None:
    class Beam(rt.Struct, type_id="RoboCompLaser::Beam"):
        dist: rt.Float = 0.0

    with pytest.raises(TypeError, match="Beam is not imported from a ROS definition"):
        message_hash(Beam)


def test_service_hash_rejects_parts_of_two_services(types: dict[str, type[rt.Struct]]) -> None:
    with pytest.raises(TypeError, match="not the two parts of one ROS service"):
        service_hash(types["std_srvs/srv/SetBool_Request"], types["std_srvs/srv/Empty_Response"])


def test_ros_message_with_garbage_in_padding_is_decoded(
    types: dict[str, type[rt.Struct]],
) -> None:
    point_field, arrays = (
        types[f"{name}"] for name in ("sensor_msgs/msg/PointField", "test_msgs/msg/Arrays")
    )
    message = point_field("x", 1, 7, 2)
    encoded = bytearray(codec.encode(message))
    assert bytes(encoded[-7:-4]) == bytes(3)
    encoded[-7:-4] = b"\xaa\xbb\xcc"
    assert codec.decode(point_field, bytes(encoded)) == message
    message = arrays(bool_values=[True, False, True], float32_values=[1.0, 2.0, 3.0])
    encoded = bytearray(codec.encode(message))
    assert bytes(encoded[4 + 9 : 4 + 12]) == bytes(3)  # after 3 bool, 3 byte, 3 char
    encoded[4 + 9 : 4 + 12] = b"\xaa\xbb\xcc"
    assert codec.decode(arrays, bytes(encoded)) == message


def test_ros_defaults_are_those_of_the_definition(types: dict[str, type[rt.Struct]]) -> None:
    defaults: Any = types["test_msgs/msg/Defaults"]()
    assert (defaults.bool_value, defaults.int8_value, defaults.uint64_value) == (
        True,
        -50,
        50000000,
    )
    strings: Any = types["test_msgs/msg/Strings"]()
    assert strings.string_value_default4 == "Hello'world!"
    assert strings.bounded_string_value_default5 == 'Hello"world!'
    arrays: Any = types["test_msgs/msg/Arrays"]()
    assert arrays.uint64_values_default.tolist() == [0, 1, 2**64 - 1]
    assert arrays.string_values_default == ["", "max value", "min value"]
    assert arrays.string_values == ["", "", ""]
    assert len(arrays.basic_types_values) == 3
    arrays.int8_values_default[0] = 5
    assert types["test_msgs/msg/Arrays"]().int8_values_default.tolist() == [0, 127, -128]  # type: ignore[attr-defined]


def test_ros_constants_are_attributes_of_the_class(types: dict[str, type[rt.Struct]]) -> None:
    constants: Any = types["test_msgs/msg/Constants"]
    assert (constants.INT8_CONST, constants.FLOAT64_CONST, constants.BOOL_CONST) == (
        -50,
        1.125,
        True,
    )
    assert types["test_msgs/msg/Strings"].STRING_CONST == "Hello world!"  # type: ignore[attr-defined]


def test_lengths_of_ros_arrays_are_enforced(types: dict[str, type[rt.Struct]]) -> None:
    arrays, bounded, strings = (
        types[f"test_msgs/msg/{name}"] for name in ("Arrays", "BoundedPlainSequences", "Strings")
    )
    with pytest.raises(rt.EncodeError, match=r"^float32_values: has 2 values, it needs 3"):
        codec.encode(arrays(float32_values=[1.0, 2.0]))
    with pytest.raises(rt.EncodeError, match="string_values: has 4 values, it needs 3"):
        codec.encode(arrays(string_values=["a", "b", "c", "d"]))
    with pytest.raises(rt.EncodeError, match="int16_values: has 4 values, at most 3"):
        codec.encode(bounded(int16_values=[1, 2, 3, 4]))
    with pytest.raises(rt.EncodeError, match="takes at most 22 bytes of text, not 24"):
        codec.encode(strings(bounded_string_value="é" * 12))


def test_received_ros_message_beyond_its_bound_is_malformed() -> None:
    class Wide(rt.Struct):
        items: rt.Int16Array = rt.default()

    class Narrow(rt.Struct):
        items: Annotated[rt.Int16Array, rt.MaxLength(2)] = rt.default()

    with pytest.raises(rt.MalformedMessage, match="3 elements, more than 2"):
        codec.decode(Narrow, codec.encode(Wide([1, 2, 3])))
