"""Checks of BDSL: names, types, lengths and units of a bridge."""
