"""Table of the simulated device for each kind of a scene.

In: a device of a scene. Out: the part of the world that simulates it.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Mapping
from dataclasses import dataclass, replace
from types import MappingProxyType
from typing import Any

from robocomp_dsl.hardware.description.falling import carrier
from robocomp_dsl.hardware.description.scene import ROOT, Device, Frame, Scene
from robocomp_dsl.hardware.description.scene_edit import FIXED
from robocomp_dsl.hardware.devices.camera import CameraSettings
from robocomp_dsl.hardware.devices.errors import SceneError
from robocomp_dsl.hardware.devices.laser import LaserSettings
from robocomp_dsl.hardware.devices.mobile_base import BaseLimits
from robocomp_dsl.hardware.kinematics.geodesy import GeoPoint
from robocomp_dsl.simulation.devices.battery import Battery
from robocomp_dsl.simulation.devices.camera import Camera
from robocomp_dsl.simulation.devices.cartesian_end_effector import CartesianEndEffector
from robocomp_dsl.simulation.devices.gps import Gps
from robocomp_dsl.simulation.devices.imu import Imu, ImuNoise
from robocomp_dsl.simulation.devices.laser import Laser, LaserMount
from robocomp_dsl.simulation.devices.mobile_base import MobileBase
from robocomp_dsl.simulation.devices.range_finder import RangeFinder
from robocomp_dsl.simulation.devices.screen import Screen
from robocomp_dsl.simulation.devices.touch_sensor import TouchSensor, TouchSettings, feels
from robocomp_dsl.simulation.devices.ultrasound import Ultrasound
from robocomp_dsl.simulation.models.model_touch import ModelTouch
from robocomp_dsl.simulation.scene.axes import MM
from robocomp_dsl.simulation.scene.scene_joints import JointBoard, driven
from robocomp_dsl.simulation.scene.scene_spec import body_name
from robocomp_dsl.simulation.world.noise import NoiseLevel


@dataclass(frozen=True, slots=True)
class DeviceContext:
    """Shared by the devices of a scene: its frames, the noise level and the board."""

    frames: Mapping[str, Frame]
    noise: NoiseLevel
    board: JointBoard | None = None

    def carrier(self, frame: str) -> str:
        """The nearest base or falling frame from `frame` upwards; else `frame`.

        The room is not a carrier: it is the root.
        """
        found = frame if frame == ROOT else carrier(frame, self.frames)
        return ROOT if found in FIXED else found


def _laser(site: DeviceContext, device: Device) -> Laser:
    values = device.settings
    usual = LaserSettings()
    settings = LaserSettings(
        measures=int(values["measures"]) or usual.measures,
        degrees=math.degrees(float(values["angle"])) or usual.degrees,
        min_range=float(values["min"]),
        max_range=float(values["max"]) or usual.max_range,
        noise=float(values.get("noise", 0.0)),
    )
    mount = LaserMount(body_name(device.frame), 0.0, 0.0, 0.0)
    carrier = body_name(site.carrier(device.frame))
    return Laser(settings, mount, name=device.id, carrier=carrier, level=site.noise)


def _base(site: DeviceContext, device: Device) -> MobileBase:
    limits = BaseLimits(sideways=device.kind == "omnirobot")
    noise = float(device.settings["noise"])
    return MobileBase(limits, site.noise, body_name(device.frame), name=device.id, noise=noise)


def _imu(site: DeviceContext, device: Device) -> Imu:
    body, noise = body_name(device.frame), _imu_noise(device)
    return Imu(body, name=device.id, noise=noise, level=site.noise)


def _imu_noise(device: Device) -> ImuNoise:
    settings = device.settings
    return ImuNoise(float(settings.get("noise", 0.0)), float(settings.get("gyronoise", 0.0)))


def _touch(site: DeviceContext, device: Device) -> TouchSensor:  # noqa: ARG001
    values = device.settings
    settings = TouchSettings(
        (float(values["nx"]), float(values["ny"]), float(values["nz"])),
        float(values.get("min", 0.0)),
        float(values.get("max", math.inf)),
        bumper=values["type"] == "bumper",
    )
    return TouchSensor(settings, body_name(device.frame), name=device.id)


def _camera(site: DeviceContext, device: Device) -> Camera:
    values = device.settings
    usual = CameraSettings()
    settings = CameraSettings(
        int(values["width"]) or usual.width,
        int(values["height"]) or usual.height,
        float(values["focal"]) or usual.focal,
        noise=float(values["noise"]),
        depth=device.kind == "rgbd",
    )
    return Camera(settings, body_name(device.frame), site.noise, name=device.id)


def _gps(site: DeviceContext, device: Device) -> Gps:
    settings = device.settings
    origin = GeoPoint(
        float(settings["latitude"]), float(settings["longitude"]), float(settings["altitude"]) * MM
    )
    body, noise = body_name(device.frame), float(settings["noise"])
    return Gps(origin, noise, body, site.noise, name=device.id)


def _ultrasound(site: DeviceContext, device: Device) -> Ultrasound:
    values = device.settings
    settings = LaserSettings(
        measures=15,
        degrees=math.degrees(float(values["angle"])),
        min_range=float(values["min"]),
        max_range=float(values["max"]),
        noise=float(values["noise"]),
    )
    carrier = body_name(site.carrier(device.frame))
    body = body_name(device.frame)
    return Ultrasound(settings, body, site.noise, name=device.id, carrier=carrier)


def _battery(site: DeviceContext, device: Device) -> Battery:  # noqa: ARG001
    settings = device.settings
    capacity, voltage = float(settings["capacity"]), float(settings["voltage"])
    return Battery(capacity, voltage, float(settings["idle"]), name=device.id)


def _model_camera(site: DeviceContext, device: Device) -> Camera:
    values = device.settings
    settings = CameraSettings(
        int(values["width"]),
        int(values["height"]),
        float(values["focal"]),
        noise=float(values["noise"]),
        depth=device.kind == "model_rgbd",
    )
    named = str(values["camera"])
    return Camera(settings, device.frame, site.noise, name=device.id, model_camera=named)


def _model_imu(site: DeviceContext, device: Device) -> Imu:
    at, noise = str(device.settings["site"]), _imu_noise(device)
    return Imu(device.frame, name=device.id, site=at, noise=noise, level=site.noise)


def _model_touch(site: DeviceContext, device: Device) -> ModelTouch:  # noqa: ARG001
    return ModelTouch(str(device.settings["sensor"]), name=device.id)


def _model_range(site: DeviceContext, device: Device) -> RangeFinder:
    settings = device.settings
    farthest, noise = float(settings["max"]), float(settings["noise"])
    return RangeFinder(str(settings["sensor"]), farthest, noise, site.noise, name=device.id)


def _display(site: DeviceContext, device: Device) -> Screen:  # noqa: ARG001
    return Screen(name=device.id)


def _cartesian(site: DeviceContext, device: Device) -> CartesianEndEffector:
    settings, board = device.settings, site.board
    if board is None:
        raise SceneError(f"`{device.id}` is attached to no control board")
    joints = tuple(str(settings["joints"]).split("\n"))
    return CartesianEndEffector(board, joints, str(settings["tip"]), str(settings["base"]))


SINGLE: Mapping[str, Callable[[DeviceContext, Device], Any]] = {
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


def without_blind_sensors(scene: Scene, spec: Any, notes: list[str]) -> Scene:
    """The scene without touch sensors that could never feel anything.

    Their shapes are meshes that cannot be read: those touch nothing.
    """
    blind = [
        device
        for device in scene.devices
        if device.kind == "touchsensor" and not feels(spec, body_name(device.frame))
    ]
    feeling = tuple(device for device in scene.devices if device not in blind)
    notes += [f"`{device.id}` is left out: no shape in it collides" for device in blind]
    return replace(scene, devices=feeling) if blind else scene


def place_cameras(scene: Scene, spec: Any) -> None:
    """Add the cameras of a scene to its specification, for a viewer: they take no pictures."""
    site = DeviceContext({frame.id: frame for frame in scene.frames}, NoiseLevel())
    for device in scene.devices:
        if device.kind in {"camera", "rgbd"}:
            _camera(site, device).place(spec)


def unmoved(before: Scene, after: Scene, devices: Mapping[str, Any]) -> dict[str, Any]:
    """The parts of the world that fit another scene: not those that are mounted elsewhere there."""
    known, now = _mounts(before), _mounts(after)
    return {id_: part for id_, part in devices.items() if known.get(id_) == now.get(id_)}


def _mounts(scene: Scene) -> dict[str, tuple[Device, str]]:
    """Each device that is simulated by itself, and the frame that carries it."""
    site = DeviceContext({frame.id: frame for frame in scene.frames}, NoiseLevel())
    return {
        device.id: (device, site.carrier(device.frame))
        for device in scene.devices
        if device.kind in SINGLE
    }


def build_devices(
    scene: Scene, noise: NoiseLevel, existing: Mapping[str, Any] = MappingProxyType({})
) -> dict[str, Any]:
    """The parts by the ids of their devices; all joints share one board.

    A part in `kept` is reused, the board only if it has the same joints.
    """
    joints, board = driven(scene), None
    if joints:
        former = existing.get(joints[0].name)
        same = former is not None and former.names == tuple(device.name for device in joints)
        board = former if same else JointBoard(joints, scene.model)
    site = DeviceContext({device.id: device for device in scene.frames}, noise, board)
    stays = {
        id_: device
        for id_, device in existing.items()
        if getattr(device, "joint_board", board) is board
    }
    devices = {
        device.id: stays.get(device.id) or SINGLE[device.kind](site, device)
        for device in scene.devices
        if device.kind in SINGLE
    }
    hands = {
        id_: device for id_, device in devices.items() if isinstance(device, CartesianEndEffector)
    }
    for id_ in hands:  # the board is built before the devices attached to it
        del devices[id_]
    return devices | dict.fromkeys((device.name for device in joints), board) | hands
