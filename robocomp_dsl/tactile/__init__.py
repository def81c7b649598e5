"""Touch and the generic arm, independent of robot and middleware.

In: a description of a robot's arms and skin (data), taxel forces, joint readings. Out: generic
angles, taxel positions, touches, reflex motions. Pure numpy; uses no clock and no port.
"""
