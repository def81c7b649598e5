"""The kinds of ROS definitions, by the suffix of their files."""

from __future__ import annotations

ROS_PARTS = {
    ".msg": ("",),
    ".srv": ("_Request", "_Response"),
    ".action": ("_Goal", "_Result", "_Feedback"),
}
"""Suffix to what the structs of a definition have behind the name of the file."""
ROS_SUFFIXES = tuple(ROS_PARTS)
