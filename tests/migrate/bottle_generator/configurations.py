"""Configurations of yarp-bottle-generator, built from sections, and what is found in them."""

from __future__ import annotations

from pathlib import Path

from robocomp_dsl.check.workspace.workspace import Workspace
from robocomp_dsl.diagnostics import Diagnostic, Report
from robocomp_dsl.migrate.bottle_generator.bdsl_lines import ConvertedBridge
from robocomp_dsl.migrate.bottle_generator.convert import convert_file

TO_ROS = """\
[general]
output_name = /rover/wheel_states
to_ros = true
from_ros_topics = false
num_mux = 2
rate = 20
ros_msg_name = sensor_msgs/JointState

[mux1]
num_ports = 2
ports = /rover/left/state:o, /rover/right/state:o
function = deg_to_rad
verbose = false

[mux2]
num_ports = 1
ports = /rover/effort:o
function = none_double
verbose = false

[message]
num_fields = 5
1_type = msg
1_msg = stamp_part
2_type = list
2_msg = "left, wheel", "right_wheel"
3_type = mux
3_mux = mux1
4_type = list
4_msg =
5_type = mux
5_mux = mux2

[stamp_part]
num_fields = 3
1_type = counter
2_type = timestamp
3_type = single_value
3_msg = "rover_base"
"""

TO_YARP = """\
[general]
output_name = /gripper/rpc:i
to_ros = false
from_ros_topics = true
num_mux = 1
rate = 10

[mux1]
num_ports = 1
ports = /gripper_target
function = none
verbose = true

[message]
num_fields = 5
1_type = single_value
1_msg = "set"
2_type = timestamp
3_type = mux
3_mux = mux1
4_type = counter
5_type = msg
5_msg = limits

[limits]
num_fields = 2
1_type = single_value
1_msg = 31.5
2_type = list
2_msg = 1, 2
"""

GRIPPER = "int32 finger\nfloat64 angle\n"


def convert(
    folder: Path, text: str, types: dict[str, str] | None = None
) -> tuple[ConvertedBridge | None, list[Diagnostic]]:
    """The bridge of a configuration, and the findings, sorted."""
    package = folder / "lab_msgs" / "msg"
    package.mkdir(parents=True, exist_ok=True)
    (package / "GripperTarget.msg").write_text(GRIPPER)
    (package / "Shape.msg").write_text("geometry_msgs/Point center\nfloat32[2] size\nfloat64 w\n")
    path = folder / "rover.ini"
    path.write_text(text)
    report = Report()
    bridge = convert_file(path, Workspace([], environ={}), report, types)
    return bridge, report.sorted()


def replaced(text: str, *changes: tuple[str, str]) -> str:
    """`text` with each change made exactly once."""
    for old, new in changes:
        assert text.count(old) >= 1, old
        text = text.replace(old, new, 1)
    return text
