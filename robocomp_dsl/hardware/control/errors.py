"""Errors of a control board that rejects a command; its state is then unchanged.

CommandRefused
└── ControlRefused
    ├── UnknownJoint     no joint has this name or number
    ├── BadValue         NaN, infinity, wrong number of values, negative gain
    ├── WrongMode        the joint is in a mode that does not accept the command
    ├── ModeRefused      the current mode does not permit this one
    ├── NoSpeed          the reference speed is zero: the motion would never end
    └── NotEquipped      the joint has no torque control
"""

from __future__ import annotations

from robocomp_dsl.hardware.devices.errors import CommandRefused


class ControlRefused(CommandRefused):
    """Base of all rejections by a control board."""


class UnknownJoint(ControlRefused):
    """No joint of the board has this name or number."""


class BadValue(ControlRefused):
    """An invalid value."""


class WrongMode(ControlRefused):
    """The command needs another control mode."""


class ModeRefused(ControlRefused):
    """The control mode cannot be entered from the current one."""


class NoSpeed(ControlRefused):
    """A position cannot be reached at reference speed zero."""


class NotEquipped(ControlRefused):
    """The joint lacks the equipment for the command."""
