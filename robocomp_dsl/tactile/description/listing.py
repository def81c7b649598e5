"""The XML form of a generic part that the paper prints (listing 2 of Ma and Dahl, 2016), read.

In: the text. Out: a `Part` without chain and skin. The printed form has no root element, closes
`initial_positions` by a misspelt tag and leaves out servos by dots: all accepted. Additions: a root
element around it, `limits` with `min` and `max`, and `destination_part` in a servo. Indices that
are not described count as joints that the robot lacks; joints that have an initial position and no
servo are held there.
"""

from __future__ import annotations

import math
import re
from collections.abc import Iterable, Iterator
from dataclasses import dataclass, field
from pathlib import Path

from robocomp_dsl.tactile.description.located import UNITS, Place
from robocomp_dsl.tactile.description.model import Held, Part, Servo
from robocomp_dsl.tactile.errors import DescriptionError, Fault, Finding

_TOKEN = re.compile(
    r"<!--.*?-->|<\?.*?\?>"
    r"|<(/?)\s*([\w.-]+)((?:\s+[\w.-]+\s*=\s*(?:\"[^\"]*\"|'[^']*'))*)\s*(/?)>",
    re.DOTALL,
)
_ATTRIBUTE = re.compile(r"([\w.-]+)\s*=\s*([\"'])(.*?)\2", re.DOTALL)
_ALIASES = {"initial_postions": "initial_positions"}
_MOST_SERVOS = 1000
_DEEPEST = 20


@dataclass(slots=True)
class _Element:
    tag: str
    attributes: dict[str, str]
    place: Place
    text: str = ""
    children: list[_Element] = field(default_factory=list)

    def child(self, tag: str) -> _Element | None:
        return next((one for one in self.children if one.tag == tag), None)


@dataclass(slots=True)
class _Listing:
    """One file being read."""

    file: Path
    findings: list[Finding] = field(default_factory=list)

    def complain(self, place: Place, message: str, fault: Fault = Fault.FORM) -> None:
        found = Finding(str(self.file), place.line, place.column, message, fault=fault)
        self.findings.append(found)

    def value(self, element: _Element | None, default: float) -> float:
        """The number an element holds."""
        if element is None:
            return default
        return self.number(element.text, element, default)

    def number(self, text: str, element: _Element, default: float = 0.0) -> float:
        try:
            value = float(text)
        except ValueError:
            value = math.nan
        if math.isfinite(value):
            return value
        self.complain(element.place, f"`{text.strip()}` in <{element.tag}> is not a number")
        return default

    def attribute(self, element: _Element, key: str, default: float = 0.0) -> float:
        """The attribute `key` as a number; `default` after a complaint."""
        if key in element.attributes:
            return self.number(element.attributes[key], element, default)
        self.complain(element.place, f"<{element.tag}> has no attribute `{key}`")
        return default


def read_listing(text: str, file: Path, joints: tuple[str, ...] = ()) -> Part:
    """The generic part of `text`; `joints` names the destination servos, else their ids do.

    Raises `DescriptionError` with every finding.
    """
    listing = _Listing(file)
    root = _tree(text, listing)
    name = next((one for one in _all(root, "Generic_Robot_Part")), None)
    if name is None:
        listing.complain(Place(1, 1), "there is no <Generic_Robot_Part>")
        raise DescriptionError(listing.findings)
    count = next(iter(_all(root, "generic_servo_number")), None)
    size = int(listing.value(count, 0.0))
    if not 0 < size <= _MOST_SERVOS:
        listing.complain(
            (count or name).place, "<generic_servo_number> must say how many there are"
        )
        raise DescriptionError(listing.findings)
    starts = _starts(root, listing)
    servos = {}
    for element in _all(root, "generic_servo"):
        index = int(listing.attribute(element, "id", -1))
        if not 0 <= index < size or index in servos:
            said = f"the ids of the generic servos are 0 to {size - 1}, once each"
            listing.complain(element.place, said)
        else:
            servos[index] = _servo(element, listing, starts, joints)
    _joints_once(servos.values(), listing)
    if listing.findings:
        raise DescriptionError(listing.findings)
    part = name.text.strip()
    held = tuple(_held(starts, servos.values(), joints, name.place))
    absent = _absent(name.place)
    return Part(part, tuple(servos.get(i, absent) for i in range(size)), held=held)


def _joints_once(servos: Iterable[Servo], listing: _Listing) -> None:
    seen: set[str] = set()
    for servo in servos:
        if servo.qualified in seen:
            said = f"the destination servo `{servo.qualified}` is there twice"
            listing.complain(servo.place, said, Fault.TWICE)
        seen.add(servo.qualified)


