"""What yarp-bottle-generator accepts silently, or finds only in the C++ compiler, is an error."""

from __future__ import annotations

from pathlib import Path

import pytest

from robocomp_dsl.diagnostics import Severity
from tests.migrate.bottle_generator.configurations import TO_ROS, TO_YARP, convert, replaced

TYPES = {"/gripper_target": "lab_msgs/GripperTarget"}

REJECTED = {
    "num_ports too small": (TO_ROS, ("num_ports = 2", "num_ports = 1"), "num_ports is 1"),
    "num_ports too large": (TO_ROS, ("num_ports = 2", "num_ports = 3"), "num_ports is 3"),
    "num_ports 0": (TO_ROS, ("num_ports = 2", "num_ports = 0"), "`0` is no number"),
    "num_ports negative": (TO_ROS, ("num_ports = 2", "num_ports = -2"), "`-2` is no number"),
    "empty name": (TO_ROS, ("state:o, /rover", "state:o,, /rover"), "a name is missing"),
    "name without slash": (TO_ROS, (" /rover/right", " rover/right"), "not the name of a port"),
    "name with a blank": (TO_ROS, ("/rover/right", "/rover /right"), "has a blank"),
    "num_mux too small": (TO_ROS, ("num_mux = 2", "num_mux = 1"), "`[mux2]` is not read"),
    "num_mux too large": (TO_ROS, ("num_mux = 2", "num_mux = 3"), "`[mux3]` is missing"),
    "num_fields too small": (TO_ROS, ("num_fields = 5", "num_fields = 4"), "is not read"),
    "gap in the numbering": (TO_ROS, ("4_type = list\n4_msg =\n", ""), "`4_type` is missing"),
    "num_fields 0": (TO_ROS, ("num_fields = 5", "num_fields = 0"), "`0` is no number"),
    "unknown function": (TO_ROS, ("deg_to_rad", "degrees"), "`function` is `degrees`"),
    "unknown type of field": (TO_ROS, ("1_type = msg", "1_type = float64"), "`float64`"),
    "mux that is missing": (TO_ROS, ("3_mux = mux1", "3_mux = mux7"), "no section `[mux7]`"),
    "mux of another form": (TO_ROS, ("3_mux = mux1", "3_mux = arm"), "no section `[arm]`"),
    "unquoted word": (TO_ROS, ('"rover_base"', "rover_base"), "`rover_base` is no constant"),
    "function call": (TO_ROS, ('"rover_base"', "std::exit(1)"), "is no constant"),
    "statement": (TO_ROS, ('"rover_base"', '"a"); abort(); f("b"'), "not balanced"),
    "semicolon in a value": (TO_YARP, ("31.5", "31.5; abort()"), "is no constant"),
    "open quote": (TO_ROS, ('"rover_base"', '"rover_base'), "not balanced"),
    "trailing comma": (TO_ROS, ('"right_wheel"', '"right_wheel",'), "element is missing"),
    "doubled comma": (TO_ROS, ('", "', '",, "'), "element is missing"),
    "contains itself": (TO_YARP, ("2_msg = 1, 2", "2_msg = limits"), "contains itself"),
    "mux in nested for YARP": (TO_YARP, ("2_msg = 1, 2", "2_mux = mux1"), "has no `mux`"),
    "two timestamps": (TO_ROS, ("1_type = counter", "1_type = timestamp"), "one timestamp"),
    "ROS to ROS": (TO_ROS, ("topics = false", "topics = true"), "both of ROS"),
    "YARP to YARP": (TO_ROS, ("to_ros = true", "to_ros = false"), "both of YARP"),
    "rate 0": (TO_ROS, ("rate = 20", "rate = 0"), "`0` is no rate"),
    "rate negative": (TO_ROS, ("rate = 20", "rate = -5"), "`-5` is no rate"),
    "rate nan": (TO_ROS, ("rate = 20", "rate = nan"), "`nan` is no rate"),
    "reserved section": (TO_YARP, ("5_msg = limits", "5_msg = general"), "no nested message"),
    "scalar from a mux": (TO_ROS, ("sensor_msgs/JointState", "lab_msgs/Shape"), "has 3 fields"),
    "type without package": (TO_ROS, ("sensor_msgs/JointState", "MotorsInertial"), "cannot find"),
    "unknown type": (TO_ROS, ("sensor_msgs/JointState", "sensor_msg/JointState"), "cannot find"),
    "duplicate section": (TO_ROS, ("[mux2]", "[mux1]"), "appears twice"),
    "duplicate key": (TO_ROS, ("rate = 20", "rate = 20\nrate = 30"), "appears twice"),
    "misspelt key": (TO_ROS, ("num_fields = 3", "num_fiels = 3"), "no key `num_fiels`"),
    "section that no field names": (TO_ROS, ("[mux1]", "[extra]\na = 1\n[mux1]"), "no field"),
    "no equals sign": (TO_ROS, ("rate = 20", "rate 20"), "expected `key = value`"),
    "no flag": (TO_ROS, ("to_ros = true", "to_ros = yes"), "`to_ros` is `yes`"),
    "line before sections": (TO_ROS, ("[general]", "a = 1\n[general]"), "before the first"),
    "no message": (TO_ROS, ("[message]", "[massage]"), "`[message]` is missing"),
}


