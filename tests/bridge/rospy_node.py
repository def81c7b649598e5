"""A ROS 1 node of rospy: publishes speeds, and prints the joint states that it receives.

It runs with the system's Python, which has rospy: `python3 rospy_node.py`.
"""

from __future__ import annotations

import json
import sys

import rospy
from sensor_msgs.msg import JointState
from std_msgs.msg import Float64


def show(message: JointState) -> None:
    """Print a message as a line of JSON."""
    shown = {"name": message.name, "position": message.position, "seq": message.header.seq}
    sys.stdout.write(json.dumps(shown) + "\n")
    sys.stdout.flush()


rospy.init_node("rover_node", disable_signals=True)
rospy.Subscriber("/rover/joint_states", JointState, show)
publisher = rospy.Publisher("/rover/speed", Float64, queue_size=1)
while not rospy.is_shutdown():
    publisher.publish(Float64(0.5))
    rospy.sleep(0.05)
