"""Reads a device plan from plain data, as in YAML or JSON.

In: a mapping with `devices`, `attach`, `actions` and `backwards`. Out: `DevicePlan`. This module
checks the format only; `check.py` checks whether devices and actions fit together:

    devices:
      - {name: arm, kind: control_board, part: LArm}
      - {name: zeroing, kind: calibrator, speed: 0.5}
    attach: {zeroing: [arm]}
    actions:
      - {phase: startup, level: 5, calibrate: arm}
      - {phase: shutdown, level: 1, park: arm, by: zeroing}
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from typing import Any

from robocomp_dsl.hardware.device_manager.description import (
    Attachment,
    DeviceAction,
    DevicePlan,
    DeviceSpec,
    Phase,
    Verb,
)
from robocomp_dsl.hardware.devices.errors import HardwareError

_PHASES = {phase.value: phase for phase in Phase if phase is not Phase.CLOSED}
_VERBS = {verb.value: verb for verb in Verb}


class InvalidPlan(HardwareError):
    """The data do not have the format of a plan; the message has one line per problem."""


def read_plan(data: object) -> DevicePlan:
    """The plan in `data`. Raises `InvalidPlan`."""
    wrong: list[str] = []
    whole = data if isinstance(data, Mapping) else {}
    if whole is not data:
        wrong.append("a plan is a mapping with `devices`, `attach` and `actions`")
    known = ("devices", "attach", "actions", "backwards")
    wrong += [f"`{key}`: not known; there are {', '.join(known)}" for key in whole.keys() - known]
    devices = [_device(at, entry, wrong) for at, entry in _items("devices", whole, wrong)]
    attachments = list(_attachments(whole.get("attach") or {}, wrong))
    actions = [_action(at, entry, wrong) for at, entry in _items("actions", whole, wrong)]
    backwards = whole.get("backwards", False)
    if not isinstance(backwards, bool):
        wrong.append("`backwards`: true or false")
    if wrong:
        raise InvalidPlan("\n".join(wrong))
    return DevicePlan(
        tuple(entry for entry in devices if entry),
        tuple(attachments),
        tuple(entry for entry in actions if entry),
        bool(backwards),
    )


def _items(
    key: str, whole: Mapping[Any, Any], wrong: list[str]
) -> Iterator[tuple[str, Mapping[Any, Any]]]:
    entries = whole.get(key) or []
    if not isinstance(entries, list):
        wrong.append(f"`{key}`: a list is needed")
        return
    for i, entry in enumerate(entries):
        if isinstance(entry, Mapping):
            yield f"{key}[{i}]", entry
        else:
            wrong.append(f"`{key}[{i}]`: a mapping is needed")


def _device(at: str, entry: Mapping[Any, Any], wrong: list[str]) -> DeviceSpec | None:
    name, kind = entry.get("name"), entry.get("kind")
    if not (isinstance(name, str) and isinstance(kind, str) and name and kind):
        wrong.append(f"`{at}`: a device has a `name` and a `kind`")
        return None
    rest = {str(key): value for key, value in entry.items() if key not in ("name", "kind")}
    for key, value in rest.items():
        if not isinstance(value, bool | int | float | str):
            wrong.append(f"`{at}.{key}`: a number, a string, true or false is needed")
    return DeviceSpec(name, kind, rest)


def _attachments(entries: object, wrong: list[str]) -> Iterator[Attachment]:
    if not isinstance(entries, Mapping):
        wrong.append("`attach`: a mapping of devices to lists of devices is needed")
        return
    for device, to in entries.items():
        names = [to] if isinstance(to, str) else to
        if isinstance(names, list) and names and all(isinstance(n, str) for n in names):
            yield Attachment(str(device), tuple(names))
        else:
            wrong.append(f"`attach.{device}`: a list of devices is needed")


def _action(at: str, entry: Mapping[Any, Any], wrong: list[str]) -> DeviceAction | None:
    verbs = [key for key in entry if key in _VERBS]
    phase, level, by = (
        _PHASES.get(str(entry.get("phase"))),
        entry.get("level", 0),
        entry.get("by", ""),
    )
    before = len(wrong)
    strange = entry.keys() - {"phase", "level", "by", *_VERBS}
    wrong.extend(f"`{at}.{key}`: not known" for key in sorted(map(str, strange)))
    if phase is None:
        wrong.append(f"`{at}.phase`: one of {', '.join(_PHASES)} is needed")
    if isinstance(level, bool) or not isinstance(level, int):
        wrong.append(f"`{at}.level`: a whole number is needed")
    if len(verbs) != 1 or not isinstance(entry[verbs[0]], str):
        wrong.append(f"`{at}`: one of {', '.join(_VERBS)}, and the device that it is done to")
    if not isinstance(by, str):
        wrong.append(f"`{at}.by`: the name of a calibrator is needed")
    if len(wrong) > before or phase is None:
        return None
    return DeviceAction(phase, level, _VERBS[verbs[0]], entry[verbs[0]], str(by))
