"""Describes the devices of an instance: as an environment variable, and as text lines."""

from __future__ import annotations

import json
from typing import Any

from robocomp_dsl.model.devices import Action, Devices

DEVICES_VARIABLE = "ROBOCOMP_DEVICES"


def devices_environment(devices: Devices) -> tuple[tuple[str, str], ...]:
    """The environment variable that holds the devices as JSON; empty without devices."""
    if not devices:
        return ()
    data: dict[str, Any] = {
        "devices": [
            {**dict(device.parameters), "name": device.name, "kind": device.kind}
            for device in devices.devices
        ],
        "attach": {attached.device: list(attached.to) for attached in devices.attachments},
        "actions": [_action_data(action) for action in devices.actions],
    }
    return ((DEVICES_VARIABLE, json.dumps(data)),)


def _action_data(action: Action) -> dict[str, Any]:
    data: dict[str, Any] = {
        "phase": action.phase,
        "level": action.level,
        action.verb: action.device,
    }
    return {**data, "by": action.by} if action.by else data


def describe_devices(devices: Devices) -> tuple[str, ...]:
    """`arm: control_board`, `hand: cartesian on arm`, `startup 5: calibrate arm by zeroing`."""
    targets = {attached.device: attached.to for attached in devices.attachments}
    lines = []
    for device in devices.devices:
        on = f" on {', '.join(targets[device.name])}" if device.name in targets else ""
        lines.append(f"{device.name}: {device.kind}{on}")
    for action in devices.actions:
        by = f" by {action.by}" if action.by else ""
        lines.append(f"{action.phase} {action.level}: {action.verb} {action.device}{by}")
    return tuple(lines)
