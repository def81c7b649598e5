"""Model files in URDF and MJCF, checked by themselves."""
