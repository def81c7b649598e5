"""URDF as data: links and joints, parents first.

In: the bytes of a file. Out: a `Robot`, and findings on assumptions; `ModelFileError` with all
fatal problems and their lines. Lengths are m, angles rad (ROS wiki, urdf/XML).
"""

from __future__ import annotations

import math
from collections.abc import Iterator
from dataclasses import dataclass, field

from robocomp_dsl.finding import Finding
from robocomp_dsl.hardware.description.findings import ModelFileError
from robocomp_dsl.hardware.formats.urdf_elements import Element, ElementReader, elements

Vector = tuple[float, float, float]
Colour = tuple[float, float, float, float]

ZERO: Vector = (0.0, 0.0, 0.0)
KINDS = ("revolute", "continuous", "prismatic", "fixed", "floating", "planar")
GREY: Colour = (0.7, 0.7, 0.7, 1.0)


@dataclass(frozen=True, slots=True)
class UrdfPose:
    """A position, and roll, pitch, yaw about the fixed axes: Rz(yaw) · Ry(pitch) · Rx(roll)."""

    xyz: Vector = ZERO
    rpy: Vector = ZERO


@dataclass(frozen=True, slots=True)
class UrdfShape:
    """`size`: box (full), cylinder and capsule (radius, length), sphere (radius), mesh (scale)."""

    kind: str
    size: tuple[float, ...]
    pose: UrdfPose
    file: str = ""
    colour: Colour = GREY
    line: int = 0


@dataclass(frozen=True, slots=True)
class UrdfInertia:
    """Mass and the tensor (xx, yy, zz, xy, xz, yz) about the frame of `pose`."""

    mass: float
    tensor: tuple[float, ...]
    pose: UrdfPose


@dataclass(frozen=True, slots=True)
class UrdfLink:
    """A rigid body."""

    name: str
    inertia: UrdfInertia | None
    visuals: tuple[UrdfShape, ...]
    collisions: tuple[UrdfShape, ...]
    line: int


@dataclass(frozen=True, slots=True)
class UrdfJoint:
    """From `parent` to `child`; `leader` and the following fields are those of a mimic joint.

    `effort` and `speed` are the maxima, 0 if the file has none.
    """

    name: str
    kind: str
    parent: str
    child: str
    pose: UrdfPose
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
class UrdfRobot:
    """`links` are ordered from the roots, each with the joint to its parent."""

    name: str
    links: tuple[tuple[UrdfLink, UrdfJoint | None], ...]
    findings: tuple[Finding, ...]


def read_urdf(data: bytes) -> UrdfRobot:
    """The robot in `data`. Raises `ModelFileError`."""
    root = elements(data)
    if root.tag != "robot":
        raise ModelFileError(f"the outermost element is `<{root.tag}>`, not `<robot>`", root.line)
    if any(
        "xacro" in element.tag or "${" in "".join(element.attributes.values())
        for element in root.all()
    ):
        message = "this is a xacro file: expand it first, `xacro robot.urdf.xacro > robot.urdf`"
        raise ModelFileError(message, root.line)
    return _RobotReader(ElementReader(), root).read()


