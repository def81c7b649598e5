"""Bridges between real programs: YARP 3.5 and ROS Noetic."""
