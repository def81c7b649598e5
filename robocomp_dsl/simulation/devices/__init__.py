"""Simulated devices, one module per kind."""
