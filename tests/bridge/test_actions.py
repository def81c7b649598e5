"""Generated actions: goals, cancel requests and states in, commands and results out."""

from __future__ import annotations

import sys
from collections.abc import Callable
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from rosbags.typesys import Stores, get_types_from_msg, get_typestore

from robocomp_dsl.runtime.bridge.context import MessageContext
from robocomp_dsl.runtime.bridge.running import RunningBridge
from robocomp_dsl.runtime.component.statistics import Statistics
from robocomp_dsl.runtime.errors import NoServer
from robocomp_dsl.runtime.middleware.ros1.message_types import message_type
from tests.bridge.bridge_run import generate, load_worker
from tests.bridge.lift_bridge import BRIDGE, generate_lift
from tests.bridge.test_running_bridge import Host
from tests.cli.rcgen_run import Rcgen

ACTIVE, PREEMPTED, SUCCEEDED, ABORTED = 1, 2, 3, 4


class LiftBridge:
    """The generated bridge without transports; `sent` has the messages of each port."""

    def __init__(self, folder: Path) -> None:
        load_worker(folder)
        self.types = sys.modules["lifts_generated.interfaces"]
        spec = sys.modules["lifts_generated.bridge_worker"].BRIDGE
        self.host = Host()
        self.sent: dict[str, list[Any]] = {}
        action = spec.actions[0]
        topics = (action.status, action.feedback, action.result, *action.commands)
        publish = {topic.port: self._publisher(topic.port) for topic in topics}
        self.bridge = RunningBridge(spec, self.host, publish, Statistics(), lambda: 0)
        self.failing = ""

    def _publisher(self, port: str) -> Callable[..., None]:
        received = self.sent.setdefault(port, [])

        def publish(message: Any) -> None:
            if port == self.failing:
                raise NoServer("the lift is off")
            received.append(message)

        return publish

    def goal(self, height: int, goal_id: str = "") -> None:
        message = self.types.TestActionGoal()
        message.goal.goal = height
        message.goal_id.id = goal_id
        self.bridge.inputs["lift_goal"].receive(message)

    def cancel(self, goal_id: str = "") -> None:
        message = self.types.GoalID()
        message.id = goal_id
        self.bridge.inputs["lift_cancel"].receive(message)

    def state(self, height: int, *, moving: bool = False) -> None:
        lift = self.types.Lift(height=height, moving=moving)
        self.bridge.inputs["lift"].receive(lift)

    def tick(self, seconds: float) -> None:
        self.host.clock.time += seconds
        self.bridge.send_due()

    def commands(self) -> list[tuple[str, int]]:
        return [(m.verb, m.height) for m in (*self.sent["move"], *self.sent["stop"])]

    def results(self) -> list[tuple[str, int, str, int]]:
        return [
            (m.status.goal_id.id, m.status.status, m.status.text, m.result.result)
            for m in self.sent["lift_result"]
        ]

    def statuses(self) -> list[tuple[str, int]]:
        newest = self.sent["lift_status"][-1]
        return [(entry.goal_id.id, entry.status) for entry in newest.status_list]


@pytest.fixture
def lift(rcgen: Rcgen, tmp_path: Path) -> LiftBridge:
    return LiftBridge(generate_lift(rcgen, tmp_path / "lift"))


def test_bridged_action_sends_command_feedback_and_result(lift: LiftBridge) -> None:
    lift.state(5)  # before the goal: it does not count
    lift.goal(5, "a")
    assert lift.commands() == [("move", 5)]
    assert lift.statuses() == [("a", ACTIVE)]
    lift.state(3, moving=True)
    lift.state(5, moving=True)
    assert not lift.results()
    lift.state(5)
    assert [m.feedback.feedback for m in lift.sent["lift_feedback"]] == [3, 5, 5]
    assert lift.results() == [("a", SUCCEEDED, "", 5)]
    assert lift.statuses() == [("a", SUCCEEDED)]
    lift.state(5)
    assert len(lift.results()) == 1
    assert lift.bridge.summary()[-1] == "action `lift`: 1 goals"


def test_bridged_action_ends_preempted_cancelled_and_aborted_goals(
    lift: LiftBridge, caplog: pytest.LogCaptureFixture
) -> None:
    lift.goal(5, "a")
    lift.state(2, moving=True)
    lift.goal(6, "b")
    assert lift.results() == [("a", PREEMPTED, "preempted by a new goal", 2)]
    assert lift.commands() == [("move", 5), ("move", 6)]
    lift.cancel("b")
    assert lift.results()[-1] == ("b", PREEMPTED, "cancelled", 0)
    assert lift.commands()[-1] == ("stop", 0)
    lift.goal(7, "c")
    lift.state(101)
    assert lift.results()[-1] == ("c", ABORTED, "a condition to abort is true", 101)
    assert "action `lift`: not sent: a condition to abort is true (x.bdsl:6)" in caplog.text


def test_bridged_action_aborts_goal_after_timeout_and_stops(lift: LiftBridge) -> None:
    lift.goal(5, "a")
    lift.tick(9.9)
    assert lift.statuses() == [("a", ACTIVE)]
    lift.tick(0.2)
    assert lift.results() == [("a", ABORTED, "not reached within 10 s", 0)]
    assert lift.commands() == [("move", 5), ("stop", 0)]
    count = len(lift.sent["lift_status"])
    lift.tick(0.2)
    assert len(lift.sent["lift_status"]) == count + 1


