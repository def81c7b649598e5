"""Model files (URDF, MJCF) as simulations and as scenes."""
