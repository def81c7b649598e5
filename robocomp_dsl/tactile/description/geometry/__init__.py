"""Checks a tactile description against the geometry of the robot's model."""
