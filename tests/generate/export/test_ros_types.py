"""Exports of interfaces with ROS types: Slice, ROS 2 and JSON Schema."""

from __future__ import annotations

import json
import shutil
import subprocess
from pathlib import Path

import pytest

from robocomp_dsl.generate.export import export
from tests.generate.export import exported
from tests.generate.golden_cases import GOLDEN

DEMO = GOLDEN / "ros" / "Demo.idsl"


def demo_files(to: str) -> dict[str, str]:
    """The exported files of the demo by path."""
    return {file.path: file.text for file in export(exported.modules(DEMO), to).files}


def test_ros_types_keep_their_packages_in_ros2() -> None:
    files = demo_files("ros2")
    assert {path for path in files if path.endswith((".msg", ".srv"))} == {
        "demo/msg/Named.msg",
        "demo/msg/Points.msg",
        "demo/srv/MoverMove.srv",
    }
    assert "demo_msgs/Cloud cloud" in files["demo/msg/Named.msg"]
    assert "demo_msgs/Point[] data" in files["demo/msg/Points.msg"]
    assert "demo_msgs" in files["demo/package.xml"]
    readme = files["demo/README.md"]
    assert "std_srvs/srv/SetBool" in readme
    assert "demo_msgs/msg/Cloud" in readme


def test_arrays_of_ros_have_names_in_slice(tmp_path: Path) -> None:
    files = demo_files("slice")
    assert set(files) == {
        "Demo.ice",
        "demo_msgs_Cloud.ice",
        "demo_msgs_Move.ice",
        "demo_msgs_Point.ice",
        "std_srvs_SetBool.ice",
    }
    cloud = files["demo_msgs_Cloud.ice"]
    assert "sequence<double> Cloud_covariance;" in cloud
    assert "Cloud_covariance covariance;" in cloud
    assert "long stamp;" in cloud
    assert '#include "demo_msgs_Point.ice"' in cloud.replace("<", '"').replace(">", '"')
    compiler = shutil.which("slice2py")
    if compiler is None:
        pytest.skip("slice2py is not installed")
    exported.put(export(exported.modules(DEMO), "slice").files, tmp_path)
    for name in files:
        command = [compiler, f"-I{tmp_path}", "--output-dir", str(tmp_path), name]
        done = subprocess.run(command, cwd=tmp_path, capture_output=True, text=True, check=False)
        assert done.returncode == 0, done.stderr


def test_limits_of_ros_types_are_in_json_schema() -> None:
    schema = json.loads(demo_files("json-schema")["Demo.schema.json"])
    members = schema["$defs"]["demo_msgs.Cloud"]["properties"]
    assert members["height"] == {"type": "integer", "minimum": 0, "maximum": 2**32 - 1}
    assert members["frame"] == {"type": "string", "maxLength": 16, "default": "base"}
    assert members["covariance"]["minItems"] == members["covariance"]["maxItems"] == 9
    assert members["marks"]["maxItems"] == 3
    assert members["marks"]["items"] == {"$ref": "#/$defs/demo_msgs.Point"}
    assert members["few"]["default"] == [1, 2]
