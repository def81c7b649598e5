"""PDSL: parameters, their types, ranges and defaults."""
