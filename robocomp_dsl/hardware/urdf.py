"""URDF as data: links and joints in an order in which parents come first.

In: the bytes of a file. Out: a `Robot`, and findings on what had to be guessed; `ModelFileError`
with all that makes it unusable, each with its line. Lengths are m, angles rad (ROS wiki, urdf/XML).
"""

from __future__ import annotations

import math
from collections.abc import Iterator
from dataclasses import dataclass, field

from robocomp_dsl.hardware.findings import Finding, ModelFileError
from robocomp_dsl.hardware.urdf_elements import Element, Reader, elements

Vector = tuple[float, float, float]
Colour = tuple[float, float, float, float]

ZERO: Vector = (0.0, 0.0, 0.0)
KINDS = ("revolute", "continuous", "prismatic", "fixed", "floating", "planar")
GREY: Colour = (0.7, 0.7, 0.7, 1.0)


@dataclass(frozen=True, slots=True)
class Pose:
    """A place and roll, pitch, yaw about the fixed axes: Rz(yaw) · Ry(pitch) · Rx(roll)."""

    xyz: Vector = ZERO
    rpy: Vector = ZERO


@dataclass(frozen=True, slots=True)
class Shape:
    """`size`: box (full), cylinder and capsule (radius, length), sphere (radius), mesh (scale)."""

    kind: str
    size: tuple[float, ...]
    pose: Pose
    file: str = ""
    colour: Colour = GREY
    line: int = 0


@dataclass(frozen=True, slots=True)
class Inertia:
    """Mass and the tensor (xx, yy, zz, xy, xz, yz) about the frame of `pose`."""

    mass: float
    tensor: tuple[float, ...]
    pose: Pose


@dataclass(frozen=True, slots=True)
class Link:
    """A rigid body."""

    name: str
    inertia: Inertia | None
    visuals: tuple[Shape, ...]
    collisions: tuple[Shape, ...]
    line: int


@dataclass(frozen=True, slots=True)
class Joint:
    """`parent` to `child`; `leader` and what follows it are those of a mimic joint.

    `effort` and `speed` are the largest ones, 0 where none is given.
    """

    name: str
    kind: str
    parent: str
    child: str
    pose: Pose
    axis: Vector
    low: float
    high: float
    effort: float
    speed: float
    damping: float
    friction: float
    leader: str
    factor: float
    offset: float
    line: int


@dataclass(frozen=True, slots=True)
class Robot:
    """`links` has roots before what hangs on them, with the joint to the parent."""

    name: str
    links: tuple[tuple[Link, Joint | None], ...]
    findings: tuple[Finding, ...]


def read_urdf(data: bytes) -> Robot:
    """The robot in `data`. Raises `ModelFileError`."""
    root = elements(data)
    if root.tag != "robot":
        raise ModelFileError(f"the outermost element is `<{root.tag}>`, not `<robot>`", root.line)
    if any("xacro" in one.tag or "${" in "".join(one.attributes.values()) for one in root.all()):
        said = "this is a xacro file: expand it first, `xacro robot.urdf.xacro > robot.urdf`"
        raise ModelFileError(said, root.line)
    return _Robot(Reader(), root).read()


