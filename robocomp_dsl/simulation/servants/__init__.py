"""Servants that need the simulated world itself."""
