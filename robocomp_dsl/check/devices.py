"""The devices in a component of a deployment: whether they know each other and fit together.

In: an instance as written. Out: its devices, and findings. Which kinds of devices there are only
the component knows; it judges them when it starts.
"""

from __future__ import annotations

from collections.abc import Iterable, Mapping

from robocomp_dsl.check import codes
from robocomp_dsl.check.imports import replace
from robocomp_dsl.check.literals import listing
from robocomp_dsl.check.names import report_repeat, without_repeats
from robocomp_dsl.diagnostics import Note, Report, nearest
from robocomp_dsl.model import types
from robocomp_dsl.model.devices import Action, Attachment, Device, Devices
from robocomp_dsl.syntax import ast_ddsl as ast
from robocomp_dsl.syntax.ast_base import Name

MOVING = ("attach", "detach")
LASTING = ("calibrate", "park")


def devices_of(tree: ast.Instance, report: Report) -> Devices:
    """The devices that `tree` declares, and what is done with them."""
    trees = without_repeats(tree.devices, "device", report)
    known = {one.name.text: one for one in trees}
    attached = _attached(tree.attachments, known, report)
    _circles(attached, report)
    actions = [_action(one, known, attached, report) for one in tree.actions]
    return Devices(
        tuple(_device(one, report) for one in trees),
        tuple(
            Attachment(one.device.text, tuple(name.text for name in one.to), one.span)
            for one in attached.values()
        ),
        tuple(one for one in actions if one),
    )


def _device(tree: ast.Device, report: Report) -> Device:
    first: dict[str, Name] = {}
    made: dict[str, types.Literal] = {}
    for one in tree.settings:
        earlier = first.setdefault(one.key.text, one.key)
        if earlier is not one.key:
            report_repeat(one.key, earlier, "parameter", report)
            continue
        value = one.value.text if isinstance(one.value, Name) else one.value.value
        made[one.key.text] = value
    return Device(tree.name.text, tree.kind.text, tree.name.span, tuple(made.items()), tree.doc)


def _attached(
    trees: Iterable[ast.Attach], known: Mapping[str, ast.Device], report: Report
) -> dict[str, ast.Attach]:
    """The attachments whose devices are there, by the device above."""
    made: dict[str, ast.Attach] = {}
    for one in trees:
        if not all([_is_there(name, known, report) for name in (one.device, *one.to)]):  # noqa: C419
            continue
        earlier = made.setdefault(one.device.text, one)
        if earlier is not one:
            report.add(
                codes.DEVICE_CIRCLE,
                one.device.span,
                f"`{one.device.text}` is attached twice",
                notes=[Note(earlier.device.span, "it is attached here already")],
                help="name all that it stands on in one line: `attach … to a, b;`",
            )
        _twice(one, report)
    return made


def _twice(tree: ast.Attach, report: Report) -> None:
    first: dict[str, Name] = {}
    for name in tree.to:
        if (earlier := first.setdefault(name.text, name)) is not name:
            said = f"`{tree.device.text}` is attached to `{name.text}` twice"
            note = Note(earlier.span, "it is named here already")
            report.add(codes.DEVICE_CIRCLE, name.span, said, notes=[note], help="name it once")


def _circles(attached: Mapping[str, ast.Attach], report: Report) -> None:
    """Report each circle once, at the attachment of it that is written first."""
    told: set[str] = set()
    for name, one in attached.items():
        way = _way_back(name, attached)
        if way and not told & set(way):
            told |= set(way)
            said = " on ".join(f"`{each}`" for each in (*way, name))
            report.add(
                codes.DEVICE_CIRCLE,
                one.device.span,
                f"`{name}` stands on itself: {said}",
                help="leave one of these attachments out",
            )


def _way_back(start: str, attached: Mapping[str, ast.Attach]) -> tuple[str, ...]:
    """Devices from `start` downwards until `start` comes again; none where it does not."""
    todo: list[tuple[str, ...]] = [(start,)]
    seen: set[str] = set()
    while todo:
        way = todo.pop()
        below = attached.get(way[-1])
        for name in below.to if below else ():
            if name.text == start:
                return way
            if name.text not in seen:
                seen.add(name.text)
                todo.append((*way, name.text))
    return ()


def _action(
    tree: ast.Action,
    known: Mapping[str, ast.Device],
    attached: Mapping[str, ast.Attach],
    report: Report,
) -> Action | None:
    verb, device, by = tree.verb.text.lower(), tree.device, tree.by
    level = tree.level.value
    if level < 0 or level != int(level):
        said = f"a level is a whole number from 0 upwards, not {tree.level.span.text}"
        report.add(codes.DEVICE_ACTION, tree.level.span, said, help="write `level 5`, for one")
        return None
    if not all([_is_there(name, known, report) for name in (device, by) if name]):  # noqa: C419
        return None
    if verb in MOVING and device.text not in attached:
        said = f"`{device.text}` stands on nothing: it cannot be {verb}ed"
        right = f"write `attach {device.text} to …;` too, which tells on what it stands"
        report.add(codes.DEVICE_ACTION, device.span, said, help=right)
    elif verb in LASTING:
        _lasting(verb, device, by, attached, report)
    elif by:
        said = f"`{verb}` is not done by another device"
        report.add(codes.DEVICE_ACTION, by.span, said, help=f"leave out `by {by.text}`")
    return Action(
        tree.phase.text.lower(), int(level), verb, device.text, by.text if by else "", tree.span
    )


def _lasting(
    verb: str, device: Name, by: Name | None, attached: Mapping[str, ast.Attach], report: Report
) -> None:
    """Report a device that has nobody upon it who could `verb` it."""
    upon = [name for name, one in attached.items() if device.text in {n.text for n in one.to}]
    if by is None and not upon:
        said = f"no device is attached to `{device.text}` that could {verb} it"
        right = f"attach a calibrator: `attach zeroing to {device.text};`"
        report.add(codes.DEVICE_ACTION, device.span, said, help=right)
    if by is not None and by.text not in upon:
        said = f"`{by.text}` is not attached to `{device.text}`"
        right = f"write `attach {by.text} to {device.text};`"
        report.add(codes.DEVICE_ACTION, by.span, said, help=right)


def _is_there(name: Name, known: Mapping[str, ast.Device], report: Report) -> bool:
    if name.text in known:
        return True
    guess = nearest(name.text, known)
    report.add(
        codes.UNKNOWN_DEVICE,
        name.span,
        f"there is no device `{name.text}`",
        label=f"did you mean `{guess}`?" if guess else "",
        help=f"the component has {listing(list(known))}"
        if known
        else f"declare it: `device {name.text} : control_board;`",
        fix=replace(name.span, guess) if guess else None,
    )
    return False
