"""The examples of `rcgen explain` for bridges: the wrong one gives the code, the right one not."""

from __future__ import annotations

import re
from pathlib import Path

import pytest

from robocomp_dsl.check.codes import bridge, bridge_values
from robocomp_dsl.check.passes import check_bdsl
from robocomp_dsl.check.workspace.workspace import Workspace
from robocomp_dsl.diagnostics import Code, Report

IMPORTS = """\
import "sensor_msgs/msg/JointState.msg";
import "sensor_msgs/msg/LaserScan.msg";
import "sensor_msgs/msg/Imu.msg";
import "sensor_msgs/msg/Image.msg";
import "Laser.idsl";
import "LaserPub.idsl";
"""
DECLARED = {
    "left": 'input left : double[] over yarp at "/left:x";',
    "right": 'input right : double[] over yarp at "/right:x";',
    "wheels": 'input wheels : double[] over yarp at "/wheels:x";',
    "angle": 'input angle : double [deg] over yarp at "/angle:x";',
    "distance": 'input distance : double [m] over yarp at "/distance:x";',
    "x": 'input x : int over yarp at "/x:x";',
    "y": 'input y : int over yarp at "/y:x";',
    "imu": 'input imu : sensor_msgs::Imu over ros2 at "/imu";',
    "camera": 'input camera : sensor_msgs::Image over ros2 at "/camera";',
    "mirror": "function mirror(double[] values) -> double[];",
}
OUTPUTS = {
    "RC763": "sensor_msgs::JointState",
    "RC764": "sensor_msgs::JointState",
    "RC765": "sensor_msgs::Imu",
    "RC766": "(double position [rad], double range [mm])",
    "RC767": "(double data, int more)",
    "RC771": "sensor_msgs::Image",
    "RC772": "sensor_msgs::JointState",
    "RC773": "(double x, string frame_id)",
    "RC774": "(double x, int more)",
}
"""The type of the output that has the fields of an example."""
EXAMPLE = re.compile(r"^(Wrong|Right)[^\n]*:\n\n((?:    [^\n]*\n|\n)+)", re.MULTILINE)
STATEMENT = re.compile(r"(input|output|hub|rate|function|service|middleware)\b")
CODES = [
    code
    for module in (bridge, bridge_values)
    for code in vars(module).values()
    if isinstance(code, Code)
]


def _text(code: Code, kind: str, example: str) -> str:
    """A bridge with the statements of an example, and what they use."""
    body = example
    if not STATEMENT.match(example.strip()):
        type_ = OUTPUTS.get(code.id, f"({'int' if kind == 'Wrong' else 'double'} item [s], int b)")
        body = f'    output example : {type_} over yarp at "/example:i" {{ rate 1 Hz; {example} }};'
    names = set(re.findall(r"\b(?:input|hub|function)\s+(\w+)", body))
    used = set(re.findall(r"\w+", body))
    declared = "\n".join(text for n, text in DECLARED.items() if n in used and n not in names)
    return f"{IMPORTS}\nBridge example_bridge\n{{\n{declared}\n{body}\n}};\n"


@pytest.mark.parametrize("code", CODES, ids=lambda code: code.id)
def test_explanation_examples_of_bridges(code: Code) -> None:
    examples = EXAMPLE.findall(code.explanation)
    assert [kind for kind, _ in examples] == ["Wrong", "Right"]
    workspace = Workspace(environ={})
    for kind, example in examples:
        path = Path(f"{kind}.bdsl").absolute()
        workspace.sources.set_overlay(path, _text(code, kind, example))
        report = Report()
        check_bdsl(path, workspace, report)
        found = {diagnostic.code.id for diagnostic in report}
        assert (code.id in found) is (kind == "Wrong"), (kind, found)
        if kind == "Right":
            assert not found - {"RC752", "RC756", "RC767"}, [d.message for d in report]
