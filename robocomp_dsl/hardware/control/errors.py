"""Why a control board refuses a command. Nothing has changed then.

CommandRefused
└── ControlRefused
    ├── UnknownJoint     no joint has this name or number
    ├── BadValue         NaN, infinity, a wrong number of values, a negative gain
    ├── WrongMode        the joint is in a mode that does not take this command
    ├── ModeRefused      this mode cannot follow the present one
    ├── NoSpeed          the reference speed is zero: the motion would never end
    └── NotEquipped      the joint has no torque control
"""

from __future__ import annotations

from robocomp_dsl.hardware.devices.errors import CommandRefused


class ControlRefused(CommandRefused):
    """Base of what a control board refuses."""


class UnknownJoint(ControlRefused):
    """No joint of the board has this name or number."""


class BadValue(ControlRefused):
    """A value that no joint can take."""


class WrongMode(ControlRefused):
    """The command belongs to another control mode."""


class ModeRefused(ControlRefused):
    """The control mode cannot be entered from here."""


class NoSpeed(ControlRefused):
    """A position cannot be reached at reference speed zero."""


class NotEquipped(ControlRefused):
    """The joint lacks what the command needs."""
