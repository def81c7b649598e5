"""Touch and the generic arm, apart from any robot and any middleware.

In: a description of a robot's arms and skin (data), taxel forces, joint readings. Out: generic
angles, taxels in space, touches, reflex motions. Pure numpy; nothing here reads a clock or a port.
"""
