"""The page of a bridge: tables of its parts, its messages with conversions, and its drawing."""

from __future__ import annotations

from pathlib import Path

from robocomp_dsl.check.workspace.workspace import Workspace
from robocomp_dsl.cli.rcgen.doc_subject import read_subject
from robocomp_dsl.diagnostics import Report
from robocomp_dsl.generate.doc.documentation import documentation

BRIDGE = """
import "sensor_msgs/msg/JointState.msg";
import "std_srvs/srv/SetBool.srv";

/** Wheels of the rover. */
Bridge rover
{
    /** The left wheel. */
    input left : double[] [deg] over yarp at "/left:o" { best_effort; };
    input right : double over yarp at "/right:o";
    function mirror(double[] values [rad]) -> double[] [rad];
    hub wheels = left, right { policy synchronised within 20 ms; max_age 500 ms; };
    output states : sensor_msgs::JointState over ros1 at "/states"
    {
        rate 50 Hz;
        header.frame_id = "rover";
        position = mirror(left) to [rad];
        velocity = wheels;
    };
    service enable : std_srvs::SetBool over ros1 at "/enable"
    {
        call other : std_srvs::SetBool over ros1 at "/other" { data = request.data; };
        success = other.success;
    };
};
"""

HANDS = """
import "my_msgs/action/Grasp.action";

Bridge hands
{
    /** Closes the hand. */
    action grasp : my_msgs::Grasp over ros1 at "/grasp"
    {
        command close : (double width) over yarp at "/hand:i" { width = goal.width; };
        state hand : (double width [m], bool moving) over yarp at "/hand:o";
        feedback.width = hand.width to [m];
        succeed when hand.moving == false and hand.width < 0.02 [m];
        timeout 10 s;
    };
};
"""


def test_bridge_page_shows_parts_messages_and_drawing(tmp_path: Path) -> None:
    path = tmp_path / "rover.bdsl"
    path.write_text(BRIDGE)
    report = Report()
    subject = read_subject([path], "Rover", Workspace(()), report)
    assert not report.has_errors
    files = {file.path: file.text for file in documentation(subject)}
    page = files["bridges/rover.md"]
    lines = page.splitlines()
    for cells in (
        ("`left`", "`yarp`", "`/left:o`", "best\\_effort", "The left wheel."),
        ("`wheels`", "synchronised within 20\u00a0ms, not older than 0.5\u00a0s"),
        ("`states`", "at 50\u00a0Hz", "`/states`"),
        ("`states`", "`header.frame_id`"),
        ("`states`", "`position`", "`mirror(left) to [rad]`", "deg → rad"),
        ("`enable`", "`/enable`"),
        ("`enable, call other`", "`data`", "`request.data`"),
        ("`mirror`",),
    ):
        assert any(all(cell in line for cell in cells) for line in lines), (cells, page)
    drawing = files["bridges/rover.graph.svg"]
    for name in ("/left:o", "/right:o", "wheels", "/states", "/enable", "/other"):
        assert name in drawing
    assert 'href="bridges/rover.html"' in files["index.html"]


def test_bridge_page_shows_actions(tmp_path: Path) -> None:
    actions = tmp_path / "my_msgs" / "action"
    actions.mkdir(parents=True)
    (actions / "Grasp.action").write_text("float64 width\n---\n---\nfloat64 width\n")
    path = tmp_path / "hands.bdsl"
    path.write_text(HANDS)
    report = Report()
    subject = read_subject([path], "Hands", Workspace(()), report)
    assert not report.has_errors
    page = next(f.text for f in documentation(subject) if f.path == "bridges/hands.md")
    for cells in (
        ("`grasp`", "`ros1`", "`/grasp`", "10\u00a0s", "Closes the hand."),
        ("`grasp, command close`", "`width`", "`goal.width`"),
        ("`grasp, feedback`", "`width`", "`hand.width to [m]`"),
        ("`grasp`", "succeed when", "`hand.moving == false and hand.width < 0.02 [m]`"),
    ):
        assert any(all(cell in line for cell in cells) for line in page.splitlines()), (cells, page)
