"""Devices: what a component talks to below its interface, simulated or real.

One file per kind of device holds its data and the Protocol that every driver implements;
`mujoco/` holds the simulated drivers. Units are mm, rad, mm/s and rad/s; x is to the right, z
ahead, y up, and a heading `alpha` grows from z towards x (clockwise seen from above).
"""
