"""Servants of control boards and hands."""
