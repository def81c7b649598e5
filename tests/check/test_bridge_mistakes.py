"""What a new user of BDSL writes wrong: each message says what to write."""

from __future__ import annotations

from pathlib import Path

import pytest

from robocomp_dsl.check.passes import check_bdsl
from robocomp_dsl.check.workspace.workspace import Workspace
from robocomp_dsl.diagnostics import Report

IMPORTS = (
    'import "sensor_msgs/msg/JointState.msg";\n'
    'import "std_msgs/msg/Float64.msg";\n'
    'import "std_srvs/srv/SetBool.srv";\n'
)
LEFT = 'input left : double[2] [deg] over yarp at "/left:o";'
STATES = 'output states : sensor_msgs::JointState over ros1 at "/states" { BODY };'
FLOAT = 'output value : std_msgs::Float64 over ros1 at "/value" { BODY };'


def states(body: str) -> str:
    return LEFT + STATES.replace("BODY", body)


def value(body: str) -> str:
    return LEFT + FLOAT.replace("BODY", body)


MISTAKES = {
    "type of ROS with a slash": (
        states("position = left to [rad];") + 'input a : std_msgs/Float64 over ros1 at "/a";',
        "write `std_msgs::Float64`",
    ),
    "type of ROS with msg": (
        states("position = left to [rad];") + 'input a : std_msgs/msg/Float64 over ros1 at "/a";',
        "write `std_msgs::Float64`",
    ),
    "unit without brackets": (
        'input left : double[2] deg over yarp at "/left:o";',
        "write `[deg]`",
    ),
    "unit before the length": ('input left : double [deg][2] over yarp at "/l";', "`[2] [deg]`"),
    "address without at": ('input left : double[2] [deg] over yarp "/left:o";', "add `at`"),
    "address without quotes": ("input left : double over yarp at /left:o;", "add the quotes"),
    "single quotes": ("input left : double over yarp at '/left:o';", "use double quotes"),
    "equals instead of colon": ('input left = double over yarp at "/left:o";', "write `:`"),
    "rate without Hz": (states("rate 20; position = left to [rad];"), "add `Hz`"),
    "rate with equals": ("rate = 20 Hz;" + states("position = left to [rad];"), "delete `=`"),
    "colon in an assignment": (states("position: left to [rad];"), "write `=`"),
    "list in brackets": (states('name = ["a", "b"];'), 'write `{ "a", "b" }`'),
    "misspelt field": (states("positions = left to [rad];"), "change to `position`"),
    "misspelt input": (states("position = lefft to [rad];"), "change to `left`"),
    "texts joined": (states('header.frame_id = "a" + "b";'), "texts cannot be joined"),
    "unknown function": (states("position = mirror(left);"), "known here: `number`"),
    "list in a scalar": (value("data = left;"), "select an item: `left[0]`"),
    "item behind the end": (value("data = left[2] to [rad];"), "the last item is `left[1]`"),
    "time without a unit": (value("data = now;"), "write `now to [s]`"),
    "no content": (LEFT + FLOAT.replace("{ BODY }", ""), "assign its fields in braces"),
    "middleware ros": (
        states("position = left to [rad];").replace("over yarp", "over ros"),
        "`ros1`",
    ),
    "numpy's name of a type": ('input left : float64[2] over yarp at "/l";', "change to `double`"),
    "unit as a word": (
        states("position = left to [rad];").replace("[deg]", "[degrees]"),
        "change to `[deg]`",
    ),
    "service as an output": (
        'output e : std_srvs::SetBool over ros1 at "/e" { data = true; };',
        "write `service` or `call`",
    ),
    "topic as a service": (
        'service e : std_msgs::Float64 over ros1 at "/e" { data = 1; };',
        "its type is a ROS service",
    ),
    "hash comment": ("# angles\n" + states("position = left to [rad];"), "write `//`"),
    "synchronised without a tolerance": (
        LEFT + "hub h = left { policy synchronised; };",
        "within 20 ms",
    ),
}


def helps(tmp_path: Path, text: str) -> list[str]:
    """What the findings in a bridge advise, in the order of the file."""
    file = tmp_path / "rover.bdsl"
    file.write_text(text)
    report = Report()
    check_bdsl(file, Workspace(()), report)
    return [found.help or (found.fix.title if found.fix else "") for found in report.sorted()]


@pytest.mark.parametrize("name", MISTAKES)
def test_check_bdsl_says_what_to_write(tmp_path: Path, name: str) -> None:
    text, expected = MISTAKES[name]
    found = helps(tmp_path, f"{IMPORTS}Bridge rover\n{{\n{text}\n}};\n")
    assert any(expected in each for each in found), found


def test_check_bdsl_names_the_import(tmp_path: Path) -> None:
    text = f"Bridge rover\n{{\n{states('position = left to [rad];')}\n}};\n"
    (found,) = helps(tmp_path, text)
    assert found == 'add `import "sensor_msgs/msg/JointState.msg";`'
