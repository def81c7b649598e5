"""Conformance rules for devices, simulated or real, listed in `rules`."""
