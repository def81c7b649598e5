"""Resolves the devices of an instance and checks their attachments and actions.

In: an instance. Out: its devices, and diagnostics. Only the component knows the kinds of devices;
it checks them when it starts.
"""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from collections.abc import Set as AbstractSet

from robocomp_dsl.check.codes import devices as codes
from robocomp_dsl.check.codes.deployment import SETTING_TYPE
from robocomp_dsl.check.literals import join_names
from robocomp_dsl.check.names.duplicates import report_duplicate, unique_by_name
from robocomp_dsl.check.names.unknown_names import report_unknown_name
from robocomp_dsl.diagnostics import Note, Report, is_similar
from robocomp_dsl.model import types
from robocomp_dsl.model.devices import Action, Attachment, Device, Devices
from robocomp_dsl.syntax.ast import ddsl as ast
from robocomp_dsl.syntax.ast.base import LiteralList, Name

ATTACHMENT_VERBS = ("attach", "detach")
CALIBRATOR_VERBS = ("calibrate", "park")


def resolve_devices(tree: ast.Instance, report: Report) -> Devices:
    """The devices that `tree` declares, their attachments and actions."""
    trees = unique_by_name(tree.devices, "device", report)
    known = {tree_node.name.text: tree_node for tree_node in trees}
    attached = _attached(tree.attachments, known, report)
    _report_cycles(attached, report)
    faulty = _faulty_attachments(tree.attachments, known)
    actions = [_action(tree_node, known, attached, faulty, report) for tree_node in tree.actions]
    return Devices(
        tuple(_device(tree_node, report) for tree_node in trees),
        tuple(
            Attachment(
                tree_node.device.text, tuple(name.text for name in tree_node.to), tree_node.span
            )
            for tree_node in attached.values()
        ),
        tuple(tree_node for tree_node in actions if tree_node),
    )


def _device(tree: ast.Device, report: Report) -> Device:
    first: dict[str, Name] = {}
    parameters: dict[str, types.Literal] = {}
    for setting in tree.settings:
        earlier = first.setdefault(setting.key.text, setting.key)
        if earlier is not setting.key:
            report_duplicate(setting.key, earlier, "parameter", report)
            continue
        if isinstance(setting.value, LiteralList):
            message = f"`{setting.key.text}` of a device is one value, not a list"
            report.add(SETTING_TYPE, setting.value.span, message)
            continue
        value = setting.value.text if isinstance(setting.value, Name) else setting.value.value
        parameters[setting.key.text] = value
    return Device(
        tree.name.text, tree.kind.text, tree.name.span, tuple(parameters.items()), tree.doc
    )


def _attached(
    trees: Iterable[ast.Attach], known: Mapping[str, ast.Device], report: Report
) -> dict[str, ast.Attach]:
    """The attachments between declared devices, by the attached device."""
    attached: dict[str, ast.Attach] = {}
    for tree in trees:
        if not all([_is_declared(name, known, report) for name in (tree.device, *tree.to)]):  # noqa: C419
            continue
        earlier = attached.setdefault(tree.device.text, tree)
        if earlier is not tree:
            report.add(
                codes.DEVICE_CYCLE,
                tree.device.span,
                f"`{tree.device.text}` is attached twice",
                notes=[Note(earlier.device.span, "already attached here")],
                help="list all targets in one line: `attach … to a, b;`",
            )
        _report_duplicate_targets(tree, report)
    return attached


def _faulty_attachments(
    trees: Iterable[ast.Attach], known: Mapping[str, ast.Device]
) -> frozenset[str]:
    """The devices that may be attached by a line with an unknown name."""
    names = [[tree.device.text, *(name.text for name in tree.to)] for tree in trees]
    unknown = {name for line in names for name in line if name not in known}
    mentioned = {name for line in names if unknown & {*line} for name in line}
    meant = {name for name in known if any(is_similar(other, name) for other in unknown)}
    return frozenset(mentioned | meant)


