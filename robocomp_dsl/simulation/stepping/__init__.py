"""Drivers that advance a simulated world: real time, or the clock of its deployment."""