@pytest.mark.parametrize("name", REJECTED)
def test_convert_file_rejects(tmp_path: Path, name: str) -> None:
    text, change, message = REJECTED[name]
    changes = [change]
    if name in {"contains itself", "mux in nested for YARP"}:
        kind = "msg" if "itself" in name else "mux"
        changes.insert(0, ("2_type = list", f"2_type = {kind}"))
    bridge, findings = convert(tmp_path, replaced(text, *changes), TYPES)
    errors = [f for f in findings if f.severity is Severity.ERROR]
    assert bridge is None
    assert any(message in f.message for f in errors), [f.message for f in findings]
    assert all(f.span.source.path.name == "rover.ini" for f in errors)


@pytest.mark.parametrize(
    ("field", "message"),
    [
        ("3_type = mux\n3_mux = mux1", "the field `w` is one double, not the list of a mux"),
        ('3_type = list\n3_msg = "a"', "the field `w` is one double, not a list"),
        ("3_type = timestamp", "the field `w` is one double, not a timestamp"),
        ("3_type = msg\n3_msg = part", "the field `w` is one double, not a nested message"),
    ],
)
def test_convert_file_rejects_field_of_other_type(tmp_path: Path, field: str, message: str) -> None:
    part = "[part]\nnum_fields = 1\n1_type = counter\n" if "part" in field else ""
    text = (
        "[general]\noutput_name = /shape\nto_ros = 1\nfrom_ros_topics = 0\nnum_mux = 1\nrate = 9\n"
        "ros_msg_name = lab_msgs/Shape\n[mux1]\nnum_ports = 1\nports = /p\nfunction = none\n"
        f"[message]\nnum_fields = 3\n1_type = mux\n1_mux = mux1\n2_type = list\n2_msg = 1, 2\n"
        f"{field}\n{part}"
    )
    bridge, findings = convert(tmp_path, text)
    assert bridge is None
    assert [f.message for f in findings] == [message]


def test_convert_file_unknown_type_of_input(tmp_path: Path) -> None:
    bridge, findings = convert(tmp_path, TO_YARP)
    assert bridge is None
    assert [f.message for f in findings] == ["the type of the topic `/gripper_target` is not known"]
    assert findings[0].span.text == "/gripper_target"


@pytest.mark.parametrize("text", ["", "[", "[]", "[general]", "=", "[message]\nnum_fields = 9"])
def test_convert_file_incomplete(tmp_path: Path, text: str) -> None:
    bridge, findings = convert(tmp_path, text)
    assert bridge is None
    assert findings


@pytest.mark.parametrize("text", [TO_ROS, TO_YARP])
def test_convert_file_never_raises(tmp_path: Path, text: str) -> None:
    lines = text.splitlines()
    for index in range(len(lines)):
        for line in ("", lines[index] + lines[index], lines[index][:-3], "x"):
            damaged = "\n".join([*lines[:index], line, *lines[index + 1 :]])
            bridge, findings = convert(tmp_path, damaged, TYPES)
            assert bridge is not None or any(f.severity is Severity.ERROR for f in findings)
