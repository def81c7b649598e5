"""Joint control as on the iCub: modes, trajectories, limits, PIDs, impedance, calibration, parking.

Plain numpy without physics or clock: `ControlBoard.step` maps sensor values to motor torques. SI
units: rad, rad/s, N m, A; duty cycles in percent. One class per concern.
"""
