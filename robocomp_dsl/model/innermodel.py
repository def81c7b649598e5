"""InnerModel, resolved: a tree of nodes with poses.

Lengths are mm, angles rad; x is to the right, y up, z ahead, which is a left-handed frame. A pose
maps a point p of the node to T + Rx(rx)·Ry(ry)·Rz(rz)·p of its parent, each R with the signs of a
right-handed rotation matrix (RoboComp, classes RTMat and Rot3D). Fields have the names and defaults
of the attributes.
"""

from __future__ import annotations

import math
from collections.abc import Iterator
from dataclasses import dataclass
from pathlib import Path

from robocomp_dsl.source import Span


@dataclass(frozen=True, slots=True, eq=False, kw_only=True)
class Node:
    """A node of the tree. `id` is unique; a missing id is generated from the tag."""

    id: str
    tag: str
    span: Span


@dataclass(frozen=True, slots=True, eq=False, kw_only=True)
class Transform(Node):
    """A frame; `translation` and `rotation` are frames with fewer attributes.

    `engine` "bullet" enables physics; `mass` is in kg.
    """

    tx: float = 0.0
    ty: float = 0.0
    tz: float = 0.0
    rx: float = 0.0
    ry: float = 0.0
    rz: float = 0.0
    engine: str = "static"
    mass: float = 0.0
    children: tuple[Node, ...] = ()


@dataclass(frozen=True, slots=True, eq=False, kw_only=True)
class Joint(Transform):
    """A hinge about `axis`: its angle replaces rx, ry or rz.

    It starts at `home`, the target of the command to go to zero; if that is None, at rx, ry or rz.
    `l…` and `h…` are stored but not used.
    """

    axis: str = "z"
    min: float = -math.inf
    max: float = math.inf
    home: float | None = None
    port: int = 0
    lx: float = 0.0
    ly: float = 0.0
    lz: float = 0.0
    hx: float = 0.0
    hy: float = 0.0
    hz: float = 0.0


@dataclass(frozen=True, slots=True, eq=False, kw_only=True)
class PrismaticJoint(Node):
    """A slide along `axis`: it starts at `position` + `offset` mm from its parent.

    `home` is the target of the command to go to zero. Each of `home` and `position` is the default
    of the other; if both are None, 0.
    """

    axis: str = "z"
    min: float = -math.inf
    max: float = math.inf
    position: float | None = None
    offset: float = 0.0
    home: float | None = None
    port: int = 0
    children: tuple[Node, ...] = ()


@dataclass(frozen=True, slots=True, eq=False, kw_only=True)
class Motor(Node):
    """The motor of its parent joint: `force` in N·m (N for a slide) after the `gear`.

    `gear` is the number of turns of the motor per turn of the joint (rad per m of a slide).
    """

    force: float = math.inf
    gear: float = 100.0
    velocity: float = math.inf


@dataclass(frozen=True, slots=True, eq=False, kw_only=True)
class Base(Transform):
    """A `differentialrobot` or an `omnirobot`: a frame that drives on the floor.

    `noise` is the standard deviation of its motion, `collide` whether it is stopped by obstacles.
    """

    port: int = 0
    noise: float = 0.0
    collide: bool = False


@dataclass(frozen=True, slots=True, eq=False, kw_only=True)
class TouchSensor(Node):
    """Senses contact of the shapes in it, along its normal; `min` and `max` bound the value."""

    type: str = "0"
    nx: float = 0.0
    ny: float = 0.0
    nz: float = 0.0
    min: float = -math.inf
    max: float = math.inf
    port: int = 0
    children: tuple[Node, ...] = ()


@dataclass(frozen=True, slots=True, eq=False, kw_only=True)
class Skin(Node):
    """Tactile skin on its parent frame; `children` are its patches, `rate` is in Hz."""

    rate: float = 50.0
    port: int = 0
    children: tuple[Node, ...] = ()


MAX_MODULES = 1000
"""Maximum number of triangle modules per ring; more do not fit around a limb."""


@dataclass(frozen=True, slots=True, eq=False, kw_only=True)
class Patch(Node):
    """Taxels numbered from `firstid`, in the frame of the patch: T(t…) · Rx · Ry · Rz.

    Their surface is a truncated cone about x, from `x0` with radius `r0` to `x1` with `r1`
    (Ma and Dahl 2016, equations 3 and 4), or defined by the taxels. Taxels are given by `count`
    triangle modules around the cone at each x in `rings`, by a `file` of positions, or as
    `children`. A count is `gain` newtons, from `floor` to `saturation` counts.
    """

    tx: float = 0.0
    ty: float = 0.0
    tz: float = 0.0
    rx: float = 0.0
    ry: float = 0.0
    rz: float = 0.0
    x0: float = 0.0
    x1: float = 0.0
    r0: float = 0.0
    r1: float = 0.0
    rings: tuple[float, ...] = ()
    count: int = 0
    file: str = ""
    firstid: int = 0
    gain: float = 1.0
    floor: float = 0.0
    saturation: float = math.inf
    children: tuple[Node, ...] = ()

    @property
    def cone(self) -> bool:
        """Whether the patch has a cone."""
        return any((self.x0, self.x1, self.r0, self.r1))


