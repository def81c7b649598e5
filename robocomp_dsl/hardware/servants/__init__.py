"""Servants answer for devices: one class per interface, listed in `registry`."""
