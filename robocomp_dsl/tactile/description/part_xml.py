"""Read the XML format of a generic part (listing 2 of Ma and Dahl, 2016).

In: the text. Out: a `GenericPart` without chain and skin. The printed listing has no root element,
closes `initial_positions` with a misspelt tag and omits servos with dots: all accepted. Extensions:
a root element, `limits` with `min` and `max`, and `destination_part` in a servo. Missing indices
are joints that the robot lacks; joints with an initial position and no servo are fixed there.
"""

from __future__ import annotations

import math
import re
from collections.abc import Iterable, Iterator
from dataclasses import dataclass, field
from pathlib import Path

from robocomp_dsl.finding import Finding, Location, SourceText
from robocomp_dsl.tactile.description.model import FixedJoint, GenericPart, Servo
from robocomp_dsl.tactile.description.yaml_reader import UNITS
from robocomp_dsl.tactile.errors import DescriptionError, Fault

_TOKEN = re.compile(
    r"<!--.*?-->|<\?.*?\?>"
    r"|<(/?)\s*([\w.-]+)((?:\s+[\w.-]+\s*=\s*(?:\"[^\"]*\"|'[^']*'))*)\s*(/?)>",
    re.DOTALL,
)
_ATTRIBUTE = re.compile(r"([\w.-]+)\s*=\s*([\"'])(.*?)\2", re.DOTALL)
_ALIASES = {"initial_postions": "initial_positions"}
_MAX_SERVOS = 1000
_MAX_DEPTH = 20


@dataclass(slots=True)
class _Element:
    tag: str
    attributes: dict[str, str]
    place: Location
    text: str = ""
    children: list[_Element] = field(default_factory=list)

    def child(self, tag: str) -> _Element | None:
        return next((child for child in self.children if child.tag == tag), None)


@dataclass(slots=True)
class _PartXmlReader:
    """One file being read."""

    text: SourceText
    findings: list[Finding] = field(default_factory=list)

    def report(self, place: Location, message: str, fault: Fault = Fault.FORM) -> None:
        self.findings.append(Finding(place, message, kind=fault))

    def value(self, element: _Element | None, default: float) -> float:
        """The number in an element; `default` if there is no element."""
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
        self.report(element.place, f"`{text.strip()}` in <{element.tag}> is not a number")
        return default

    def attribute(self, element: _Element, key: str, default: float = 0.0) -> float:
        """The attribute `key` as a number; `default`, with a finding, if it is missing."""
        if key in element.attributes:
            return self.number(element.attributes[key], element, default)
        self.report(element.place, f"<{element.tag}> has no attribute `{key}`")
        return default


def read_part_xml(text: str, file: Path, joints: tuple[str, ...] = ()) -> GenericPart:
    """The generic part of `text`. `joints` are the names of the destination servos, by id.

    Raises `DescriptionError` with every finding.
    """
    listing = _PartXmlReader(SourceText.of_text(file, text))
    root = _parse_elements(text, listing)
    name = next((descendant for descendant in _descendants(root, "Generic_Robot_Part")), None)
    if name is None:
        listing.report(listing.text.word_at(1, 1), "there is no <Generic_Robot_Part>")
        raise DescriptionError(listing.findings)
    count = next(iter(_descendants(root, "generic_servo_number")), None)
    size = int(listing.value(count, 0.0))
    if not 0 < size <= _MAX_SERVOS:
        listing.report((count or name).place, "<generic_servo_number> must be the number of servos")
        raise DescriptionError(listing.findings)
    starts = _initial_positions(root, listing)
    servos = {}
    for element in _descendants(root, "generic_servo"):
        index = int(listing.attribute(element, "id", -1))
        if not 0 <= index < size or index in servos:
            message = f"the ids of the generic servos must be 0 to {size - 1}, once each"
            listing.report(element.place, message)
        else:
            servos[index] = _servo(element, listing, starts, joints)
    _check_unique_joints(servos.values(), listing)
    if listing.findings:
        raise DescriptionError(listing.findings)
    part = name.text.strip()
    held = tuple(_fixed_joints(starts, servos.values(), joints, name.place))
    absent = _missing_servo(name.place)
    return GenericPart(part, tuple(servos.get(i, absent) for i in range(size)), fixed_joints=held)


