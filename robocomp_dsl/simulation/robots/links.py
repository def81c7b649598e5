"""A robot as a tree of links: joints, masses, shapes and marked points. Data only.

Frames are those of the zero pose: a link's frame is at its joint; `pose` (4 x 4) is its pose in
the parent's frame.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass, field, replace

import numpy as np
from numpy.typing import NDArray

Floats = NDArray[np.float64]
Vector = tuple[float, float, float]


@dataclass(frozen=True, slots=True)
class Joint:
    """A hinge: axis in the link's frame, limits [rad], maximum speed [rad/s] and torque [N m].

    `leader` is the joint that this one follows with ratio 1: they share a motor.
    """

    name: str
    axis: Vector
    low: float
    high: float
    speed: float
    effort: float
    armature: float = 0.004
    damping: float = 0.05
    leader: str = ""


@dataclass(frozen=True, slots=True)
class Mass:
    """Mass, its centre, and the moments of inertia about that centre along the frame's axes."""

    mass: float
    centre: Vector
    inertia: Vector


@dataclass(frozen=True, eq=False, slots=True)
class Shape:
    """`kind` is box (half sizes), ball (radius) or capsule (radius, half length along z)."""

    kind: str
    size: tuple[float, ...]
    pose: Floats


@dataclass(frozen=True, eq=False, slots=True)
class Link:
    """One rigid body. A root link has no parent and no joint."""

    name: str
    parent: str
    pose: Floats
    mass: Mass
    joint: Joint | None = None
    shapes: tuple[Shape, ...] = ()
    points: dict[str, Floats] = field(default_factory=dict)


@dataclass(frozen=True, eq=False, slots=True)
class RobotModel:
    """Links, parents first.

    `neighbours` are pairs that may overlap and never collide, besides parents and their children;
    `start` are joint angles of a pose without contacts; other joints are 0. `height` is the height
    of the root above the floor, `heading` its rotation about z, so that the robot looks along +x.
    """

    name: str
    links: tuple[Link, ...]
    neighbours: tuple[tuple[str, str], ...]
    start: dict[str, float]
    height: float
    heading: float = 0.0

    @property
    def joints(self) -> dict[str, Joint]:
        """Joints by name, in the order of the links."""
        return {link.joint.name: link.joint for link in self.links if link.joint}

    @property
    def motors(self) -> tuple[Joint, ...]:
        """Joints that have their own motor."""
        return tuple(joint for joint in self.joints.values() if not joint.leader)


def shift(x: float, y: float, z: float) -> Floats:
    """A pose without rotation."""
    pose = np.eye(4)
    pose[:3, 3] = (x, y, z)
    return pose


def turned(pose: Floats, axis: int, angle: float) -> Floats:
    """`pose` rotated by `angle` about its own axis 0, 1 or 2."""
    turn = np.eye(4)
    i, j = (axis + 1) % 3, (axis + 2) % 3
    turn[i, i] = turn[j, j] = np.cos(angle)
    turn[j, i] = np.sin(angle)
    turn[i, j] = -np.sin(angle)
    return pose @ turn


def box(size: Vector, centre: Vector, tilt: float = 0.0) -> Shape:
    """A box of full `size`, rotated by `tilt` about x."""
    return Shape("box", tuple(s / 2 for s in size), turned(shift(*centre), 0, tilt))


def ball(radius: float, centre: Vector) -> Shape:
    """A ball."""
    return Shape("ball", (radius,), shift(*centre))


def capsule(radius: float, start: Vector, end: Vector) -> Shape:
    """A cylinder with round ends; `start` and `end` are the centres of the ends."""
    point, two = np.array(start), np.array(end)
    along = two - point
    length = float(np.linalg.norm(along))
    z = along / length
    x = np.cross(np.eye(3)[int(np.argmin(np.abs(z)))], z)
    x /= np.linalg.norm(x)
    pose = np.eye(4)
    pose[:3, :3] = np.stack((x, np.cross(z, x), z), axis=1)
    pose[:3, 3] = (point + two) / 2
    return Shape("capsule", (radius, length / 2), pose)


def solid_ball(mass: float, radius: float, centre: Vector = (0.0, 0.0, 0.0)) -> Mass:
    """The mass of a solid ball: for links of which only the mass is known."""
    moment = 0.4 * mass * radius**2
    return Mass(mass, centre, (moment, moment, moment))


def solid_box(mass: float, size: Vector, centre: Vector) -> Mass:
    """The mass of a solid box of full `size`."""
    a, b, c = (s * s for s in size)
    return Mass(mass, centre, (mass * (b + c) / 12, mass * (a + c) / 12, mass * (a + b) / 12))


def mirrored(links: tuple[Link, ...], rename: dict[str, str]) -> Iterator[Link]:
    """The links mirrored at the x-z plane, with prefixes from `rename`.

    An axis along y keeps its direction; an axis along x or z is reversed by the limits of its
    joint, as the robots' makers do: the caller passes such limits.
    """
    flip = np.diag([1.0, -1.0, 1.0, 1.0])
    for link in links:
        yield replace(
            link,
            name=_renamed(link.name, rename),
            parent=_renamed(link.parent, rename),
            pose=flip @ link.pose @ flip,
            mass=replace(link.mass, centre=_flipped(link.mass.centre)),
            shapes=tuple(replace(s, pose=flip @ s.pose @ flip) for s in link.shapes),
            points={_renamed(k, rename): flip @ p @ flip for k, p in link.points.items()},
        )


def _flipped(point: Vector) -> Vector:
    return point[0], -point[1], point[2]


def _renamed(name: str, rename: dict[str, str]) -> str:
    for old, new in rename.items():
        if name.startswith(old):
            return new + name.removeprefix(old)
    return name
