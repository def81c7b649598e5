"""Displays models: offscreen pictures, and a 3D view in the browser."""
