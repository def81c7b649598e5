"""The devices of an instance: for its process as an environment variable, for people as lines."""

from __future__ import annotations

import json
from typing import Any

from robocomp_dsl.model.devices import Action, Devices

VARIABLE = "ROBOCOMP_DEVICES"


def devices_environment(devices: Devices) -> tuple[tuple[str, str], ...]:
    """The variable with the description as JSON; nothing where there are no devices."""
    if not devices:
        return ()
    data: dict[str, Any] = {
        "devices": [
            {**dict(one.parameters), "name": one.name, "kind": one.kind} for one in devices.devices
        ],
        "attach": {one.device: list(one.to) for one in devices.attachments},
        "actions": [_action(one) for one in devices.actions],
    }
    return ((VARIABLE, json.dumps(data)),)


def _action(one: Action) -> dict[str, Any]:
    made: dict[str, Any] = {"phase": one.phase, "level": one.level, one.verb: one.device}
    return {**made, "by": one.by} if one.by else made


def devices_shown(devices: Devices) -> tuple[str, ...]:
    """`arm: control_board`, `hand: cartesian on arm`, `startup 5: calibrate arm by zeroing`."""
    on = {one.device: one.to for one in devices.attachments}
    things = (
        f"{one.name}: {one.kind}" + (f" on {', '.join(on[one.name])}" if one.name in on else "")
        for one in devices.devices
    )
    actions = (
        f"{one.phase} {one.level}: {one.verb} {one.device}" + (f" by {one.by}" if one.by else "")
        for one in devices.actions
    )
    return (*things, *actions)
