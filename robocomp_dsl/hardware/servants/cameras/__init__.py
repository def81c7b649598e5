"""Servants of cameras and screens."""
