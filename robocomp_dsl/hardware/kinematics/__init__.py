"""Rotations, transform trees, Jacobians and inverse kinematics in numpy."""