@dataclass(frozen=True, slots=True, eq=False, kw_only=True)
class Taxel(Node):
    """One sensing point: `x` and `theta` on the cone of its patch, or a point and its normal.

    `theta` (rad, 0 at +z, towards +y) is None for a point.
    """

    x: float = 0.0
    y: float = 0.0
    z: float = 0.0
    nx: float = 0.0
    ny: float = 0.0
    nz: float = 0.0
    theta: float | None = None


@dataclass(frozen=True, slots=True, eq=False, kw_only=True)
class Plane(Node):
    """A box around (px, py, pz): `size` is width, height and thickness, the last along the normal.

    A `display` is a plane that shows images. `texture` is a file or a colour `#rrggbb`.
    """

    texture: str = ""
    repeat: int = 1000
    size: tuple[float, float, float] = (2500.0, 2500.0, 25.0)
    nx: float = 0.0
    ny: float = 0.0
    nz: float = 0.0
    px: float = 0.0
    py: float = 0.0
    pz: float = 0.0
    collide: bool = False
    port: int = 0


@dataclass(frozen=True, slots=True, eq=False, kw_only=True)
class Mesh(Node):
    """A mesh from a file, scaled along its own axes."""

    file: str = ""
    scale: tuple[float, float, float] = (1.0, 1.0, 1.0)
    render: str = "normal"
    tx: float = 0.0
    ty: float = 0.0
    tz: float = 0.0
    rx: float = 0.0
    ry: float = 0.0
    rz: float = 0.0
    collide: bool = False


@dataclass(frozen=True, slots=True, eq=False, kw_only=True)
class Camera(Node):
    """A `camera` or an `rgbd`: image size and focal length in pixels, looking along z."""

    width: int = 0
    height: int = 0
    focal: float = 0.0
    noise: float = 0.0
    port: int = 0
    ifconfig: str = ""


@dataclass(frozen=True, slots=True, eq=False, kw_only=True)
class Laser(Node):
    """A planar range finder that looks along z; `angle` is the width of its scan in rad.

    `noise` is the standard deviation of a distance in mm.
    """

    min: int = 0
    max: int = 0
    angle: float = 0.0
    measures: int = 0
    noise: float = 0.0
    port: int = 0
    ifconfig: str = ""


@dataclass(frozen=True, slots=True, eq=False, kw_only=True)
class Imu(Node):
    """An inertial measurement unit.

    `noise` is the standard deviation of each acceleration in m/s², `gyronoise` that of each rate
    of turning in rad/s.
    """

    noise: float = 0.0
    gyronoise: float = 0.0
    port: int = 0


@dataclass(frozen=True, slots=True, eq=False, kw_only=True)
class Gps(Node):
    """A satellite receiver.

    `latitude`, `longitude` (degrees) and `altitude` (mm) are those of the origin of the world;
    x is east and z north there. `noise` is in mm.
    """

    latitude: float = 0.0
    longitude: float = 0.0
    altitude: float = 0.0
    noise: float = 0.0
    port: int = 0


@dataclass(frozen=True, slots=True, eq=False, kw_only=True)
class Ultrasound(Node):
    """An ultrasonic range finder that looks along z: the nearest object in a fan of `angle` rad."""

    min: int = 20
    max: int = 4000
    angle: float = 0.5
    noise: float = 0.0
    port: int = 0


@dataclass(frozen=True, slots=True, eq=False, kw_only=True)
class Battery(Node):
    """A battery of `capacity` Wh at `voltage` V; `idle` W are drawn at rest."""

    capacity: float = 100.0
    voltage: float = 24.0
    idle: float = 10.0
    port: int = 0


@dataclass(frozen=True, slots=True, eq=False, kw_only=True)
class PointCloud(Node):
    """Points that are set at run time."""


@dataclass(frozen=True, slots=True, eq=False, kw_only=True)
class Axes(Node):
    """Three coloured sticks that show a frame; negative values: `length` and `width`."""

    length: float = 200.0
    width: float = 15.0
    lengthx: float = -1.0
    widthx: float = -1.0
    lengthy: float = -1.0
    widthy: float = -1.0
    lengthz: float = -1.0
    widthz: float = -1.0


@dataclass(frozen=True, slots=True, eq=False)
class InnerModel:
    """One InnerModel file with all included files. `root` is the frame called `root`.

    `has_root`: the file has a root element `<innerModel>`; otherwise the model is empty.
    """

    path: Path
    root: Transform
    has_root: bool = True

    def nodes(self) -> Iterator[tuple[Node, Node | None]]:
        """Every node with its parent, parents first, in order of writing."""
        todo: list[tuple[Node, Node | None]] = [(self.root, None)]
        while todo:
            node, parent = todo.pop()
            yield node, parent
            todo.extend((child, node) for child in reversed(children(node)))


def is_frame(node: Node) -> bool:
    """Whether `node` can have any other nodes as children."""
    return isinstance(node, Transform | PrismaticJoint | TouchSensor)


def children(node: Node) -> tuple[Node, ...]:
    """The child nodes of `node`."""
    nodes: tuple[Node, ...] = getattr(node, "children", ())
    return nodes
