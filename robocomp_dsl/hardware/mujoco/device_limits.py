"""Settings of devices that can be simulated: what is beyond is brought to the nearest that can.

In: a scene. Out: the same scene with other settings of devices where it must be, and a note on
each. 0 stays where it stands for the usual value.
"""

from __future__ import annotations

import math
from collections.abc import Mapping
from dataclasses import dataclass, replace

from robocomp_dsl.hardware.scene import Device, Scene

Number = float | int


@dataclass(frozen=True, slots=True)
class Limits:
    """The smallest and the largest value; with `usual`, 0 is allowed, too."""

    low: Number
    high: Number
    usual: bool = True

    def nearest(self, value: Number) -> Number:
        """`value`, or the limit that it is beyond."""
        if value == 0 and self.usual:
            return value
        return min(max(value, self.low), self.high)


_NOISE = Limits(0, 1e6)
_RANGE = Limits(0, 10_000_000)  # mm
_ROUND = Limits(0, math.tau)
_PIXELS = Limits(1, 4096)
_DIRECTION = Limits(-1e6, 1e6)

_CAMERA = {"width": _PIXELS, "height": _PIXELS, "focal": Limits(1, 1e6), "noise": _NOISE}
_LASER = {"min": _RANGE, "max": _RANGE, "angle": _ROUND}

LIMITS: Mapping[str, Mapping[str, Limits]] = {
    "camera": _CAMERA,
    "rgbd": _CAMERA,
    "laser": _LASER | {"measures": Limits(1, 100_000)},
    "ultrasound": _LASER | {"noise": _NOISE},
    "differentialrobot": {"noise": _NOISE},
    "omnirobot": {"noise": _NOISE},
    "imu": {},
    "touchsensor": dict.fromkeys(("nx", "ny", "nz"), _DIRECTION),
    "gps": {
        "latitude": Limits(-84, 84),
        "longitude": Limits(-180, 180),
        "altitude": Limits(-1e9, 1e9),
        "noise": _NOISE,
    },
    "battery": {
        "capacity": Limits(1e-3, 1e9, usual=False),
        "voltage": Limits(1e-3, 1e6, usual=False),
        "idle": Limits(0, 1e9),
    },
}
"""By kind and setting."""


def fitting(scene: Scene) -> tuple[Scene, list[str]]:
    """A scene whose devices can be simulated, and what was changed."""
    notes: list[str] = []
    devices = tuple(_fit(one, notes) for one in scene.devices)
    return replace(scene, devices=devices), notes


def _fit(device: Device, notes: list[str]) -> Device:
    settings = dict(device.settings)
    for name, limits in LIMITS.get(device.kind, {}).items():
        given = settings.get(name)
        if not isinstance(given, int | float):
            continue
        settings[name] = near = limits.nearest(given)
        if near != given:
            notes.append(f"`{device.id}`: `{name}` is {near:g} here, {given:g} cannot be")
    low, high = settings.get("min"), settings.get("max")
    if isinstance(low, int | float) and isinstance(high, int | float) and low > high > 0:
        settings["min"], settings["max"] = high, low
        notes.append(f"`{device.id}`: `min` is {high:g} and `max` {low:g} here")
    return replace(device, settings=settings)
