"""Clamps the numbers of a scene to values that can be simulated.

In: a scene. Out: the scene with clamped numbers, and a note on each. 0 is unchanged if it means the
default, and infinity if it means no limit.
"""

from __future__ import annotations

import math
from collections.abc import Mapping
from dataclasses import dataclass, fields, replace
from typing import Any, TypeAlias, TypeVar

from robocomp_dsl.hardware.description.scene import Box, Device, Frame, Mesh, Motion, Scene
from robocomp_dsl.hardware.devices.errors import SceneError

Number = float | int
Value = TypeVar("Value", Frame, Motion, Box, Mesh)


@dataclass(frozen=True, slots=True)
class ValueRange:
    """The range of a value, plus 0 if `zero_allowed` and infinity if `infinity_allowed`."""

    low: Number
    high: Number
    zero_allowed: bool = True
    infinity_allowed: bool = False

    def clamp(self, value: Number) -> Number:
        """`value`, or the bound that it exceeds."""
        if (value == 0 and self.zero_allowed) or (math.isinf(value) and self.infinity_allowed):
            return value
        return min(max(value, self.low), self.high)


_NOISE = ValueRange(0, 1e6)
_RANGE = ValueRange(0, 10_000_000)  # mm
_ROUND = ValueRange(0, math.tau)
_PIXELS = ValueRange(1, 4096)
_FAR = ValueRange(-1e9, 1e9)  # mm
_TURN = ValueRange(-1e4, 1e4)  # rad
_WAY = ValueRange(-1e9, 1e9, infinity_allowed=True)

_CAMERA = {"width": _PIXELS, "height": _PIXELS, "focal": ValueRange(1, 1e6), "noise": _NOISE}
_LASER = {"min": _RANGE, "max": _RANGE, "angle": _ROUND, "noise": _NOISE}

DEVICES: Mapping[str, Mapping[str, ValueRange]] = {
    "camera": _CAMERA,
    "rgbd": _CAMERA,
    "laser": _LASER | {"measures": ValueRange(1, 10_000)},
    "ultrasound": _LASER,
    "differentialrobot": {"noise": _NOISE},
    "omnirobot": {"noise": _NOISE},
    "imu": {"noise": _NOISE, "gyronoise": _NOISE},
    "model_imu": {"noise": _NOISE, "gyronoise": _NOISE},
    "model_range": {"noise": _NOISE},
    "touchsensor": dict.fromkeys(("nx", "ny", "nz"), _FAR),
    "gps": {
        "latitude": ValueRange(-84, 84),
        "longitude": ValueRange(-180, 180),
        "altitude": _FAR,
        "noise": _NOISE,
    },
    "skin": {"rate": ValueRange(1, 1000, zero_allowed=False)},
    "battery": {
        "capacity": ValueRange(1e-3, 1e9, zero_allowed=False),
        "voltage": ValueRange(1e-3, 1e6, zero_allowed=False),
        "idle": ValueRange(0, 1e9),
    },
}
"""The settings by kind."""

SHAPES: Mapping[str, ValueRange] = {
    "place": _FAR,
    "turn": _TURN,
    "normal": _FAR,
    "mass": ValueRange(0, 1e6),
}
"""The fields of frames, boxes and meshes; other limits of their sizes apply when they are built."""

MOTIONS: Mapping[str, ValueRange] = {
    "low": _WAY,
    "high": _WAY,
    "home": _FAR,
    "offset": _FAR,
    "force": ValueRange(1e-3, 1e6, infinity_allowed=True),
    "gear": ValueRange(1e-6, 1e6),
    "velocity": ValueRange(1e-6, 1e6, infinity_allowed=True),
}


@dataclass(frozen=True, slots=True)
class ClampedValue:
    """The value `name` of a node is `near`, because `value` cannot be simulated."""

    id: str
    name: str
    near: Any
    value: Any

    def __str__(self) -> str:
        near, value = _format(self.near), _format(self.value)
        return f"`{self.id}`: `{self.name}` is {near} here, {value} cannot be simulated"


Notes: TypeAlias = list[ClampedValue | str]


def clamp_scene(scene: Scene) -> tuple[Scene, list[str]]:
    """A scene that can be simulated, and notes on the changes."""
    clamped, notes = _clamp(scene)
    return clamped, [str(note) for note in notes]


def require_limits(scene: Scene) -> None:
    """Reject values that cannot be simulated, in changes at run time. Raises `SceneError`."""
    for it in _clamp(scene)[1]:
        if isinstance(it, ClampedValue):
            raise SceneError(
                f"`{it.id}`: `{it.name}` {_format(it.value)} cannot be simulated, "
                f"{_format(it.near)} can"
            )


def _clamp(scene: Scene) -> tuple[Scene, Notes]:
    notes: Notes = []
    clamped = replace(
        scene,
        frames=tuple(_clamp_motion(_clamp_fields(part, notes), notes) for part in scene.frames),
        boxes=tuple(_clamp_fields(part, notes) for part in scene.boxes),
        meshes=tuple(_clamp_fields(part, notes) for part in scene.meshes),
        devices=tuple(_clamp_settings(part, notes) for part in scene.devices),
    )
    return (clamped if notes else scene), notes


def _clamp_fields(
    part: Value,
    notes: Notes,
    limits: Mapping[str, ValueRange] = SHAPES,
    id: str = "",
) -> Value:
    """A part with clamped fields."""
    changed: dict[str, Any] = {}
    for field in fields(part):
        limit, value = limits.get(field.name), getattr(part, field.name)
        if limit is None:
            continue
        near = tuple(map(limit.clamp, value)) if isinstance(value, tuple) else limit.clamp(value)
        if near != value:
            changed[field.name] = near
            notes.append(ClampedValue(id or getattr(part, "id", ""), field.name, near, value))
    return replace(part, **changed) if changed else part


def _clamp_motion(frame: Frame, notes: Notes) -> Frame:
    if frame.motion is None:
        return frame
    motion = _clamp_fields(frame.motion, notes, MOTIONS, frame.id)
    return frame if motion is frame.motion else replace(frame, motion=motion)


def _clamp_settings(device: Device, notes: Notes) -> Device:
    settings = dict(device.settings)
    for name, limits in DEVICES.get(device.kind, {}).items():
        value = settings.get(name)
        if not isinstance(value, int | float):
            continue
        settings[name] = near = limits.clamp(value)
        if near != value:
            notes.append(ClampedValue(device.id, name, near, value))
    low, high = settings.get("min"), settings.get("max")
    if isinstance(low, int | float) and isinstance(high, int | float) and low > high > 0:
        settings["min"], settings["max"] = high, low
        notes.append(f"`{device.id}`: `min` is {high:g} and `max` {low:g} here")
    return replace(device, settings=settings)


def _format(value: Any) -> str:
    return ", ".join(f"{part:g}" for part in (value if isinstance(value, tuple) else (value,)))