def _report_duplicate_targets(tree: ast.Attach, report: Report) -> None:
    first: dict[str, Name] = {}
    for name in tree.to:
        if (earlier := first.setdefault(name.text, name)) is not name:
            message = f"`{tree.device.text}` is attached to `{name.text}` twice"
            note = Note(earlier.span, "already listed here")
            report.add(codes.DEVICE_CYCLE, name.span, message, notes=[note], help="list it once")


def _report_cycles(attached: Mapping[str, ast.Attach], report: Report) -> None:
    """Report each cycle once, at its first attachment in the file."""
    reported: set[str] = set()
    for name, tree in attached.items():
        path = _path_to_itself(name, attached)
        if path and not reported & set(path):
            reported |= set(path)
            shown = " → ".join(f"`{each}`" for each in (*path, name))
            report.add(
                codes.DEVICE_CYCLE,
                tree.device.span,
                f"`{name}` is attached to itself: {shown}",
                help="remove one of these attachments",
            )


def _path_to_itself(start: str, attached: Mapping[str, ast.Attach]) -> tuple[str, ...]:
    """The devices from `start` along attachments back to `start`; empty if there is no cycle."""
    todo: list[tuple[str, ...]] = [(start,)]
    seen: set[str] = set()
    while todo:
        path = todo.pop()
        below = attached.get(path[-1])
        for name in below.to if below else ():
            if name.text == start:
                return path
            if name.text not in seen:
                seen.add(name.text)
                todo.append((*path, name.text))
    return ()


def _action(
    tree: ast.Action,
    known: Mapping[str, ast.Device],
    attached: Mapping[str, ast.Attach],
    faulty: AbstractSet[str],
    report: Report,
) -> Action | None:
    verb, device, by = tree.verb.text.lower(), tree.device, tree.by
    level = tree.level.value
    if level < 0 or level != int(level):
        message = f"a level is a whole number from 0, not {tree.level.span.text}"
        report.add(codes.DEVICE_ACTION, tree.level.span, message, help="for example `level 5`")
        return None
    if not all([_is_declared(name, known, report) for name in (device, by) if name]):  # noqa: C419
        return None
    if {device.text, by.text if by else ""} & faulty:
        return None
    if verb in ATTACHMENT_VERBS and device.text not in attached:
        message = f"`{device.text}` has no `attach` line: it cannot be {verb}ed"
        right = f"write `attach {device.text} to …;`"
        report.add(codes.DEVICE_ACTION, device.span, message, help=right)
    elif verb in CALIBRATOR_VERBS:
        _check_calibrator(verb, device, by, attached, report)
    elif by:
        message = f"`{verb}` does not take `by`"
        report.add(codes.DEVICE_ACTION, by.span, message, help=f"remove `by {by.text}`")
    return Action(
        tree.phase.text.lower(), int(level), verb, device.text, by.text if by else "", tree.span
    )


def _check_calibrator(
    verb: str, device: Name, by: Name | None, attached: Mapping[str, ast.Attach], report: Report
) -> None:
    """Report a device without an attached calibrator for `verb`."""
    upon = [name for name, tree in attached.items() if device.text in {n.text for n in tree.to}]
    if by is None and not upon:
        message = f"no device is attached to `{device.text}` that could {verb} it"
        right = f"attach a calibrator: `attach zeroing to {device.text};`"
        report.add(codes.DEVICE_ACTION, device.span, message, help=right)
    if by is not None and by.text not in upon:
        message = f"`{by.text}` is not attached to `{device.text}`"
        right = f"write `attach {by.text} to {device.text};`"
        report.add(codes.DEVICE_ACTION, by.span, message, help=right)


def _is_declared(name: Name, known: Mapping[str, ast.Device], report: Report) -> bool:
    if name.text in known:
        return True
    report_unknown_name(
        report,
        codes.UNKNOWN_DEVICE,
        name,
        f"unknown device `{name.text}`",
        known,
        f"the component has {join_names(list(known))}"
        if known
        else f"declare it: `device {name.text} : control_board;`",
        declared=[device.name.span for device in known.values()],
    )
    return False
