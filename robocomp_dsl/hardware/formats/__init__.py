"""Readers of URDF, COLLADA, mesh and picture files."""
