"""Hosts for drivers of real devices."""
