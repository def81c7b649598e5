"""Is a description one that can be carried out? Judged before any device is opened.

In: a description and the kinds that there are. Out: what is wrong, each with the item that it is
about; nothing is wrong when there is none. `PlumbingError` carries them all.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from dataclasses import dataclass
from difflib import get_close_matches

from robocomp_dsl.hardware.errors import HardwareError
from robocomp_dsl.hardware.plumbing.description import (
    ACTING,
    LASTING,
    Action,
    Attachment,
    DeviceSpec,
    Plumbing,
    Verb,
)
from robocomp_dsl.hardware.plumbing.kinds import Kind


@dataclass(frozen=True, slots=True)
class Finding:
    """What is wrong with an item of the description."""

    item: DeviceSpec | Attachment | Action
    message: str


class PlumbingError(HardwareError):
    """The description cannot be carried out; the message tells all of it, a line each."""

    def __init__(self, findings: list[Finding]) -> None:
        super().__init__("\n".join(one.message for one in findings))
        self.findings = findings


def findings(plan: Plumbing, kinds: Mapping[str, Kind]) -> list[Finding]:
    """All that is wrong, in the order of the description."""
    made = [*_devices(plan, kinds), *_attachments(plan, kinds)]
    made += [Finding(one, said) for one in plan.actions for said in _action(one, plan, kinds)]
    return made


def attach_order(plan: Plumbing) -> tuple[str, ...]:
    """Devices that stand on others, those below first; what is in a circle is left out."""
    waiting = {one.device: set(plan.attached(one.device)) for one in plan.attachments}
    made: list[str] = []
    while ready := [name for name, below in waiting.items() if not below & waiting.keys()]:
        made += ready
        for name in ready:
            del waiting[name]
    return tuple(made)


def calibrator_of(action: Action, plan: Plumbing, kinds: Mapping[str, Kind]) -> list[str]:
    """Who could calibrate or park for `action`; it is well told when there is exactly one."""
    if action.by:
        return [action.by]
    known = _kinds(plan, kinds)
    return [one for one in plan.upon(action.device) if one in known and known[one].calibrates]


def _kinds(plan: Plumbing, kinds: Mapping[str, Kind]) -> dict[str, Kind]:
    return {one.name: kinds[one.kind] for one in plan.devices if one.kind in kinds}


def _devices(plan: Plumbing, kinds: Mapping[str, Kind]) -> Iterator[Finding]:
    seen: set[str] = set()
    for one in plan.devices:
        if one.name in seen:
            yield Finding(one, f"there are two devices `{one.name}`")
        seen.add(one.name)
        if one.kind not in kinds:
            said = f"device `{one.name}`: there is no kind `{one.kind}`"
            yield Finding(one, said + _like(one.kind, kinds))


def _attachments(plan: Plumbing, kinds: Mapping[str, Kind]) -> Iterator[Finding]:
    names = {one.name for one in plan.devices}
    known, order, seen = _kinds(plan, kinds), attach_order(plan), set()
    for one in plan.attachments:
        for name in (one.device, *one.to):
            if name not in names:
                yield Finding(one, f"attach: there is no device `{name}`" + _like(name, names))
        if one.device in seen:
            yield Finding(one, f"`{one.device}` is attached twice; name all devices in one")
        seen.add(one.device)
        if len(set(one.to)) < len(one.to):
            yield Finding(one, f"`{one.device}` is attached to a device twice")
        if one.device not in order:
            yield Finding(one, f"`{one.device}` stands on itself, in a circle or above one")
        kind = known.get(one.device)
        if kind and len(one.to) > kind.most:
            said = f"at most {kind.most}" if kind.most else "no others"
            yield Finding(one, f"`{one.device}` stands on {len(one.to)} devices, it takes {said}")


def _action(one: Action, plan: Plumbing, kinds: Mapping[str, Kind]) -> Iterator[str]:
    names = {device.name for device in plan.devices}
    where = f"on {one.phase} level {one.level} {one.verb} {one.device}"
    if one.phase not in ACTING:
        yield f"{where}: the phase `{one.phase}` has no actions"
    if one.level < 0:
        yield f"{where}: a level is 0 or more"
    missing = [name for name in (one.device, one.by) if name and name not in names]
    for name in missing:
        yield f"{where}: there is no device `{name}`" + _like(name, names)
    if missing:
        return
    if one.verb in (Verb.ATTACH, Verb.DETACH) and not plan.attached(one.device):
        yield f"{where}: no `attach` tells what `{one.device}` stands on"
    if one.verb in LASTING:
        yield from _lasting(one, where, plan, kinds)
    elif one.by:
        yield f"{where}: only `calibrate` and `park` are done `by` another device"


def _lasting(one: Action, where: str, plan: Plumbing, kinds: Mapping[str, Kind]) -> Iterator[str]:
    able, known = calibrator_of(one, plan, kinds), _kinds(plan, kinds)
    if not able:
        yield f"{where}: no calibrator is attached to `{one.device}`"
    if len(able) > 1:
        yield f"{where}: {', '.join(f'`{name}`' for name in able)} could do that; say by whom"
    if one.by and one.by in known and not known[one.by].calibrates:
        yield f"{where}: `{one.by}` is no calibrator"
    elif one.by and one.device not in plan.attached(one.by):
        yield f"{where}: `{one.by}` is not attached to `{one.device}`"


def _like(name: str, known: Mapping[str, Kind] | set[str]) -> str:
    near = get_close_matches(name, sorted(known), 1)
    return f"; did you mean `{near[0]}`?" if near else ": " + (", ".join(sorted(known)) or "none")
