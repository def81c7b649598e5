"""Numbers of a scene that can be simulated: what is beyond is brought to the nearest that can.

In: a scene. Out: the same scene with other numbers where it must be, and a note on each. 0 stays
where it stands for the usual value, and what is infinite where it stands for no limit.
"""

from __future__ import annotations

import math
from collections.abc import Mapping
from dataclasses import dataclass, fields, replace
from typing import Any, TypeVar

from robocomp_dsl.hardware.scene import Box, Device, Frame, Mesh, Motion, Scene

Number = float | int
Value = TypeVar("Value", Frame, Motion, Box, Mesh)


@dataclass(frozen=True, slots=True)
class Limits:
    """The smallest and the largest value; 0 is allowed if it is `usual`, infinity if `endless`."""

    low: Number
    high: Number
    usual: bool = True
    endless: bool = False

    def nearest(self, value: Number) -> Number:
        """`value`, or the limit that it is beyond."""
        if (value == 0 and self.usual) or (math.isinf(value) and self.endless):
            return value
        return min(max(value, self.low), self.high)


_NOISE = Limits(0, 1e6)
_RANGE = Limits(0, 10_000_000)  # mm
_ROUND = Limits(0, math.tau)
_PIXELS = Limits(1, 4096)
_FAR = Limits(-1e9, 1e9)  # mm
_TURN = Limits(-1e4, 1e4)  # rad
_WAY = Limits(-1e9, 1e9, endless=True)

_CAMERA = {"width": _PIXELS, "height": _PIXELS, "focal": Limits(1, 1e6), "noise": _NOISE}
_LASER = {"min": _RANGE, "max": _RANGE, "angle": _ROUND, "noise": _NOISE}

DEVICES: Mapping[str, Mapping[str, Limits]] = {
    "camera": _CAMERA,
    "rgbd": _CAMERA,
    "laser": _LASER | {"measures": Limits(1, 10_000)},
    "ultrasound": _LASER,
    "differentialrobot": {"noise": _NOISE},
    "omnirobot": {"noise": _NOISE},
    "imu": {"noise": _NOISE, "gyronoise": _NOISE},
    "model_imu": {"noise": _NOISE, "gyronoise": _NOISE},
    "model_range": {"noise": _NOISE},
    "touchsensor": dict.fromkeys(("nx", "ny", "nz"), _FAR),
    "gps": {
        "latitude": Limits(-84, 84),
        "longitude": Limits(-180, 180),
        "altitude": _FAR,
        "noise": _NOISE,
    },
    "skin": {"rate": Limits(1, 1000, usual=False)},
    "battery": {
        "capacity": Limits(1e-3, 1e9, usual=False),
        "voltage": Limits(1e-3, 1e6, usual=False),
        "idle": Limits(0, 1e9),
    },
}
"""The settings by kind."""

SHAPES: Mapping[str, Limits] = {
    "place": _FAR,
    "turn": _TURN,
    "normal": _FAR,
    "mass": Limits(0, 1e6),
}
"""The fields of frames, boxes and meshes; their sizes have limits where they are built."""

MOTIONS: Mapping[str, Limits] = {
    "low": _WAY,
    "high": _WAY,
    "home": _FAR,
    "offset": _FAR,
    "force": Limits(1e-3, 1e6, endless=True),
    "gear": Limits(1e-6, 1e6),
    "velocity": Limits(1e-6, 1e6, endless=True),
}


def fitting(scene: Scene) -> tuple[Scene, list[str]]:
    """A scene that can be simulated, and what was changed."""
    notes: list[str] = []
    made = Scene(
        tuple(_moving(_shape(one, notes), notes) for one in scene.frames),
        tuple(_shape(one, notes) for one in scene.boxes),
        tuple(_shape(one, notes) for one in scene.meshes),
        tuple(_device(one, notes) for one in scene.devices),
    )
    return (made if notes else scene), notes


def _shape(
    one: Value, notes: list[str], limits: Mapping[str, Limits] = SHAPES, id: str = ""
) -> Value:
    """A part with fields that fit."""
    changed: dict[str, Any] = {}
    for field in fields(one):
        limit, given = limits.get(field.name), getattr(one, field.name)
        if limit is None:
            continue
        near = (
            tuple(map(limit.nearest, given)) if isinstance(given, tuple) else limit.nearest(given)
        )
        if near != given:
            changed[field.name] = near
            notes.append(_said(id or getattr(one, "id", ""), field.name, near, given))
    return replace(one, **changed) if changed else one


def _moving(frame: Frame, notes: list[str]) -> Frame:
    if frame.motion is None:
        return frame
    motion = _shape(frame.motion, notes, MOTIONS, frame.id)
    return frame if motion is frame.motion else replace(frame, motion=motion)


def _device(device: Device, notes: list[str]) -> Device:
    settings = dict(device.settings)
    for name, limits in DEVICES.get(device.kind, {}).items():
        given = settings.get(name)
        if not isinstance(given, int | float):
            continue
        settings[name] = near = limits.nearest(given)
        if near != given:
            notes.append(_said(device.id, name, near, given))
    low, high = settings.get("min"), settings.get("max")
    if isinstance(low, int | float) and isinstance(high, int | float) and low > high > 0:
        settings["min"], settings["max"] = high, low
        notes.append(f"`{device.id}`: `min` is {high:g} and `max` {low:g} here")
    return replace(device, settings=settings)


def _said(id: str, name: str, near: Any, given: Any) -> str:
    return f"`{id}`: `{name}` is {_shown(near)} here, {_shown(given)} cannot be simulated"


def _shown(value: Any) -> str:
    return ", ".join(f"{part:g}" for part in (value if isinstance(value, tuple) else (value,)))
