"""Control and interaction modes, and their transitions (YARP IControlMode, icub-tests).

In: the current mode of a joint and the requested mode. Out: the new mode, or `ModeRefused`.
"""

from __future__ import annotations

from enum import StrEnum

from robocomp_dsl.hardware.control.errors import ModeRefused


class Mode(StrEnum):
    """Control modes; the values are YARP's short names."""

    IDLE = "idl"
    FORCE_IDLE = "fidl"
    POSITION = "pos"
    POSITION_DIRECT = "posd"
    VELOCITY = "vel"
    VELOCITY_DIRECT = "veld"
    MIXED = "mix"
    TORQUE = "torq"
    PWM = "ipwm"
    CURRENT = "icur"
    HW_FAULT = "hwfa"
    CALIBRATING = "cal"
    CALIB_DONE = "cald"
    NOT_CONFIGURED = "cfgn"
    CONFIGURED = "cfgy"
    UNKNOWN = "unkw"


class Interaction(StrEnum):
    """Stiff: follow the reference with full torque. Compliant: act as a spring and damper."""

    STIFF = "stif"
    COMPLIANT = "comp"


SELECTABLE = (
    Mode.IDLE,
    Mode.FORCE_IDLE,
    Mode.POSITION,
    Mode.POSITION_DIRECT,
    Mode.VELOCITY,
    Mode.VELOCITY_DIRECT,
    Mode.MIXED,
    Mode.TORQUE,
    Mode.PWM,
    Mode.CURRENT,
)
"""Modes that a command may request; the others are states of the joint."""

POSITIONED = (
    Mode.POSITION,
    Mode.POSITION_DIRECT,
    Mode.VELOCITY,
    Mode.VELOCITY_DIRECT,
    Mode.MIXED,
)
"""Modes that hold a reference position."""


def next_mode(name: str, present: Mode, requested: Mode, *, calibrated: bool) -> Mode:
    """The new mode of joint `name` after the request `requested`; raises `ModeRefused`.

    Force-idle always leads to idle and is the only exit from a hardware fault. An uncalibrated
    joint may only be idle.
    """
    if requested not in SELECTABLE:
        raise ModeRefused(f"`{name}`: `{requested}` is a state, it cannot be asked for")
    if requested is Mode.FORCE_IDLE:
        return Mode.IDLE
    if present is Mode.HW_FAULT:
        raise ModeRefused(f"`{name}` has a hardware fault; only force-idle (`fidl`) clears it")
    if present is Mode.CALIBRATING:
        raise ModeRefused(f"`{name}` is being calibrated; force-idle (`fidl`) stops that")
    if not calibrated and requested is not Mode.IDLE:
        raise ModeRefused(f"`{name}` is not calibrated and may only be idle")
    return requested