@dataclass(slots=True)
class _Robot:
    reader: Reader
    root: Element
    links: dict[str, Link] = field(default_factory=dict)
    above: dict[str, Joint] = field(default_factory=dict)
    below: dict[str, list[Joint]] = field(default_factory=dict)

    def read(self) -> Robot:
        colours = {one.get("name"): self._colour(one, {}) for one in self.root.children("material")}
        for one in self.root.children("link"):
            link = self._link(one, colours)
            if link.name in self.links:
                self.reader.fault("tree", link.name, "there are two links `{}`", one.line)
            self.links.setdefault(link.name, link)
        names: set[str] = set()
        for one in self.root.children("joint"):
            joint = self._joint(one)
            if joint.name in names:
                self.reader.fault("joint", joint.name, "there are two joints `{}`", one.line)
            names.add(joint.name)
            self._hang(joint)
        ordered = tuple(self._ordered())
        for _, hung in ordered:
            if hung and hung.leader and hung.leader not in names:
                said = f"the joint `{{}}` follows `{hung.leader}`, which is not there"
                self.reader.fault("joint", hung.name, said, hung.line)
        if self.reader.faults:
            first = self.reader.faults[0]
            raise ModelFileError(first.said, first.line, tuple(self.reader.faults))
        return Robot(self.root.get("name") or "robot", ordered, tuple(self.reader.findings))

    def _hang(self, joint: Joint) -> None:
        fault = self.reader.fault
        for end, name in (("parent", joint.parent), ("child", joint.child)):
            if name not in self.links:
                said = f"the {end} of the joint `{{}}`, `{name}`, is no link"
                fault("tree", joint.name, said, joint.line)
                return
        if joint.child in self.above:
            other = self.above[joint.child].name
            said = f"`{{}}` hangs on two joints, `{other}` and `{joint.name}`"
            fault("tree", joint.child, said, joint.line)
            return
        self.above[joint.child] = joint
        self.below.setdefault(joint.parent, []).append(joint)

    def _ordered(self) -> Iterator[tuple[Link, Joint | None]]:
        roots = [name for name in self.links if name not in self.above]
        seen: set[str] = set()
        todo: list[tuple[str, Joint | None]] = [(name, None) for name in reversed(roots)]
        while todo:
            name, joint = todo.pop()
            seen.add(name)
            yield self.links[name], joint
            todo += [(one.child, one) for one in reversed(self.below.get(name, []))]
        if not self.links:
            self.reader.fault("tree", "", "the robot has no links", self.root.line)
        if left := [name for name in self.links if name not in seen]:
            circle = _circle(left[0], self.above)
            said = "links hang on each other in a circle: " + ", ".join(f"`{n}`" for n in circle)
            self.reader.fault("tree", circle[0], said, self.above[circle[0]].line)
        elif len(roots) > 1:
            said = "several links hang on nothing: " + ", ".join(f"`{n}`" for n in roots[:5])
            self.reader.found("tree", roots[1], said, self.links[roots[1]].line)

    # -- one element --------------------------------------------------------------------------

    def _link(self, one: Element, colours: dict[str, Colour]) -> Link:
        name = one.get("name")
        if not name:
            self.reader.fault("tree", "", "a link has no `name`", one.line)
        inertial = one.child("inertial")
        return Link(
            name,
            self._inertia(name, inertial) if inertial else None,
            tuple(self._shapes(one, "visual", colours)),
            tuple(self._shapes(one, "collision", colours)),
            one.line,
        )

    def _inertia(self, name: str, one: Element) -> Inertia | None:
        number = self.reader.number
        mass, tensor = one.child("mass"), one.child("inertia")
        kg = number(mass, "value", 0.0) if mass else 0.0
        if kg <= 0:
            self.reader.found("mass", name, f"`{{}}` weighs {kg:g} kg", one.line)
            return None
        keys = ("ixx", "iyy", "izz", "ixy", "ixz", "iyz")
        numbers = tuple(number(tensor, key, 0.0) for key in keys) if tensor else (0.0,) * 6
        return Inertia(kg, numbers, self._pose(one))

    def _shapes(self, link: Element, tag: str, colours: dict[str, Colour]) -> Iterator[Shape]:
        for one in link.children(tag):
            geometry = one.child("geometry")
            form = next(iter(geometry.inside), None) if geometry else None
            if form is None:
                said = f"a `<{tag}>` of `{{}}` has no geometry and is left out"
                self.reader.found("size", link.get("name"), said, one.line)
                continue
            material = one.child("material")
            colour = self._colour(material, colours) if material else GREY
            size = self._size(form, link.get("name"))
            if size:
                file = form.get("filename")
                yield Shape(form.tag, size, self._pose(one), file, colour, form.line)

    def _size(self, form: Element, link: str) -> tuple[float, ...]:
        number, numbers = self.reader.number, self.reader.numbers
        match form.tag:
            case "box":
                size = numbers(form, "size", ZERO)
            case "cylinder" | "capsule":
                size = (number(form, "radius", 0.0), number(form, "length", 0.0))
            case "sphere":
                size = (number(form, "radius", 0.0),)
            case "mesh":
                size = numbers(form, "scale", (1.0, 1.0, 1.0))
            case _:
                said = f"`{{}}` has a shape `<{form.tag}>`, which is none of URDF's; it is left out"
                self.reader.found("size", link, said, form.line)
                return ()
        if not all(size) or (form.tag != "mesh" and min(size) < 0):
            said = f"a {form.tag} of `{{}}` has no size and is left out"
            self.reader.found("size", link, said, form.line)
            return ()
        return size

    def _colour(self, one: Element, known: dict[str, Colour]) -> Colour:
        told = one.child("color")
        if told is None:
            return known.get(one.get("name"), GREY)
        red, green, blue, opaque = (
            min(max(part, 0.0), 1.0) for part in self.reader.numbers(told, "rgba", GREY)
        )
        return red, green, blue, opaque

    def _pose(self, one: Element) -> Pose:
        origin = one.child("origin")
        if origin is None:
            return Pose()
        numbers = self.reader.numbers
        return Pose(_three(numbers(origin, "xyz", ZERO)), _three(numbers(origin, "rpy", ZERO)))

    def _joint(self, one: Element) -> Joint:
        number, name = self.reader.number, one.get("name")
        kind = one.get("type")
        if kind not in KINDS:
            said = f"the joint `{{}}` is `{kind}`, it must be one of {', '.join(KINDS)}"
            self.reader.fault("joint", name, said, one.line)
        empty = Element("", {}, one.line)
        limit, dynamics = one.child("limit") or empty, one.child("dynamics") or empty
        low, high = number(limit, "lower", 0.0), number(limit, "upper", 0.0)
        if kind in {"revolute", "prismatic"} and low >= high:
            said = "the joint `{}` has no range: it is not limited"
            self.reader.found("joint", name, said, limit.line)
        if kind not in {"revolute", "prismatic"} or low >= high:
            low, high = -math.inf, math.inf
        mimic = one.child("mimic") or empty
        return Joint(
            name,
            kind,
            (one.child("parent") or empty).get("link"),
            (one.child("child") or empty).get("link"),
            self._pose(one),
            self._axis(one),
            low,
            high,
            number(limit, "effort", 0.0),
            number(limit, "velocity", 0.0),
            number(dynamics, "damping", 0.0),
            number(dynamics, "friction", 0.0),
            mimic.get("joint"),
            number(mimic, "multiplier", 1.0),
            number(mimic, "offset", 0.0),
            one.line,
        )

    def _axis(self, one: Element) -> Vector:
        told = one.child("axis")
        axis = (
            _three(self.reader.numbers(told, "xyz", (1.0, 0.0, 0.0))) if told else (1.0, 0.0, 0.0)
        )
        if told and not any(axis) and one.get("type") not in {"fixed", "floating"}:
            said = "the axis of the joint `{}` is zero: x is taken"
            self.reader.found("joint", one.get("name"), said, told.line)
        return axis if any(axis) else (1.0, 0.0, 0.0)


def _three(numbers: tuple[float, ...]) -> Vector:
    x, y, z = numbers
    return x, y, z


def _circle(start: str, above: dict[str, Joint]) -> list[str]:
    """The links of the circle above `start`, which hangs on one."""
    path: list[str] = []
    while start not in path:
        path.append(start)
        start = above[start].parent
    return path[path.index(start) :]
