"""Bridges of BDSL: from a checked bridge to the files of a component."""