@dataclass(slots=True)
class _RobotReader:
    reader: ElementReader
    root: Element
    links: dict[str, UrdfLink] = field(default_factory=dict)
    above: dict[str, UrdfJoint] = field(default_factory=dict)
    below: dict[str, list[UrdfJoint]] = field(default_factory=dict)

    def read(self) -> UrdfRobot:
        colours = {
            material.get("name"): self._colour(material, {})
            for material in self.root.children("material")
        }
        for material in self.root.children("link"):
            link = self._link(material, colours)
            if link.name in self.links:
                self.reader.error("tree", link.name, "there are two links `{}`", material.line)
            self.links.setdefault(link.name, link)
        names: set[str] = set()
        for material in self.root.children("joint"):
            joint = self._joint(material)
            if joint.name in names:
                self.reader.error("joint", joint.name, "there are two joints `{}`", material.line)
            names.add(joint.name)
            self._hang(joint)
        ordered = tuple(self._ordered())
        for _, hung in ordered:
            if hung and hung.leader and hung.leader not in names:
                message = f"the joint `{{}}` follows `{hung.leader}`, which is not there"
                self.reader.error("joint", hung.name, message, hung.line)
        if self.reader.faults:
            first = self.reader.faults[0]
            raise ModelFileError(first.message, first.location.line, tuple(self.reader.faults))
        return UrdfRobot(self.root.get("name") or "robot", ordered, tuple(self.reader.findings))

    def _hang(self, joint: UrdfJoint) -> None:
        fault = self.reader.error
        for end, name in (("parent", joint.parent), ("child", joint.child)):
            if name not in self.links:
                message = f"the {end} of the joint `{{}}`, `{name}`, is no link"
                fault("tree", joint.name, message, joint.line)
                return
        if joint.child in self.above:
            other = self.above[joint.child].name
            message = f"`{{}}` hangs on two joints, `{other}` and `{joint.name}`"
            fault("tree", joint.child, message, joint.line)
            return
        self.above[joint.child] = joint
        self.below.setdefault(joint.parent, []).append(joint)

    def _ordered(self) -> Iterator[tuple[UrdfLink, UrdfJoint | None]]:
        roots = [name for name in self.links if name not in self.above]
        seen: set[str] = set()
        todo: list[tuple[str, UrdfJoint | None]] = [(name, None) for name in reversed(roots)]
        while todo:
            name, joint = todo.pop()
            seen.add(name)
            yield self.links[name], joint
            todo += [(below.child, below) for below in reversed(self.below.get(name, []))]
        if not self.links:
            self.reader.error("tree", "", "the robot has no links", self.root.line)
        if left := [name for name in self.links if name not in seen]:
            cycle = _find_cycle(left[0], self.above)
            message = "the links form a cycle: " + ", ".join(f"`{n}`" for n in cycle)
            self.reader.error("tree", cycle[0], message, self.above[cycle[0]].line)
        elif len(roots) > 1:
            message = "several links hang on nothing: " + ", ".join(f"`{n}`" for n in roots[:5])
            self.reader.warn("tree", roots[1], message, self.links[roots[1]].line)

    # -- one element --------------------------------------------------------------------------

    def _link(self, element: Element, colours: dict[str, Colour]) -> UrdfLink:
        name = element.get("name")
        if not name:
            self.reader.error("tree", "", "a link has no `name`", element.line)
        inertial = element.child("inertial")
        return UrdfLink(
            name,
            self._inertia(name, inertial) if inertial else None,
            tuple(self._shapes(element, "visual", colours)),
            tuple(self._shapes(element, "collision", colours)),
            element.line,
        )

    def _inertia(self, name: str, element: Element) -> UrdfInertia | None:
        number = self.reader.number
        mass, tensor = element.child("mass"), element.child("inertia")
        kg = number(mass, "value", 0.0) if mass else 0.0
        if kg <= 0:
            self.reader.warn("mass", name, f"`{{}}` weighs {kg:g} kg", element.line)
            return None
        keys = ("ixx", "iyy", "izz", "ixy", "ixz", "iyz")
        numbers = tuple(number(tensor, key, 0.0) for key in keys) if tensor else (0.0,) * 6
        return UrdfInertia(kg, numbers, self._pose(element))

    def _shapes(self, link: Element, tag: str, colours: dict[str, Colour]) -> Iterator[UrdfShape]:
        for element in link.children(tag):
            geometry = element.child("geometry")
            form = next(iter(geometry.content), None) if geometry else None
            if form is None:
                message = f"a `<{tag}>` of `{{}}` has no geometry and is left out"
                self.reader.warn("size", link.get("name"), message, element.line)
                continue
            material = element.child("material")
            colour = self._colour(material, colours) if material else GREY
            size = self._size(form, link.get("name"))
            if size:
                file = form.get("filename")
                yield UrdfShape(form.tag, size, self._pose(element), file, colour, form.line)

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
                message = (
                    f"`{{}}` has a shape `<{form.tag}>`, which is none of URDF's; it is left out"
                )
                self.reader.warn("size", link, message, form.line)
                return ()
        if not all(size) or (form.tag != "mesh" and min(size) < 0):
            message = f"a {form.tag} of `{{}}` has no size and is left out"
            self.reader.warn("size", link, message, form.line)
            return ()
        return size

    def _colour(self, element: Element, known: dict[str, Colour]) -> Colour:
        colour = element.child("color")
        if colour is None:
            return known.get(element.get("name"), GREY)
        red, green, blue, opaque = (
            min(max(part, 0.0), 1.0) for part in self.reader.numbers(colour, "rgba", GREY)
        )
        return red, green, blue, opaque

    def _pose(self, element: Element) -> UrdfPose:
        origin = element.child("origin")
        if origin is None:
            return UrdfPose()
        numbers = self.reader.numbers
        return UrdfPose(_three(numbers(origin, "xyz", ZERO)), _three(numbers(origin, "rpy", ZERO)))

    def _joint(self, element: Element) -> UrdfJoint:
        number, name = self.reader.number, element.get("name")
        kind = element.get("type")
        if kind not in KINDS:
            message = f"the joint `{{}}` is `{kind}`, it must be one of {', '.join(KINDS)}"
            self.reader.error("joint", name, message, element.line)
        empty = Element("", {}, element.line)
        limit, dynamics = element.child("limit") or empty, element.child("dynamics") or empty
        low, high = number(limit, "lower", 0.0), number(limit, "upper", 0.0)
        if kind in {"revolute", "prismatic"} and low >= high:
            message = "the joint `{}` has no range: it is not limited"
            self.reader.warn("joint", name, message, limit.line)
        if kind not in {"revolute", "prismatic"} or low >= high:
            low, high = -math.inf, math.inf
        mimic = element.child("mimic") or empty
        return UrdfJoint(
            name,
            kind,
            (element.child("parent") or empty).get("link"),
            (element.child("child") or empty).get("link"),
            self._pose(element),
            self._axis(element),
            low,
            high,
            number(limit, "effort", 0.0),
            number(limit, "velocity", 0.0),
            number(dynamics, "damping", 0.0),
            number(dynamics, "friction", 0.0),
            mimic.get("joint"),
            number(mimic, "multiplier", 1.0),
            number(mimic, "offset", 0.0),
            element.line,
        )

    def _axis(self, element: Element) -> Vector:
        axis_element = element.child("axis")
        axis = (
            _three(self.reader.numbers(axis_element, "xyz", (1.0, 0.0, 0.0)))
            if axis_element
            else (1.0, 0.0, 0.0)
        )
        if axis_element and not any(axis) and element.get("type") not in {"fixed", "floating"}:
            message = "the axis of the joint `{}` is zero: x is taken"
            self.reader.warn("joint", element.get("name"), message, axis_element.line)
        return axis if any(axis) else (1.0, 0.0, 0.0)


def _three(numbers: tuple[float, ...]) -> Vector:
    x, y, z = numbers
    return x, y, z


def _find_cycle(start: str, above: dict[str, UrdfJoint]) -> list[str]:
    """The links of the cycle above `start`."""
    path: list[str] = []
    while start not in path:
        path.append(start)
        start = above[start].parent
    return path[path.index(start) :]