def _servo(
    element: _Element,
    listing: _Listing,
    starts: dict[int, tuple[str, float]],
    joints: tuple[str, ...],
) -> Servo:
    def value(tag: str, default: float) -> float:
        return listing.value(element.child(tag), default)

    destination = int(value("destination_servo_id", -1))
    if destination < 0 or (joints and destination >= len(joints)):
        listing.complain(element.place, f"there is no destination servo {destination}")
    gamma = value("transform_factor", 1.0)
    if gamma == 0.0:
        listing.complain(element.place, "a transform factor of 0 cannot be turned round")
    limits, part = element.child("limits"), element.child("destination_part")
    low, high = (
        (listing.attribute(limits, key) for key in ("min", "max"))
        if limits
        else (-math.inf, math.inf)
    )
    if low > high:
        listing.complain(element.place, f"the lower limit {low:g} lies above the upper {high:g}")
    unit, start = starts.get(destination, ("deg", min(max(0.0, low), high)))
    known = joints[destination] if 0 <= destination < len(joints) else str(destination)
    return Servo(
        joint=known,
        part=part.text.strip() if part else "",
        gamma=gamma,
        sigma=value("transform_displacement", 0.0),
        low=low,
        high=high,
        speed=value("speed", 0.0),
        stiffness=value("stiffness", 0.0),
        damping=value("damping", 0.0),
        start=start,
        unit=unit,
        place=element.place,
    )


def _held(
    starts: dict[int, tuple[str, float]],
    servos: Iterable[Servo],
    joints: tuple[str, ...],
    place: Place,
) -> Iterator[Held]:
    """Initial positions of joints that no servo moves: they stay there."""
    parts = {servo.part for servo in servos}
    part = parts.pop() if len(parts) == 1 else ""
    moved = {servo.joint for servo in servos}
    for destination, (unit, start) in sorted(starts.items()):
        known = joints[destination] if 0 <= destination < len(joints) else str(destination)
        if known not in moved:
            yield Held(known, part, start * UNITS.get(unit, 1.0), place)


def _absent(place: Place) -> Servo:
    return Servo("", "", 1.0, 0.0, -math.inf, math.inf, 0.0, 0.0, 0.0, 0.0, place=place)


def _starts(root: _Element, listing: _Listing) -> dict[int, tuple[str, float]]:
    """Unit and initial position by destination servo."""
    starts = {}
    for group in _all(root, "initial_positions"):
        for one in group.children:
            unit = one.attributes.get("type", "deg")
            if unit not in UNITS:
                listing.complain(one.place, f"`{unit}` is no unit: use {', '.join(UNITS)}")
            servo = int(listing.attribute(one, "destination_servo_id", -1))
            starts[servo] = (unit, listing.attribute(one, "pos"))
    return starts


def _all(element: _Element, tag: str) -> Iterator[_Element]:
    """Every element of that tag below `element`, in order."""
    for child in element.children:
        if child.tag == tag:
            yield child
        yield from _all(child, tag)


def _tree(text: str, listing: _Listing) -> _Element:
    """The elements below a root of our own; tags that do not match are complaints."""
    root = _Element("", {}, Place(1, 1))
    stack, end = [root], 0
    for token in _TOKEN.finditer(text):
        stack[-1].text += text[end : token.start()]
        end = token.end()
        closing, tag, attributes, empty = token.groups()
        if not tag:
            continue
        tag = _ALIASES.get(tag, tag)
        place = _place(text, token.start())
        if closing:
            _close(stack, tag, place, listing)
            continue
        given = {key: value for key, _, value in _ATTRIBUTE.findall(attributes)}
        element = _Element(tag, given, place)
        stack[-1].children.append(element)
        if not empty and len(stack) < _DEEPEST:
            stack.append(element)
    for left in stack[1:]:
        listing.complain(left.place, f"<{left.tag}> is never closed")
    if listing.findings:
        raise DescriptionError(listing.findings)
    return root


def _close(stack: list[_Element], tag: str, place: Place, listing: _Listing) -> None:
    if stack[-1].tag == tag:
        stack.pop()
    else:
        listing.complain(place, f"</{tag}> closes nothing: <{stack[-1].tag}> is open here")


def _place(text: str, offset: int) -> Place:
    line = text.count("\n", 0, offset) + 1
    return Place(line, offset - text.rfind("\n", 0, offset))
