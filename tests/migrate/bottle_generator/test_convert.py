"""Configurations of yarp-bottle-generator become bridges in BDSL."""

from __future__ import annotations

from pathlib import Path

import pytest

from tests.migrate.bottle_generator.configurations import TO_ROS, TO_YARP, convert, replaced

TYPES = {"/gripper_target": "lab_msgs/GripperTarget"}


def test_convert_file_to_ros(tmp_path: Path) -> None:
    bridge, findings = convert(tmp_path, TO_ROS)
    assert not findings
    assert bridge is not None
    assert bridge.name == "rover"
    assert bridge.text == (
        'import "sensor_msgs/msg/JointState.msg";\n'
        "\n"
        "/** From YARP to ROS: /rover/wheel_states. */\n"
        "Bridge rover\n"
        "{\n"
        '    input rover_left_state : double[] [deg] over yarp at "/rover/left/state:o";\n'
        '    input rover_right_state : double[] [deg] over yarp at "/rover/right/state:o";\n'
        '    input rover_effort : double[] over yarp at "/rover/effort:o";\n'
        "\n"
        "    hub mux1 = rover_left_state, rover_right_state { policy all; };\n"
        "    hub mux2 = rover_effort { policy all; };\n"
        "\n"
        '    output rover_wheel_states : sensor_msgs::JointState over ros1 at "/rover/wheel_states"'
        "\n"
        "    {\n"
        "        rate 20 Hz;\n"
        "        header.stamp = now;\n"
        '        header.frame_id = "rover_base";\n'
        '        name = { "left, wheel", "right_wheel" };\n'
        "        position = mux1 to [rad];\n"
        "        velocity = {};\n"
        "        effort = mux2;\n"
        "    };\n"
        "};\n"
    )


def test_convert_file_to_yarp(tmp_path: Path) -> None:
    bridge, findings = convert(tmp_path, TO_YARP, TYPES)
    assert not findings
    assert bridge is not None
    assert bridge.text.partition("{\n")[2] == (
        '    input gripper_target : lab_msgs::GripperTarget over ros1 at "/gripper_target";\n'
        "\n"
        "    hub mux1 = gripper_target { policy all; };\n"
        "\n"
        '    output gripper_rpc over yarp at "/gripper/rpc:i"\n'
        "    {\n"
        "        rate 10 Hz;\n"
        '        item "set";\n'
        "        item { counter, now };\n"
        "        item mux1[0];\n"
        "        item mux1[1];\n"
        "        item counter;\n"
        "        item { 31.5, { 1, 2 } };\n"
        "    };\n"
        "};\n"
    )


@pytest.mark.parametrize(
    ("function", "items"),
    [
        ("none_double", ["number(mux1[0])", "mux1[1]"]),
        (
            "deg_to_rad",
            ["number(mux1[0]) * 0.017453292519943295", "mux1[1] * 0.017453292519943295"],
        ),
    ],
)
def test_convert_file_converter_to_yarp(tmp_path: Path, function: str, items: list[str]) -> None:
    text = replaced(TO_YARP, ("function = none", f"function = {function}"))
    bridge, findings = convert(tmp_path, text, TYPES)
    assert bridge is not None, findings
    assert [f"        item {item};" for item in items] == [
        line for line in bridge.text.splitlines() if "mux1[" in line
    ]


@pytest.mark.parametrize(
    ("ports", "type_", "hub"),
    [
        ("/gaze", "double[3]", "{ policy all; }"),
        ("/x, /y, /z", "double[1]", "{ policy all; }"),
        ("/xy, /z", "double[]", "{ policy all; length 3; }"),
    ],
)
def test_convert_file_mux_to_nested_message(
    tmp_path: Path, ports: str, type_: str, hub: str
) -> None:
    text = (
        "[general]\noutput_name = /gaze\nto_ros = true\nfrom_ros_topics = false\nnum_mux = 1\n"
        "rate = 60\nros_msg_name = geometry_msgs/Point\n"
        f"[mux1]\nnum_ports = {ports.count(',') + 1}\nports = {ports}\nfunction = none\n"
        "[message]\nnum_fields = 3\n1_type = mux\n1_mux = mux1\n"
    )
    text = text.replace("geometry_msgs/Point", "geometry_msgs/PointStamped")
    text = text.replace("num_fields = 3\n1_type = mux\n1_mux = mux1\n", "num_fields = 2\n")
    text += (
        "1_type = msg\n1_msg = header\n2_type = mux\n2_mux = mux1\n"
        '[header]\nnum_fields = 2\n1_type = timestamp\n2_type = single_value\n2_msg = "eye"\n'
    )
    bridge, findings = convert(tmp_path, text)
    assert bridge is not None, findings
    assert f" : {type_} over yarp" in bridge.text
    assert hub in bridge.text
    assert "point = mux1;" in bridge.text


def test_convert_file_same_port_in_two_muxes(tmp_path: Path) -> None:
    text = replaced(TO_ROS, ("ports = /rover/effort:o", "ports = /rover/left/state:o"))
    bridge, findings = convert(tmp_path, text)
    assert bridge is not None, findings
    assert bridge.text.count('at "/rover/left/state:o"') == 1
    assert "position = mux1 * 0.017453292519943295;" in bridge.text


@pytest.mark.parametrize(
    ("change", "assumed"),
    [
        (("to_ros = true\n", ""), "`to_ros = true`"),
        (("from_ros_topics = false\n", ""), "`from_ros_topics = false`"),
        (("rate = 20\n", ""), "every set of inputs is sent"),
        (("ros_msg_name = sensor_msgs/JointState\n", ""), "only `sensor_msgs/JointState` fits"),
        (("right/state:o", "right/state:o,"), "comma behind the last name"),
    ],
)
def test_convert_file_warns_and_converts(
    tmp_path: Path, change: tuple[str, str], assumed: str
) -> None:
    bridge, findings = convert(tmp_path, replaced(TO_ROS, change))
    assert bridge is not None
    assert [f.severity.value for f in findings] == ["warning"]
    assert assumed in findings[0].message


def test_convert_file_type_without_package(tmp_path: Path) -> None:
    text = replaced(TO_ROS, ("sensor_msgs/JointState", "JointState"))
    bridge, findings = convert(tmp_path, text)
    assert bridge is not None
    assert [f.message for f in findings] == [
        "`JointState` has no package; it is `sensor_msgs/JointState`"
    ]


def test_convert_file_type_of_output_stated_by_user(tmp_path: Path) -> None:
    text = replaced(TO_ROS, ("ros_msg_name = sensor_msgs/JointState", "ros_msg_name = No/Such"))
    types = {"/rover/wheel_states": "sensor_msgs/JointState"}
    bridge, findings = convert(tmp_path, text, types)
    assert bridge is not None, findings


def test_converted_bridge_original_position(tmp_path: Path) -> None:
    bridge, _ = convert(tmp_path, TO_ROS)
    assert bridge is not None
    line = bridge.text.splitlines().index("        effort = mux2;")
    origin = bridge.origins[line]
    assert origin is not None
    assert origin.start_position == (TO_ROS.splitlines().index("5_mux = mux2") + 1, 9)
