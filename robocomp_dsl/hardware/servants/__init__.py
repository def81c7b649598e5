"""Servants of devices: one class per interface, listed in `registry`."""
