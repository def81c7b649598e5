"""Which simulated device each kind of a scene becomes: one table.

In: a device of a scene. Out: the part of the world that simulates it.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Mapping
from dataclasses import dataclass
from types import MappingProxyType
from typing import Any

from robocomp_dsl.hardware.camera import CameraSettings
from robocomp_dsl.hardware.errors import SceneError
from robocomp_dsl.hardware.geodesy import Place
from robocomp_dsl.hardware.laser import LaserSettings
from robocomp_dsl.hardware.mobile_base import BaseLimits
from robocomp_dsl.hardware.mujoco.axes import MM
from robocomp_dsl.hardware.mujoco.battery import Battery
from robocomp_dsl.hardware.mujoco.camera import Camera
from robocomp_dsl.hardware.mujoco.cartesian_hand import CartesianHand
from robocomp_dsl.hardware.mujoco.gps import Gps
from robocomp_dsl.hardware.mujoco.imu import Imu, ImuNoise
from robocomp_dsl.hardware.mujoco.laser import Laser, Mount
from robocomp_dsl.hardware.mujoco.mobile_base import MobileBase
from robocomp_dsl.hardware.mujoco.model_touch import ModelTouch
from robocomp_dsl.hardware.mujoco.noise import NoiseLevel
from robocomp_dsl.hardware.mujoco.range_finder import RangeFinder
from robocomp_dsl.hardware.mujoco.scene_joints import JointBoard, driven
from robocomp_dsl.hardware.mujoco.scene_spec import body_name
from robocomp_dsl.hardware.mujoco.screen import Screen
from robocomp_dsl.hardware.mujoco.touch_sensor import TouchSensor, TouchSettings
from robocomp_dsl.hardware.mujoco.ultrasound import Ultrasound
from robocomp_dsl.hardware.scene import ROOT, Device, Frame, Scene


@dataclass(frozen=True, slots=True)
class Site:
    """The frames of a scene, and what all its devices share."""

    frames: Mapping[str, Frame]
    noise: NoiseLevel
    board: JointBoard | None = None

    def carrier(self, frame: str) -> str:
        """The nearest frame from `frame` upwards that moves by itself; else `frame`."""
        at = frame
        while at and at != ROOT:
            one = self.frames[at]
            if one.drives or (one.physics and one.parent == ROOT):
                return at
            at = one.parent
        return frame


def _laser(site: Site, device: Device) -> Laser:
    given = device.settings
    usual = LaserSettings()
    settings = LaserSettings(
        measures=int(given["measures"]) or usual.measures,
        degrees=math.degrees(float(given["angle"])) or usual.degrees,
        min_range=float(given["min"]),
        max_range=float(given["max"]) or usual.max_range,
        noise=float(given.get("noise", 0.0)),
    )
    mount = Mount(body_name(device.frame), 0.0, 0.0, 0.0)
    carrier = body_name(site.carrier(device.frame))
    return Laser(settings, mount, name=device.id, carrier=carrier, level=site.noise)


def _base(site: Site, device: Device) -> MobileBase:
    limits = BaseLimits(sideways=device.kind == "omnirobot")
    noise = float(device.settings["noise"])
    return MobileBase(limits, site.noise, body_name(device.frame), name=device.id, noise=noise)


def _imu(site: Site, device: Device) -> Imu:
    body, noise = body_name(device.frame), _imu_noise(device)
    return Imu(body, name=device.id, noise=noise, level=site.noise)


def _imu_noise(device: Device) -> ImuNoise:
    given = device.settings
    return ImuNoise(float(given.get("noise", 0.0)), float(given.get("gyronoise", 0.0)))


def _touch(site: Site, device: Device) -> TouchSensor:  # noqa: ARG001
    given = device.settings
    settings = TouchSettings(
        (float(given["nx"]), float(given["ny"]), float(given["nz"])),
        float(given.get("min", 0.0)),
        float(given.get("max", math.inf)),
        bumper=given["type"] == "bumper",
    )
    return TouchSensor(settings, body_name(device.frame), name=device.id)


def _camera(site: Site, device: Device) -> Camera:
    given = device.settings
    usual = CameraSettings()
    settings = CameraSettings(
        int(given["width"]) or usual.width,
        int(given["height"]) or usual.height,
        float(given["focal"]) or usual.focal,
        noise=float(given["noise"]),
        depth=device.kind == "rgbd",
    )
    return Camera(settings, body_name(device.frame), site.noise, name=device.id)


def _gps(site: Site, device: Device) -> Gps:
    given = device.settings
    origin = Place(
        float(given["latitude"]), float(given["longitude"]), float(given["altitude"]) * MM
    )
    body, noise = body_name(device.frame), float(given["noise"])
    return Gps(origin, noise, body, site.noise, name=device.id)


def _ultrasound(site: Site, device: Device) -> Ultrasound:
    given = device.settings
    settings = LaserSettings(
        measures=15,
        degrees=math.degrees(float(given["angle"])),
        min_range=float(given["min"]),
        max_range=float(given["max"]),
        noise=float(given["noise"]),
    )
    carrier = body_name(site.carrier(device.frame))
    body = body_name(device.frame)
    return Ultrasound(settings, body, site.noise, name=device.id, carrier=carrier)


def _battery(site: Site, device: Device) -> Battery:  # noqa: ARG001
    given = device.settings
    capacity, voltage = float(given["capacity"]), float(given["voltage"])
    return Battery(capacity, voltage, float(given["idle"]), name=device.id)


def _model_camera(site: Site, device: Device) -> Camera:
    given = device.settings
    settings = CameraSettings(
        int(given["width"]),
        int(given["height"]),
        float(given["focal"]),
        noise=float(given["noise"]),
        depth=device.kind == "model_rgbd",
    )
    named = str(given["camera"])
    return Camera(settings, device.frame, site.noise, name=device.id, given=named)


def _model_imu(site: Site, device: Device) -> Imu:
    at, noise = str(device.settings["site"]), _imu_noise(device)
    return Imu(device.frame, name=device.id, site=at, noise=noise, level=site.noise)


def _model_touch(site: Site, device: Device) -> ModelTouch:  # noqa: ARG001
    return ModelTouch(str(device.settings["sensor"]), name=device.id)


def _model_range(site: Site, device: Device) -> RangeFinder:
    given = device.settings
    farthest, noise = float(given["max"]), float(given["noise"])
    return RangeFinder(str(given["sensor"]), farthest, noise, site.noise, name=device.id)


def _display(site: Site, device: Device) -> Screen:  # noqa: ARG001
    return Screen(name=device.id)


def _cartesian(site: Site, device: Device) -> CartesianHand:
    given, board = device.settings, site.board
    if board is None:
        raise SceneError(f"`{device.id}` stands on no control board")
    joints = tuple(str(given["joints"]).split("\n"))
    return CartesianHand(board, joints, str(given["tip"]), str(given["base"]))


SINGLE: Mapping[str, Callable[[Site, Device], Any]] = {
    "laser": _laser,
    "differentialrobot": _base,
    "omnirobot": _base,
    "imu": _imu,
    "gps": _gps,
    "ultrasound": _ultrasound,
    "battery": _battery,
    "camera": _camera,
    "rgbd": _camera,
    "touchsensor": _touch,
    "display": _display,
    "model_camera": _model_camera,
    "model_rgbd": _model_camera,
    "model_imu": _model_imu,
    "model_touch": _model_touch,
    "model_range": _model_range,
    "cartesian": _cartesian,
}
"""Kinds of devices that are simulated one by one."""


def parts_of(
    scene: Scene, noise: NoiseLevel, kept: Mapping[str, Any] = MappingProxyType({})
) -> dict[str, Any]:
    """The parts by the ids of their devices; all joints have one board between them.

    A part in `kept` is used again, the board only where it has the same joints.
    """
    joints, board = driven(scene), None
    if joints:
        former = kept.get(joints[0].name)
        same = former is not None and former.names == tuple(one.name for one in joints)
        board = former if same else JointBoard(joints, scene.model)
    site = Site({one.id: one for one in scene.frames}, noise, board)
    stays = {id_: one for id_, one in kept.items() if getattr(one, "stands_on", board) is board}
    made = {
        one.id: stays.get(one.id) or SINGLE[one.kind](site, one)
        for one in scene.devices
        if one.kind in SINGLE
    }
    hands = {id_: one for id_, one in made.items() if isinstance(one, CartesianHand)}
    for id_ in hands:  # the board comes before what stands on it
        del made[id_]
    return made | dict.fromkeys((one.name for one in joints), board) | hands
