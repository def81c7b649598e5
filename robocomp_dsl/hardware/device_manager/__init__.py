"""Devices of one process, put together as robotinterface of YARP does it, without a network.

In: a description (`description.py`) and the kinds of devices that there are (`kinds.py`). Out:
devices that are opened, attached to one another, calibrated, parked and closed in the right order
(`conductor.py`). `check.py` judges a description before anything is opened.
"""
