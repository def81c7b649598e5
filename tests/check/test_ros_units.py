"""Units of well-known ROS messages: the table fits the definitions and fills missing units."""

from __future__ import annotations

from pathlib import Path

import pytest
from rosbags.typesys import Stores, get_typestore

from robocomp_dsl.check.idsl.ros_units import ROS_UNITS
from robocomp_dsl.check.passes import check_idsl
from robocomp_dsl.check.workspace.workspace import Workspace
from robocomp_dsl.diagnostics import Report
from robocomp_dsl.language_server.signatures.signatures_idsl import SIGNATURES
from robocomp_dsl.model.types import Struct


def message(name: str, folder: Path, definition: str = "") -> Struct:
    """The struct of a message: the one of rosbags, or with this definition."""
    if definition:
        (folder / name).parent.mkdir(parents=True)
        (folder / f"{name}.msg").write_text(definition)
    path = folder / "Demo.idsl"
    path.write_text(f'import "{name}.msg";\nmodule Demo {{ }};\n')
    report = Report()
    modules = check_idsl(path, Workspace(environ={}), report)
    assert modules
    assert not list(report)
    (struct,) = modules[0].imports[0].declarations
    assert isinstance(struct, Struct)
    return struct


def test_ros_units_name_fields_that_exist() -> None:
    store = get_typestore(Stores.ROS2_KILTED)
    for name, units in ROS_UNITS.items():
        if name == "geometry_msgs/msg/Pose2D":  # not in Kilted, in ROS 1 and earlier ROS 2
            continue
        fields = {field for field, _ in store.fielddefs[name][1]}
        assert units.keys() <= fields, name


@pytest.mark.parametrize(
    ("name", "expected"),
    [
        ("sensor_msgs/msg/LaserScan", {"angle_min": "rad", "ranges": "m", "intensities": ""}),
        ("sensor_msgs/msg/Imu", {"angular_velocity": "rad/s", "linear_acceleration": "m/s^2"}),
        ("sensor_msgs/msg/JointState", {"position": "", "velocity": "", "effort": ""}),
        ("sensor_msgs/msg/BatteryState", {"voltage": "V", "current": "A", "percentage": ""}),
        ("geometry_msgs/msg/Twist", {"linear": "m/s", "angular": "rad/s"}),
    ],
)  # fmt: skip
def test_field_of_known_ros_message_has_its_unit(
    name: str, expected: dict[str, str], tmp_path: Path
) -> None:
    struct = message(name, tmp_path)
    found = {field.name: field.unit for field in struct.fields}
    assert expected.items() <= found.items()
    for field, unit in expected.items():
        if unit:
            assert f" {field} [{unit}];" in SIGNATURES[Struct](struct)


def test_unit_of_the_definition_itself_counts(tmp_path: Path) -> None:
    text = "float32 range  # [mm]\nfloat32 min_range\nfloat32 other  # in meters\n"
    struct = message("sensor_msgs/msg/Range", tmp_path, text)
    assert [field.unit for field in struct.fields] == ["mm", "m", "m"]
