"""Interfaces for other toolchains: Slice, ROS 2 packages, JSON Schema."""
