"""Manages the devices of one process like YARP's robotinterface, without a network.

In: a plan (`description.py`) and the available kinds of devices (`kinds.py`). Out: devices that are
opened, attached, calibrated, parked and closed in order (`manager.py`). `check.py` validates a
plan before any device is opened.
"""
