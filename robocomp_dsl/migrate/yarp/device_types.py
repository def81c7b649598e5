"""What YARP's types of devices are here. In: the type of a device. Out: its role."""

from __future__ import annotations

import re
from enum import Enum


class DeviceRole(Enum):
    """What a device of YARP becomes."""

    MOTORS = "motors"
    """A driver of joints: joints of the world."""
    GROUP = "group"
    """A wrapper, a remapper or a server of joints: a control board."""
    CALIBRATOR = "calibrator"
    CARTESIAN = "cartesian"
    IMU = "imu"
    CAMERA = "camera"
    SERVER = "server"
    """Makes another device available on the network: the simulator has ports."""
    UNKNOWN = "unknown"


_MOTORS = (
    r".*motion_?control|fake_?bot|test_motor|.*controlboard_nwc_.*|remote_controlboard"
    r"|clientcontrolboard|.*_controlboard"
)
_ROLES = (
    (DeviceRole.CALIBRATOR, r".*calibrator.*"),
    (DeviceRole.CARTESIAN, r"cartesian.*server|cartesiancontrollerserver"),
    (DeviceRole.GROUP, r"controlboardwrapper2?|(remote)?controlboardremapper|controlboard_nws_.*"),
    (DeviceRole.MOTORS, _MOTORS),
    (DeviceRole.SERVER, r".*(wrapper2?|_nws_.*|server|remapper|_sensors?_server)"),
    (DeviceRole.IMU, r".*(imu|inertial|xsens).*"),
    (DeviceRole.CAMERA, r".*(grabber|camera|realsense|dragonfly).*"),
)


def role_of(kind: str) -> DeviceRole:
    """The role of a type, whose case does not matter."""
    found = (role for role, names in _ROLES if re.fullmatch(names, kind.lower()))
    return next(found, DeviceRole.UNKNOWN)


def advice_for(kind: str) -> str:
    """What to use instead of a device without counterpart."""
    name = kind.lower()
    for words, text in _ADVICE:
        if re.search(words, name):
            return text
    return "write a component that serves it: `rcgen hardware`"


_ADVICE = (
    ("skin", "describe the skin in YAML: `rcgen simulator WORLD.xml --tactile skin.yaml`"),
    ("strain|force|_ft|ftsensor", "MuJoCo's force and torque sensors are not served yet"),
    ("laser|lidar", "add a `<laser>` to a world in InnerModel"),
    ("battery", "add a `<battery>` to a world in InnerModel"),
    ("mais|multi_?enc|pos$", "the simulated control board measures all joints itself"),
    ("cartesian", "name the end effector in the world, and use `device hand : cartesian`"),
    ("dynamics|estimat", "run it as a `program`, and connect its ports with `connect yarp`"),
)
