"""Names, md5 sums and definitions of ROS 1 for structs in the form of ROS 2."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import pytest
from rosbags.typesys import Stores, get_typestore

from robocomp_dsl.runtime import types as rt
from robocomp_dsl.runtime.data.schema import UINT32
from robocomp_dsl.runtime.errors import InterfaceMismatch
from robocomp_dsl.runtime.middleware.ros1.definitions import parse_definition
from robocomp_dsl.runtime.middleware.ros1.message_types import message_type, service_type
from tests.middleware.ros1.ros1_messages import CUSTOM_TEXT, Custom
from tests.middleware.ros2.ros_messages import SetBoolRequest, SetBoolResponse
from tests.support.ros_types import ros_types

NOETIC: Any = get_typestore(Stores.ROS1_NOETIC)
SAME = [
    "diagnostic_msgs/msg/DiagnosticArray",
    "geometry_msgs/msg/PoseWithCovarianceStamped",
    "nav_msgs/msg/OccupancyGrid",
    "nav_msgs/msg/Odometry",
    "sensor_msgs/msg/CameraInfo",
    "sensor_msgs/msg/CompressedImage",
    "sensor_msgs/msg/Image",
    "sensor_msgs/msg/Imu",
    "sensor_msgs/msg/JointState",
    "sensor_msgs/msg/LaserScan",
    "sensor_msgs/msg/PointCloud2",
    "std_msgs/msg/Empty",
    "std_msgs/msg/Float64MultiArray",
    "trajectory_msgs/msg/JointTrajectory",
]


TRANSFORMS = "tf2_msgs/msg/TFMessage"
"""Not among the messages of Noetic in rosbags."""


@pytest.fixture(scope="module")
def types(tmp_path_factory: pytest.TempPathFactory) -> dict[str, type[rt.Struct]]:
    """The structs of these messages, as they are generated."""
    imports = [f"{name}.msg" for name in (*SAME, TRANSFORMS)]
    return ros_types(imports, tmp_path_factory.mktemp("ros"), {})


@pytest.mark.parametrize("name", SAME)
def test_message_type_has_the_md5_and_definition_of_noetic(
    name: str, types: dict[str, type[rt.Struct]]
) -> None:
    text, md5 = NOETIC.generate_msgdef(name, ros_version=1)
    found = message_type(types[name])
    assert found.md5 == md5
    assert found.name == name.replace("/msg/", "/")
    assert sorted(found.definition.split("=" * 80)) == sorted(text.split("=" * 80))
    has_header = NOETIC.fielddefs[name][1][:1] and NOETIC.fielddefs[name][1][0][0] == "header"
    assert found.counts == bool(has_header)


def test_message_type_of_unknown_message_follows_from_the_struct() -> None:
    found = message_type(Custom)
    assert found.definition == CUSTOM_TEXT
    assert found.counts


def test_message_type_of_transforms_has_the_md5_of_ros(types: dict[str, type[rt.Struct]]) -> None:
    assert TRANSFORMS not in NOETIC.fielddefs
    assert message_type(types[TRANSFORMS]).md5 == "94810edda583a504dfda3829e70d7eec"


def test_message_type_takes_constants_of_a_definition_in_ros_package_path(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    class Level(rt.Struct, type_id="lab_msgs/msg/Level"):
        value: rt.Byte = 0

    class Other(rt.Struct, type_id="lab_msgs/msg/Other"):
        value: rt.Byte = 0

    folder = tmp_path / "lab_msgs" / "msg"
    folder.mkdir(parents=True)
    (folder / "Level.msg").write_text("# of a lamp\nuint8 LOW=1  # dim\nuint8 value\n")
    monkeypatch.setenv("ROS_PACKAGE_PATH", str(tmp_path))
    assert message_type(Level).definition == "uint8 LOW=1\nuint8 value\n"
    assert message_type(Level).md5 != message_type(Other).md5


def test_message_type_that_ros_1_defines_otherwise_is_a_mismatch() -> None:
    class Battery(rt.Struct, type_id="sensor_msgs/msg/BatteryState"):
        voltage: rt.Float = 0.0

    class Scan(rt.Struct, type_id="std_msgs/msg/UInt32"):
        data: UINT32 = 0
        more: UINT32 = 0

    with pytest.raises(InterfaceMismatch, match="field 1 is `std_msgs/Header header` instead of"):
        message_type(Battery)
    with pytest.raises(InterfaceMismatch, match="it has no field `more`"):
        message_type(Scan)


def test_service_type_has_the_md5_of_ros() -> None:
    found = service_type(SetBoolRequest, SetBoolResponse)
    assert (found.name, found.md5) == ("std_srvs/SetBool", "09fb03525b03e7ea1fd3992bafd87e16")


def test_parse_definition_reads_ros_2() -> None:
    text = """
string NAME=a # b
Header header
builtin_interfaces/Time at
geometry_msgs/msg/Point[<=3] points
string<=5 text "default"
Own[2] own
float64[3] position [1, 2, 3]  # m
"""
    found = parse_definition(text, "lab_msgs")
    assert found.constants == (("string", "NAME", "a # b"),)
    assert found.fields == (
        ("std_msgs/Header", "header"),
        ("time", "at"),
        ("geometry_msgs/Point[]", "points"),
        ("string", "text"),
        ("lab_msgs/Own[2]", "own"),
        ("float64[3]", "position"),
    )


STATUS = """\
# a status
uint8 OK=0   # fine
uint8 BAD=1
string NAME=  hello  # not a comment
char code
std_msgs/Header header
float32[3] v
"""
DO = "uint8 A=1\nuint8 a\n---\nint32 B=-2\nbool ok\nchar c\n"


def test_md5_of_definitions_with_constants_is_that_of_genmsg(tmp_path: Path) -> None:
    """The expected values were computed by genmsg of Noetic."""
    package = tmp_path / "lab_msgs"
    (package / "msg").mkdir(parents=True)
    (package / "srv").mkdir()
    (package / "msg" / "Status.msg").write_text(STATUS)
    (package / "srv" / "Do.srv").write_text(DO)
    imports = ["lab_msgs/msg/Status.msg", "lab_msgs/srv/Do.srv"]
    found = ros_types(imports, tmp_path, {})
    status = message_type(found["lab_msgs/msg/Status"])
    assert status.md5 == "12e3103a5580b7048c82f4bd04919e70"
    request, response = (found[f"lab_msgs/srv/Do_{part}"] for part in ("Request", "Response"))
    assert service_type(request, response).md5 == "ebdb46a7bd1bfeeb417a47e3af210b41"
