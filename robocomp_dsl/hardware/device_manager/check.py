"""Checks a device plan before any device is opened.

In: a description and the kinds that there are. Out: findings, each with the name of its device;
none if the plan is valid. `PlanError` carries them all.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from difflib import get_close_matches

from robocomp_dsl.finding import NOWHERE, Finding
from robocomp_dsl.hardware.device_manager.description import (
    LONG_RUNNING,
    PHASES_WITH_ACTIONS,
    DeviceAction,
    DevicePlan,
    Verb,
)
from robocomp_dsl.hardware.device_manager.kinds import DeviceKind
from robocomp_dsl.hardware.devices.errors import HardwareError


class PlanError(HardwareError):
    """The plan is invalid; the message has one line per finding."""

    def __init__(self, findings: list[Finding]) -> None:
        super().__init__("\n".join(finding.message for finding in findings))
        self.findings = findings


def _finding(device: str, message: str) -> Finding:
    return Finding(NOWHERE, message, subject=device)


def findings(plan: DevicePlan, kinds: Mapping[str, DeviceKind]) -> list[Finding]:
    """All findings, in the order of the plan."""
    found = [*_devices(plan, kinds), *_attachments(plan, kinds)]
    found += [
        _finding(action.device, message)
        for action in plan.actions
        for message in _action(action, plan, kinds)
    ]
    return found


def attach_order(plan: DevicePlan) -> tuple[str, ...]:
    """Devices that are attached to others, in attach order; those in a cycle are left out."""
    waiting = {
        attachment.device: set(plan.attached_to(attachment.device))
        for attachment in plan.attachments
    }
    order: list[str] = []
    while ready := [name for name, below in waiting.items() if not below & waiting.keys()]:
        order += ready
        for name in ready:
            del waiting[name]
    return tuple(order)


def calibrator_of(
    action: DeviceAction, plan: DevicePlan, kinds: Mapping[str, DeviceKind]
) -> list[str]:
    """Devices that could calibrate or park for `action`; a valid plan has exactly one."""
    if action.by:
        return [action.by]
    known = _kinds(plan, kinds)
    return [
        device
        for device in plan.devices_on(action.device)
        if device in known and known[device].calibrates
    ]


def _kinds(plan: DevicePlan, kinds: Mapping[str, DeviceKind]) -> dict[str, DeviceKind]:
    return {device.name: kinds[device.kind] for device in plan.devices if device.kind in kinds}


def _devices(plan: DevicePlan, kinds: Mapping[str, DeviceKind]) -> Iterator[Finding]:
    seen: set[str] = set()
    for device in plan.devices:
        if device.name in seen:
            yield _finding(device.name, f"there are two devices `{device.name}`")
        seen.add(device.name)
        if device.kind not in kinds:
            message = f"device `{device.name}`: there is no kind `{device.kind}`"
            yield _finding(device.name, message + _like(device.kind, kinds))


def _attachments(plan: DevicePlan, kinds: Mapping[str, DeviceKind]) -> Iterator[Finding]:
    names = {attachment.name for attachment in plan.devices}
    known, order, seen = _kinds(plan, kinds), attach_order(plan), set()
    for attachment in plan.attachments:
        for name in (attachment.device, *attachment.to):
            if name not in names:
                yield _finding(
                    attachment.device, f"attach: there is no device `{name}`" + _like(name, names)
                )
        if attachment.device in seen:
            yield _finding(
                attachment.device,
                f"`{attachment.device}` is attached twice; name all devices in one",
            )
        seen.add(attachment.device)
        if len(set(attachment.to)) < len(attachment.to):
            yield _finding(
                attachment.device, f"`{attachment.device}` is attached to a device twice"
            )
        if attachment.device not in order:
            yield _finding(
                attachment.device,
                f"`{attachment.device}` is attached to itself, or is part of a cycle",
            )
        kind = known.get(attachment.device)
        if kind and len(attachment.to) > kind.max_attached:
            message = f"at most {kind.max_attached}" if kind.max_attached else "none"
            yield _finding(
                attachment.device,
                f"`{attachment.device}` is attached to {len(attachment.to)} devices;"
                f" it supports {message}",
            )


def _action(
    action: DeviceAction, plan: DevicePlan, kinds: Mapping[str, DeviceKind]
) -> Iterator[str]:
    names = {device.name for device in plan.devices}
    where = f"on {action.phase} level {action.level} {action.verb} {action.device}"
    if action.phase not in PHASES_WITH_ACTIONS:
        yield f"{where}: the phase `{action.phase}` has no actions"
    if action.level < 0:
        yield f"{where}: a level is 0 or more"
    missing = [name for name in (action.device, action.by) if name and name not in names]
    for name in missing:
        yield f"{where}: there is no device `{name}`" + _like(name, names)
    if missing:
        return
    if action.verb in (Verb.ATTACH, Verb.DETACH) and not plan.attached_to(action.device):
        yield f"{where}: `{action.device}` has no entry in `attach`"
    if action.verb in LONG_RUNNING:
        yield from _lasting(action, where, plan, kinds)
    elif action.by:
        yield f"{where}: only `calibrate` and `park` are done `by` another device"


def _lasting(
    action: DeviceAction, where: str, plan: DevicePlan, kinds: Mapping[str, DeviceKind]
) -> Iterator[str]:
    able, known = calibrator_of(action, plan, kinds), _kinds(plan, kinds)
    if not able:
        yield f"{where}: no calibrator is attached to `{action.device}`"
    if len(able) > 1:
        candidates = ", ".join(f"`{name}`" for name in able)
        yield f"{where}: {candidates} could do that; name one with `by`"
    if action.by and action.by in known and not known[action.by].calibrates:
        yield f"{where}: `{action.by}` is no calibrator"
    elif action.by and action.device not in plan.attached_to(action.by):
        yield f"{where}: `{action.by}` is not attached to `{action.device}`"


def _like(name: str, known: Mapping[str, DeviceKind] | set[str]) -> str:
    near = get_close_matches(name, sorted(known), 1)
    return f"; did you mean `{near[0]}`?" if near else ": " + (", ".join(sorted(known)) or "none")
