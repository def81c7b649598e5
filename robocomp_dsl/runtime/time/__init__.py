"""Clocks: wall time, simulated time, its source, and lock-step."""
