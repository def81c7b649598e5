"""Devices and worlds as data: scenes, skin, and the kind of a model file."""
