"""Devices of any robot, simulated or real: Protocols, servants, control boards, kinematics.

`devices/` has one file per kind of device, with its data and the Protocol that every driver
implements. The simulated drivers are in `robocomp_dsl.simulation`. Units are mm, rad, mm/s and
rad/s; x is to the right, z ahead, y up, and a heading `alpha` grows from z towards x (clockwise
seen from above).
"""