def _check_unique_joints(servos: Iterable[Servo], listing: _PartXmlReader) -> None:
    seen: set[str] = set()
    for servo in servos:
        if servo.qualified in seen:
            message = f"the destination servo `{servo.qualified}` is used twice"
            listing.report(servo.place, message, Fault.TWICE)
        seen.add(servo.qualified)


def _servo(
    element: _Element,
    listing: _PartXmlReader,
    starts: dict[int, tuple[str, float]],
    joints: tuple[str, ...],
) -> Servo:
    def value(tag: str, default: float) -> float:
        return listing.value(element.child(tag), default)

    destination = int(value("destination_servo_id", -1))
    if destination < 0 or (joints and destination >= len(joints)):
        listing.report(element.place, f"there is no destination servo {destination}")
    gamma = value("transform_factor", 1.0)
    if gamma == 0.0:
        listing.report(element.place, "a transform factor of 0 cannot be inverted")
    limits, part = element.child("limits"), element.child("destination_part")
    low, high = (
        (listing.attribute(limits, key) for key in ("min", "max"))
        if limits
        else (-math.inf, math.inf)
    )
    if low > high:
        listing.report(element.place, f"the lower limit {low:g} is above the upper limit {high:g}")
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


def _fixed_joints(
    starts: dict[int, tuple[str, float]],
    servos: Iterable[Servo],
    joints: tuple[str, ...],
    place: Location,
) -> Iterator[FixedJoint]:
    """Joints with an initial position that no servo moves: they stay there."""
    parts = {servo.part for servo in servos}
    part = parts.pop() if len(parts) == 1 else ""
    moved = {servo.joint for servo in servos}
    for destination, (unit, start) in sorted(starts.items()):
        known = joints[destination] if 0 <= destination < len(joints) else str(destination)
        if known not in moved:
            yield FixedJoint(known, part, start * UNITS.get(unit, 1.0), place)


def _missing_servo(place: Location) -> Servo:
    return Servo("", "", 1.0, 0.0, -math.inf, math.inf, 0.0, 0.0, 0.0, 0.0, place=place)


def _initial_positions(root: _Element, listing: _PartXmlReader) -> dict[int, tuple[str, float]]:
    """Unit and initial position by destination servo."""
    starts = {}
    for group in _descendants(root, "initial_positions"):
        for child in group.children:
            unit = child.attributes.get("type", "deg")
            if unit not in UNITS:
                listing.report(child.place, f"`{unit}` is not a unit: use {', '.join(UNITS)}")
            servo = int(listing.attribute(child, "destination_servo_id", -1))
            starts[servo] = (unit, listing.attribute(child, "pos"))
    return starts


def _descendants(element: _Element, tag: str) -> Iterator[_Element]:
    """Every element of that tag below `element`, in order."""
    for child in element.children:
        if child.tag == tag:
            yield child
        yield from _descendants(child, tag)


def _parse_elements(text: str, listing: _PartXmlReader) -> _Element:
    """Parse the elements below an artificial root; mismatched tags are findings."""
    root = _Element("", {}, listing.text.word_at(1, 1))
    stack, end = [root], 0
    for token in _TOKEN.finditer(text):
        stack[-1].text += text[end : token.start()]
        end = token.end()
        closing, tag, attributes, empty = token.groups()
        if not tag:
            continue
        tag = _ALIASES.get(tag, tag)
        place = _place(text, token.start(), listing.text)
        if closing:
            _close(stack, tag, place, listing)
            continue
        values = {key: value for key, _, value in _ATTRIBUTE.findall(attributes)}
        element = _Element(tag, values, place)
        stack[-1].children.append(element)
        if not empty and len(stack) < _MAX_DEPTH:
            stack.append(element)
    for unclosed in stack[1:]:
        listing.report(unclosed.place, f"<{unclosed.tag}> is never closed")
    if listing.findings:
        raise DescriptionError(listing.findings)
    return root


def _close(stack: list[_Element], tag: str, place: Location, listing: _PartXmlReader) -> None:
    if stack[-1].tag == tag:
        stack.pop()
    else:
        listing.report(place, f"</{tag}> has no matching start tag: <{stack[-1].tag}> is open here")


def _place(text: str, offset: int, source: SourceText) -> Location:
    line = text.count("\n", 0, offset) + 1
    return source.word_at(line, offset - text.rfind("\n", 0, offset))
