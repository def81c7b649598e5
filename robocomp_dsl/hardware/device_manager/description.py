"""A device plan: devices, their attachments, and the actions of each phase. Data only."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field
from enum import StrEnum
from typing import TypeAlias

Value: TypeAlias = bool | int | float | str


class Phase(StrEnum):
    """Phase of the lifecycle of the devices. `RUN` has no actions; `CLOSED` is before and after."""

    CLOSED = "closed"
    STARTUP = "startup"
    RUN = "run"
    INTERRUPT1 = "interrupt1"
    INTERRUPT2 = "interrupt2"
    INTERRUPT3 = "interrupt3"
    SHUTDOWN = "shutdown"


INTERRUPTS = (Phase.INTERRUPT1, Phase.INTERRUPT2, Phase.INTERRUPT3)
PHASES_WITH_ACTIONS = (Phase.STARTUP, *INTERRUPTS, Phase.SHUTDOWN)
"""Phases that may have actions."""


class Verb(StrEnum):
    """What an action does; calibrate and park run in threads."""

    ATTACH = "attach"
    DETACH = "detach"
    CALIBRATE = "calibrate"
    PARK = "park"
    ABORT = "abort"


LONG_RUNNING = (Verb.CALIBRATE, Verb.PARK)


@dataclass(frozen=True, slots=True)
class DeviceSpec:
    """A device: a driver, wrapper, calibrator or controller, of a kind that the process knows."""

    name: str
    kind: str
    parameters: Mapping[str, Value] = field(default_factory=dict)


@dataclass(frozen=True, slots=True)
class Attachment:
    """`device` is attached to `to`, in this order."""

    device: str
    to: tuple[str, ...]


@dataclass(frozen=True, slots=True)
class DeviceAction:
    """Executes `verb` on `device` when `phase` reaches `level`.

    `by` is the calibrator that calibrates or parks; empty: the only one that is attached to
    `device`.
    """

    phase: Phase
    level: int
    verb: Verb
    device: str
    by: str = ""


@dataclass(frozen=True, slots=True)
class DevicePlan:
    """The complete plan. Devices are opened in this order and closed in reverse order.

    Attachments without an action are made before the first level of startup; all are
    undone after shutdown. `backwards`: levels of interrupts and shutdown descend.
    """

    devices: tuple[DeviceSpec, ...]
    attachments: tuple[Attachment, ...] = ()
    actions: tuple[DeviceAction, ...] = ()
    backwards: bool = False

    def attached_to(self, device: str) -> tuple[str, ...]:
        """The devices that `device` is attached to."""
        return tuple(
            name
            for attachment in self.attachments
            if attachment.device == device
            for name in attachment.to
        )

    def devices_on(self, device: str) -> tuple[str, ...]:
        """The devices attached to `device`, in the order of the attachments."""
        return tuple(
            attachment.device for attachment in self.attachments if device in attachment.to
        )
