"""A body and its world as data for devices and simulators: frames, shapes and devices.

In: plain data, as stored beside a generated component. Out: immutable values. Lengths are mm,
angles rad, in the frame of `axes` (x right, y up, z ahead).
"""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field
from pathlib import Path
from typing import TYPE_CHECKING, Any, Literal, TypeAlias

if TYPE_CHECKING:
    from robocomp_dsl.hardware.description.scene_skin import Skin

Axis: TypeAlias = Literal["x", "y", "z"]
Triple: TypeAlias = tuple[float, float, float]
SettingValue: TypeAlias = Literal["", "body", "joint", "mark"]

ROOT = "root"

JOINTS = ("joint", "prismaticjoint")
"""Kinds of devices that are joints, and on the control board."""


@dataclass(frozen=True, slots=True)
class Motion:
    """Motion of a frame: a hinge (rad) or a slide (mm) along an axis.

    The value of a hinge is its angle about the axis, that of a slide its distance from `offset`.
    `force` (N·m or N), `gear` and `velocity` are those of its motor.
    """

    kind: Literal["hinge", "slide"]
    axis: Axis
    low: float = -math.inf
    high: float = math.inf
    home: float = 0.0
    offset: float = 0.0
    force: float = math.inf
    gear: float = 100.0
    velocity: float = math.inf


@dataclass(frozen=True, slots=True)
class Frame:
    """A frame in its `parent`; initially T(place) · Rx · Ry · Rz of `turn`.

    `drives` marks a mobile base, which moves along x and z and turns about y. With `physics` it is
    subject to forces; `mass` is in kg. A frame from the scene's model file has its kind in
    `model_part` (body, joint or mark) and no pose here; only a body can contain other frames.
    """

    id: str
    parent: str = ROOT
    place: Triple = (0.0, 0.0, 0.0)
    turn: Triple = (0.0, 0.0, 0.0)
    motion: Motion | None = None
    drives: bool = False
    physics: bool = False
    mass: float = 0.0
    model_part: SettingValue = ""


@dataclass(frozen=True, slots=True)
class Box:
    """A box in a frame; `size` is its extent, the last along `normal`. `colour` is `#rrggbb`.

    `texture` is a picture file used instead, repeated every `tile` mm. A `screen` shows images on
    its whole face, initially the texture or the colour.
    """

    id: str
    frame: str
    size: Triple
    place: Triple = (0.0, 0.0, 0.0)
    normal: Triple = (0.0, 0.0, -1.0)
    colour: str = ""
    collide: bool = False
    texture: str = ""
    tile: float = 1000.0
    screen: bool = False


@dataclass(frozen=True, slots=True)
class Mesh:
    """A mesh in a frame, from `file`, scaled along the axes of the file."""

    id: str
    frame: str
    file: str
    place: Triple = (0.0, 0.0, 0.0)
    turn: Triple = (0.0, 0.0, 0.0)
    scale: Triple = (1.0, 1.0, 1.0)
    collide: bool = False


@dataclass(frozen=True, slots=True)
class Device:
    """A device: its kind (the tag), its frame, and its settings."""

    id: str
    kind: str
    frame: str
    settings: Mapping[str, float | int | bool | str] = field(default_factory=dict)


@dataclass(frozen=True, slots=True)
class Model:
    """An MJCF or URDF file on which a scene is based, in the units of MuJoCo.

    `start` has positions of joints (one number, four of a ball, seven of a free body) and `held`
    the commands of motors without a device, by name, where these are not 0. Moving parts have at
    least `boundmass` kg. `couplings` of boards whose n joints share motors have n · n numbers:
    motor angles are `gear` times this matrix, row by row, times joint angles. `pulled` names the
    joints that are moved by motors of tendons. `transmissions`: if a board commands other
    joints than the model has, angles of the model's joints are this matrix times those of the
    board.
    """

    file: Path
    boundmass: float = 0.0
    start: Mapping[str, Sequence[float]] = field(default_factory=dict)
    held: Mapping[str, float] = field(default_factory=dict)
    couplings: Mapping[str, Sequence[float]] = field(default_factory=dict)
    transmissions: Mapping[str, Sequence[float]] = field(default_factory=dict)
    pulled: Mapping[str, str] = field(default_factory=dict)


@dataclass(frozen=True, slots=True)
class Scene:
    """The complete scene. Frames follow their parents; the first is the root."""

    frames: tuple[Frame, ...] = (Frame(ROOT, ""),)
    boxes: tuple[Box, ...] = ()
    meshes: tuple[Mesh, ...] = ()
    devices: tuple[Device, ...] = ()
    model: Model | None = None
    skins: tuple[Skin, ...] = ()

    @classmethod
    def of_data(cls, data: Mapping[str, Any], folder: Path = Path()) -> Scene:
        """The scene in `data`, as `generate.scene` produces it; `folder` holds the model file."""
        model = data.get("model")
        return cls(
            tuple(frame_of_data(entry) for entry in data["frames"]),
            tuple(Box(**_tuples(entry)) for entry in data["boxes"]),
            tuple(Mesh(**_tuples(entry)) for entry in data["meshes"]),
            tuple(Device(**entry) for entry in data["devices"]),
            Model(**model | {"file": folder / model["file"]}) if model else None,
            _skins(data.get("skins", ())),
        )


def frame_of_data(entry: Mapping[str, Any]) -> Frame:
    """The frame in `entry`, as `generate.scene` produces it."""
    motion = entry.get("motion")
    return Frame(**_tuples(entry) | {"motion": Motion(**motion) if motion else None})


def _skins(entries: Sequence[Mapping[str, Any]]) -> tuple[Skin, ...]:
    if not entries:
        return ()
    from robocomp_dsl.hardware.description.scene_skin import Skin  # noqa: PLC0415 - tactile, YAML

    return tuple(Skin.of_data(entry) for entry in entries)


def _tuples(entry: Mapping[str, Any]) -> dict[str, Any]:
    return {k: tuple(v) if isinstance(v, list) else v for k, v in entry.items()}
