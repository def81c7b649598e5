"""Cameras, inertial units, touch sensors and range finders of a model file, as devices of a scene.

In: the compiled model. Out: a device for each. A gyroscope and an accelerometer at one site form an
inertial unit, named after the site; a camera whose `output` includes depth is a depth camera; a
range finder with more than one distance is not served.
"""

from __future__ import annotations

from typing import Any

import mujoco
import numpy as np

from robocomp_dsl.hardware.devices.camera import CameraSettings
from robocomp_dsl.simulation.models.model_to_transforms import ModelTransforms
from robocomp_dsl.simulation.scene.axes import MM

Data = dict[str, Any]

_SENSOR = mujoco.mjtSensor
_FORCE, _TURN = int(_SENSOR.mjSENS_ACCELEROMETER), int(_SENSOR.mjSENS_GYRO)
_FARTHEST = 1e6
"""Reading without an object, for a range finder without a cutoff [mm]."""

_DEPTH = mujoco.mjtCamOutBit.mjCAMOUT_DEPTH | mujoco.mjtCamOutBit.mjCAMOUT_DIST


def sensors_of(model: Any, seen: ModelTransforms, taken: set[str]) -> list[Data]:
    """All sensors; their ids are not in `taken`, except that of their own site."""
    cameras = [_camera(model, seen, i, taken) for i in range(model.ncam)]
    units = [_unit(model, seen, site, kinds, taken) for site, kinds in _units(model).items()]
    felt = np.flatnonzero(model.sensor_type == int(_SENSOR.mjSENS_TOUCH))
    touches = [_touch(model, seen, int(i), taken) for i in felt]
    far = np.flatnonzero(model.sensor_type == int(_SENSOR.mjSENS_RANGEFINDER))
    ranges = [_range(model, seen, int(i), taken) for i in far]
    return [*cameras, *units, *touches, *ranges]


def _camera(model: Any, seen: ModelTransforms, i: int, taken: set[str]) -> Data:
    usual = CameraSettings()
    width, height = (int(size) for size in model.cam_resolution[i])
    if width * height <= 1:  # MuJoCo's default
        width, height = usual.width, usual.height
    angle = np.radians(float(model.cam_fovy[i]))
    name = model.camera(i).name
    return {
        "id": _claim(name, "", taken),
        "kind": "model_rgbd" if int(model.cam_output[i]) & int(_DEPTH) else "model_camera",
        "frame": seen.bodies[model.cam_bodyid[i]],
        "settings": {
            "camera": name,
            "width": width,
            "height": height,
            "focal": float(height / 2 / np.tan(angle / 2)),
            "noise": 0.0,
        },
    }


def _units(model: Any) -> dict[int, dict[int, int]]:
    """Sites that have both a gyroscope and an accelerometer, and their sensors by kind."""
    at: dict[int, dict[int, int]] = {}
    for i in range(model.nsensor):
        at.setdefault(int(model.sensor_objid[i]), {})[int(model.sensor_type[i])] = i
    return {site: kinds for site, kinds in at.items() if kinds.keys() >= {_FORCE, _TURN}}


def _unit(
    model: Any, seen: ModelTransforms, site: int, kinds: dict[int, int], taken: set[str]
) -> Data:
    name = model.site(site).name
    settings: Data = {"site": name}
    for key, kind in (("noise", _FORCE), ("gyronoise", _TURN)):
        if spread := float(model.sensor_noise[kinds[kind]]):
            settings[key] = spread
    return {
        "id": _claim(name, seen.sites[site], taken),
        "kind": "model_imu",
        "frame": seen.bodies[model.site_bodyid[site]],
        "settings": settings,
    }


def _touch(model: Any, seen: ModelTransforms, i: int, taken: set[str]) -> Data:
    name, site = model.sensor(i).name, int(model.sensor_objid[i])
    return {
        "id": _claim(name, seen.sites[site], taken),
        "kind": "model_touch",
        "frame": seen.bodies[model.site_bodyid[site]],
        "settings": {"sensor": name},
    }


def _range(model: Any, seen: ModelTransforms, i: int, taken: set[str]) -> Data:
    name, at = model.sensor(i).name, int(model.sensor_objid[i])
    on_site = int(model.sensor_objtype[i]) == int(mujoco.mjtObj.mjOBJ_SITE)
    plain = on_site and int(model.sensor_dim[i]) == 1
    cutoff = float(model.sensor_cutoff[i]) / MM
    body = int(model.site_bodyid[at] if on_site else model.cam_bodyid[at])
    return {
        "id": _claim(name, seen.sites[at] if on_site else "", taken),
        "kind": "model_range" if plain else "manyranges",
        "frame": seen.bodies[body],
        "settings": {
            "sensor": name,
            "max": min(cutoff, _FARTHEST) if cutoff > 0 else _FARTHEST,
            "noise": float(model.sensor_noise[i]) / MM,
        },
    }


def _claim(name: str, own: str, taken: set[str]) -> str:
    """A free id, or the id of the device's own frame."""
    free, number = name, 2
    while free in taken and free != own:
        free, number = f"{name}#{number}", number + 1
    taken.add(free)
    return free
