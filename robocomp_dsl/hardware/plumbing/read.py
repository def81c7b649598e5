"""A description out of plain data, as a YAML or JSON file holds it.

In: a mapping with `devices`, `attach`, `actions` and `backwards`. Out: `Plumbing`. Whether devices
and actions fit together is for `check.py` to say; here it is only about form:

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

from robocomp_dsl.hardware.errors import HardwareError
from robocomp_dsl.hardware.plumbing.description import (
    Action,
    Attachment,
    DeviceSpec,
    Phase,
    Plumbing,
    Verb,
)

_PHASES = {phase.value: phase for phase in Phase if phase is not Phase.CLOSED}
_VERBS = {verb.value: verb for verb in Verb}


class BadDescription(HardwareError):
    """The data has not the form of a description; the message tells all of it, a line each."""


def plumbing_of(data: object) -> Plumbing:
    """The description that `data` holds. Raises `BadDescription`."""
    wrong: list[str] = []
    whole = data if isinstance(data, Mapping) else {}
    if whole is not data:
        wrong.append("a description is a mapping with `devices`, `attach` and `actions`")
    known = ("devices", "attach", "actions", "backwards")
    wrong += [f"`{key}`: not known; there are {', '.join(known)}" for key in whole.keys() - known]
    devices = [_device(at, one, wrong) for at, one in _items("devices", whole, wrong)]
    attachments = list(_attachments(whole.get("attach") or {}, wrong))
    actions = [_action(at, one, wrong) for at, one in _items("actions", whole, wrong)]
    backwards = whole.get("backwards", False)
    if not isinstance(backwards, bool):
        wrong.append("`backwards`: true or false")
    if wrong:
        raise BadDescription("\n".join(wrong))
    return Plumbing(
        tuple(one for one in devices if one),
        tuple(attachments),
        tuple(one for one in actions if one),
        bool(backwards),
    )


def _items(
    key: str, whole: Mapping[Any, Any], wrong: list[str]
) -> Iterator[tuple[str, Mapping[Any, Any]]]:
    given = whole.get(key) or []
    if not isinstance(given, list):
        wrong.append(f"`{key}`: a list is needed")
        return
    for i, one in enumerate(given):
        if isinstance(one, Mapping):
            yield f"{key}[{i}]", one
        else:
            wrong.append(f"`{key}[{i}]`: a mapping is needed")


def _device(at: str, one: Mapping[Any, Any], wrong: list[str]) -> DeviceSpec | None:
    name, kind = one.get("name"), one.get("kind")
    if not (isinstance(name, str) and isinstance(kind, str) and name and kind):
        wrong.append(f"`{at}`: a device has a `name` and a `kind`")
        return None
    rest = {str(key): value for key, value in one.items() if key not in ("name", "kind")}
    for key, value in rest.items():
        if not isinstance(value, bool | int | float | str):
            wrong.append(f"`{at}.{key}`: a number, a text, true or false is needed")
    return DeviceSpec(name, kind, rest)


def _attachments(given: object, wrong: list[str]) -> Iterator[Attachment]:
    if not isinstance(given, Mapping):
        wrong.append("`attach`: a mapping of devices to lists of devices is needed")
        return
    for device, to in given.items():
        names = [to] if isinstance(to, str) else to
        if isinstance(names, list) and names and all(isinstance(n, str) for n in names):
            yield Attachment(str(device), tuple(names))
        else:
            wrong.append(f"`attach.{device}`: a list of devices is needed")


def _action(at: str, one: Mapping[Any, Any], wrong: list[str]) -> Action | None:
    verbs = [key for key in one if key in _VERBS]
    phase, level, by = _PHASES.get(str(one.get("phase"))), one.get("level", 0), one.get("by", "")
    before = len(wrong)
    strange = one.keys() - {"phase", "level", "by", *_VERBS}
    wrong.extend(f"`{at}.{key}`: not known" for key in sorted(map(str, strange)))
    if phase is None:
        wrong.append(f"`{at}.phase`: one of {', '.join(_PHASES)} is needed")
    if isinstance(level, bool) or not isinstance(level, int):
        wrong.append(f"`{at}.level`: a whole number is needed")
    if len(verbs) != 1 or not isinstance(one[verbs[0]], str):
        wrong.append(f"`{at}`: one of {', '.join(_VERBS)}, and the device that it is done to")
    if not isinstance(by, str):
        wrong.append(f"`{at}.by`: the name of a calibrator is needed")
    if len(wrong) > before or phase is None:
        return None
    return Action(phase, level, _VERBS[verbs[0]], one[verbs[0]], str(by))
