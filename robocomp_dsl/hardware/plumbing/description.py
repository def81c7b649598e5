"""What devices there are, which stands on which, and what happens in which phase. Data only."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field
from enum import StrEnum
from typing import TypeAlias

Value: TypeAlias = bool | int | float | str


class Phase(StrEnum):
    """Where the life of the devices is. `RUN` has no actions; `CLOSED` is before and after."""

    CLOSED = "closed"
    STARTUP = "startup"
    RUN = "run"
    INTERRUPT1 = "interrupt1"
    INTERRUPT2 = "interrupt2"
    INTERRUPT3 = "interrupt3"
    SHUTDOWN = "shutdown"


INTERRUPTS = (Phase.INTERRUPT1, Phase.INTERRUPT2, Phase.INTERRUPT3)
ACTING = (Phase.STARTUP, *INTERRUPTS, Phase.SHUTDOWN)
"""Phases that may have actions."""


class Verb(StrEnum):
    """What an action does; calibrate and park take their time, in threads."""

    ATTACH = "attach"
    DETACH = "detach"
    CALIBRATE = "calibrate"
    PARK = "park"
    ABORT = "abort"


LASTING = (Verb.CALIBRATE, Verb.PARK)


@dataclass(frozen=True, slots=True)
class DeviceSpec:
    """A device: a driver, wrapper, calibrator or controller, of a kind that the process knows."""

    name: str
    kind: str
    parameters: Mapping[str, Value] = field(default_factory=dict)


@dataclass(frozen=True, slots=True)
class Attachment:
    """`device` stands on `to`, in this order."""

    device: str
    to: tuple[str, ...]


@dataclass(frozen=True, slots=True)
class Action:
    """`verb` is done to `device` when `phase` has come to `level`.

    `by` is the calibrator that calibrates or parks; empty: the only one that stands on `device`.
    """

    phase: Phase
    level: int
    verb: Verb
    device: str
    by: str = ""


@dataclass(frozen=True, slots=True)
class Plumbing:
    """All of it. Devices are opened in this order and closed in the opposite one.

    What is attached by no action of its own is attached before the first level of startup, and all
    is detached when shutdown is over. `backwards`: levels of interrupts and shutdown go down.
    """

    devices: tuple[DeviceSpec, ...]
    attachments: tuple[Attachment, ...] = ()
    actions: tuple[Action, ...] = ()
    backwards: bool = False

    def attached(self, device: str) -> tuple[str, ...]:
        """What `device` stands on."""
        return tuple(name for one in self.attachments if one.device == device for name in one.to)

    def upon(self, device: str) -> tuple[str, ...]:
        """What stands on `device`, in the order of the attachments."""
        return tuple(one.device for one in self.attachments if device in one.to)
