"""A room in a small YAML file: walls, boxes and pillars on a floor, and the robot's start pose.

In: the file, lengths in mm and angles in rad, seen from above with x to the right and z ahead.
Out: a `Room`, and from it the `MjSpec` of the empty room. An unknown key, a wrong type or an
invalid length is a `ConfigError` with its line, as in every configuration file.
"""

from __future__ import annotations

import math
from dataclasses import dataclass
from pathlib import Path
from typing import Any, ClassVar

import mujoco

from robocomp_dsl.hardware.kinematics.planar import ORIGIN, Pose
from robocomp_dsl.runtime.parameters import Group, Parameter, ParameterGroup, Schema, load_values
from robocomp_dsl.simulation.scene import axes
from robocomp_dsl.simulation.scene.axes import MM

_FAR = 1e6  # mm: maximum size of a room
_TIME_STEP = 0.002  # s


def _place(name: str, default: float | None = None) -> Parameter:
    return Parameter(name, "float", default, -_FAR, _FAR, "mm")


def _length(name: str, default: float | None = None) -> Parameter:
    return Parameter(name, "float", default, 1, _FAR, "mm")


def _angle(name: str) -> Parameter:
    return Parameter(name, "float", 0.0, -math.tau, math.tau, "rad")


@dataclass(frozen=True, slots=True)
class Wall:
    """A wall along the line from (x1, z1) to (x2, z2)."""

    x1: float
    z1: float
    x2: float
    z2: float
    thickness: float
    height: float


@dataclass(frozen=True, slots=True)
class RoomBox:
    """A box on the floor around (x, z): `width` along x and `depth` along z, turned by `alpha`."""

    name: str
    x: float
    z: float
    width: float
    depth: float
    height: float
    alpha: float


@dataclass(frozen=True, slots=True)
class Pillar:
    """An upright cylinder on the floor around (x, z)."""

    name: str
    x: float
    z: float
    radius: float
    height: float


class _Wall(ParameterGroup):
    SCHEMA: ClassVar[Schema] = (
        _place("x1"),
        _place("z1"),
        _place("x2"),
        _place("z2"),
        _length("thickness", 100.0),
        _length("height", 1000.0),
    )


class _Box(ParameterGroup):
    SCHEMA: ClassVar[Schema] = (
        Parameter("name", "string", ""),
        _place("x"),
        _place("z"),
        _length("width"),
        _length("depth"),
        _length("height", 700.0),
        _angle("alpha"),
    )


class _Pillar(ParameterGroup):
    SCHEMA: ClassVar[Schema] = (
        Parameter("name", "string", ""),
        _place("x"),
        _place("z"),
        _length("radius"),
        _length("height", 1000.0),
    )


class _Start(ParameterGroup):
    SCHEMA: ClassVar[Schema] = (_place("x", 0.0), _place("z", 0.0), _angle("alpha"))


_SCHEMA: Schema = (
    Group("walls", _Wall, high=1000, doc="Along lines, mm."),
    Group("boxes", _Box, high=1000, doc="Furniture with corners."),
    Group("pillars", _Pillar, high=1000, doc="Furniture without corners."),
    Group("start", _Start, single=True, doc="The initial pose of the robot."),
)


@dataclass(frozen=True, slots=True)
class Room:
    """The walls, boxes and pillars of a room, and the robot's start pose."""

    walls: tuple[Wall, ...] = ()
    boxes: tuple[RoomBox, ...] = ()
    pillars: tuple[Pillar, ...] = ()
    start: Pose = ORIGIN

    @classmethod
    def read(cls, path: Path) -> Room:
        """The room in the file at `path`. Raises `ConfigError` with all problems."""
        found = load_values(_SCHEMA, path, ())
        return cls(
            tuple(Wall(**entry) for entry in found["walls"]),
            tuple(RoomBox(**entry) for entry in found["boxes"]),
            tuple(Pillar(**entry) for entry in found["pillars"]),
            Pose(**found["start"]),
        )

    def spec(self) -> Any:
        """The room as an `MjSpec` with a floor, to which devices can be added."""
        spec = mujoco.MjSpec()
        spec.option.timestep = _TIME_STEP
        # wheels must roll, not creep sideways (MuJoCo documentation, "Preventing slip")
        spec.option.cone = mujoco.mjtCone.mjCONE_ELLIPTIC
        spec.option.impratio = 10
        floor = spec.worldbody
        floor.add_geom(name="floor", type=mujoco.mjtGeom.mjGEOM_PLANE, size=[0, 0, 1])
        for i, wall in enumerate(self.walls):
            _add_wall(floor, f"wall {i + 1}", wall)
        for i, box in enumerate(self.boxes):
            _add_box(floor, f"box {i + 1} {box.name}".rstrip(), box)
        for i, pillar in enumerate(self.pillars):
            floor.add_geom(
                name=f"pillar {i + 1} {pillar.name}".rstrip(),
                type=mujoco.mjtGeom.mjGEOM_CYLINDER,
                size=[pillar.radius * MM, pillar.height * MM / 2, 0],
                pos=axes.point(pillar.x, pillar.height / 2, pillar.z),
            )
        return spec


def _add_wall(floor: Any, name: str, wall: Wall) -> None:
    along_x, along_z = wall.x2 - wall.x1, wall.z2 - wall.z1
    # extended by its thickness, so that walls close their common corner
    length = math.hypot(along_x, along_z) + wall.thickness
    middle_x, middle_z = (wall.x1 + wall.x2) / 2, (wall.z1 + wall.z2) / 2
    alpha = math.atan2(along_x, along_z)
    shape = RoomBox("", middle_x, middle_z, wall.thickness, length, wall.height, alpha)
    _add_box(floor, name, shape)


def _add_box(floor: Any, name: str, box: RoomBox) -> None:
    floor.add_geom(
        name=name,
        type=mujoco.mjtGeom.mjGEOM_BOX,
        size=[box.width * MM / 2, box.depth * MM / 2, box.height * MM / 2],
        pos=axes.point(box.x, box.height / 2, box.z),
        quat=axes.heading(box.alpha),
    )
