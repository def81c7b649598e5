"""Joint control as on the iCub: modes, trajectories, limits, PIDs, impedance, calibration, parking.

Plain numpy, no physics and no clock: `ControlBoard.step` takes what the sensors say and gives the
torques for the motors. SI units: rad, rad/s, N m, A; duty cycles in percent. One class a concern.
"""