def test_bridged_action_aborts_goal_whose_command_fails(
    lift: LiftBridge, caplog: pytest.LogCaptureFixture
) -> None:
    lift.failing = "move"
    lift.goal(5)
    ((goal_id, state, text, result),) = lift.results()
    assert goal_id.startswith("lift-1-")
    assert (state, text, result) == (ABORTED, "the lift is off (x.bdsl:8)", 0)
    assert "the lift is off (x.bdsl:8)" in caplog.text
    lift.failing = "stop"
    lift.goal(6, "b")
    lift.cancel()
    assert lift.results()[-1][2].startswith("cancelled; the command to stop failed: the lift is")
    lift.failing = "lift_result"
    lift.goal(7, "c")
    lift.state(7)
    assert lift.statuses()[-1] == ("c", SUCCEEDED)


DIVISION = BRIDGE.replace("lift.height > 100", "10 / lift.height > 100").replace(
    "lift.height == goal.goal;", "lift.height == goal.goal;\nsucceed when 1 / lift.height > 3;"
)


def test_bridged_action_aborts_goal_whose_condition_fails(rcgen: Rcgen, tmp_path: Path) -> None:
    lift = LiftBridge(generate_lift(rcgen, tmp_path / "lift", DIVISION))
    lift.goal(5, "a")
    lift.state(0)
    ((_, state, text, _),) = lift.results()
    assert state == ABORTED
    assert "abort when: ZeroDivisionError" in text
    line = next(n for n, row in enumerate(DIVISION.splitlines(), 1) if "10 /" in row)
    assert f"x.bdsl:{line}" in text
    assert lift.commands() == [("move", 5), ("stop", 0)]


def test_message_type_of_action_is_that_of_genaction(lift: LiftBridge) -> None:
    # As `rosmsg md5 actionlib/TestActionGoal` and the like show in ROS Noetic.
    names = ("TestActionGoal", "TestActionResult", "TestActionFeedback")
    found = {name: message_type(getattr(lift.types, name)) for name in names}
    assert {name: (t.name, t.md5) for name, t in found.items()} == {
        "TestActionGoal": ("actionlib/TestActionGoal", "348369c5b403676156094e8c159720bf"),
        "TestActionResult": ("actionlib/TestActionResult", "3d669e3a63aa986c667ea7b0f46ce85e"),
        "TestActionFeedback": ("actionlib/TestActionFeedback", "6d3d0bf7fb3dda24779c010a9f3eb7cb"),
    }


GRASP = """# Closes the hand.
uint8 SLOW=1
float64 width
my_msgs/Finger[] fingers
 --- # the result
bool reached
---
float64 width
time at
"""
HAND = """
import "my_msgs/action/Grasp.action";

Bridge hands
{
    action grasp : my_msgs::Grasp over ros1 at "/grasp"
    {
        command close : (double width) over yarp at "/hand:i" { width = goal.width; };
        state hand : (double width [mm], double[] angles [deg]) over yarp at "/hand:o";
        state arm : (string name) over yarp at "/arm:o";
        feedback.at = now;
        succeed when hand.width < 0.02 [m] and arm.name != "";
        succeed when hand.angles[0] - hand.angles[1] >= 90;
    };
};
"""


def test_message_type_of_own_action_with_constants(rcgen: Rcgen, tmp_path: Path) -> None:
    package = tmp_path / "my_msgs"
    for folder, name, text in (("action", "Grasp.action", GRASP), ("msg", "Finger.msg", "int8 n")):
        (package / folder).mkdir(parents=True)
        (package / folder / name).write_text(text)
    load_worker(generate(rcgen, tmp_path, HAND))
    types = sys.modules["hands_generated.interfaces"]
    goal, result, feedback = GRASP.replace(" # the result", "").split("---")
    store = get_typestore(Stores.ROS1_NOETIC)
    texts = {"Finger": "int8 n"}
    for part, text in (("Goal", goal), ("Result", result), ("Feedback", feedback)):
        kind = "GoalID goal_id" if part == "Goal" else "GoalStatus status"
        texts[f"Grasp{part}"] = text
        texts[f"GraspAction{part}"] = (
            f"Header header\nactionlib_msgs/{kind}\nGrasp{part} {part.lower()}"
        )
    for name, text in texts.items():
        store.register(get_types_from_msg(text, f"my_msgs/msg/{name}"))
    for name in texts:
        expected = store.generate_msgdef(f"my_msgs/msg/{name}", ros_version=1)[1]
        assert (name, message_type(getattr(types, name)).md5) == (name, expected)


def test_action_functions_convert_units_and_compare(rcgen: Rcgen, tmp_path: Path) -> None:
    package = tmp_path / "my_msgs" / "action"
    package.mkdir(parents=True)
    (package / "Grasp.action").write_text(GRASP.replace("my_msgs/Finger[] fingers\n", ""))
    load_worker(generate(rcgen, tmp_path, HAND))
    mapping = sys.modules["hands_generated.mapping"]
    types = sys.modules["hands_generated.interfaces"]
    at = MessageContext(lambda _: 0)
    hand = types.Hand(width=19.0, angles=np.array([180.0, 91.0]))
    assert mapping.action_grasp_succeeds(at, None, None, hand, types.Arm(name="a"))
    assert not mapping.action_grasp_succeeds(at, None, None, hand, types.Arm(name=""))
    hand.angles = np.array([181.0, 91.0])
    assert mapping.action_grasp_succeeds(at, None, None, hand, types.Arm(name=""))
    assert at.field == "succeed when (2)"
