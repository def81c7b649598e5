"""Converts a scene to a MuJoCo model."""
