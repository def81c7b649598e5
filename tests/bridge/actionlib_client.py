"""A client of ROS 1's actionlib: sends goals to `/lift` and prints what comes back.

It runs with the system's Python, which has actionlib: `python3 actionlib_client.py`. It reads
lines: `goal N` sends a goal, `cancel` cancels it. It writes a line of JSON for each event.
"""

from __future__ import annotations

import json
import sys

import actionlib
import rospy
from actionlib.msg import TestAction, TestGoal


def show(event: str, **values: object) -> None:
    """Print an event as a line of JSON."""
    sys.stdout.write(json.dumps({"event": event, **values}) + "\n")
    sys.stdout.flush()


def send(height: int) -> None:
    """Send a goal; its events are printed with its height."""
    client.send_goal(
        TestGoal(height),
        lambda state, result: show("done", goal=height, state=state, result=result.result),
        lambda: show("active", goal=height),
        lambda feedback: show("feedback", goal=height, feedback=feedback.feedback),
    )


rospy.init_node("lift_client", disable_signals=True)
client = actionlib.SimpleActionClient("/lift", TestAction)
if client.wait_for_server(rospy.Duration(60)):
    show("connected")
for line in sys.stdin:
    words = line.split()
    if words[0] == "goal":
        send(int(words[1]))
    elif words[0] == "cancel":
        client.cancel_goal()
    else:
        client.cancel_all_goals()
