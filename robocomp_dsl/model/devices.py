"""The devices in a component of a deployment, resolved."""

from __future__ import annotations

from robocomp_dsl.model.types import Literal
from robocomp_dsl.record import Record
from robocomp_dsl.source import Span


class Device(Record):
    """A driver, wrapper, calibrator or controller; the component defines its kinds."""

    name: str
    kind: str
    span: Span
    parameters: tuple[tuple[str, Literal], ...] = ()
    doc: str = ""


class Attachment(Record):
    """`device` is attached to the devices `to`."""

    device: str
    to: tuple[str, ...]
    span: Span


class Action(Record):
    """`verb` is applied to `device` in a phase, by the calibrator `by` or the only one."""

    phase: str
    level: int
    verb: str
    device: str
    by: str
    span: Span


class Devices(Record):
    """The devices, attachments and actions of one component, in order of writing."""

    devices: tuple[Device, ...] = ()
    attachments: tuple[Attachment, ...] = ()
    actions: tuple[Action, ...] = ()

    def __bool__(self) -> bool:
        return bool(self.devices)
