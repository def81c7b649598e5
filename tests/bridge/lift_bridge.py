"""A bridge with an action: a lift that moves to a height. Its type is one of actionlib itself."""

from __future__ import annotations

from pathlib import Path

from tests.bridge.bridge_run import generate
from tests.cli.rcgen_run import Rcgen

ACTION = "int32 goal\n---\nint32 result\n---\nint32 feedback\n"
BRIDGE = """
import "actionlib/action/Test.action";

Bridge lifts
{
    action lift : actionlib::Test over ros1 at "/lift"
    {
        command move : (string verb, int height) over yarp at "/lift/command:i"
        {
            verb = "move";
            height = goal.goal;
        };
        command stop : (string verb, int height) over yarp at "/lift/command:i" on cancel
        {
            verb = "stop";
        };
        state lift : (int height, bool moving) over yarp at "/lift/state:o";
        feedback.feedback = lift.height;
        result.result = lift.height;
        succeed when lift.moving == false and lift.height == goal.goal;
        abort when lift.height > 100;
        timeout 10 s;
    };
};
"""


def generate_lift(rcgen: Rcgen, folder: Path, text: str = BRIDGE) -> Path:
    """Generate the bridge in `folder`, with the definition of its action beside it."""
    actions = folder / "actionlib" / "action"
    actions.mkdir(parents=True)
    (actions / "Test.action").write_text(ACTION)
    return generate(rcgen, folder, text)
