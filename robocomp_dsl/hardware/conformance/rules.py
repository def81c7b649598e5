"""Conformance rules of every kind of device, simulated or real: one function per rule.

In: a device and a function that advances time. Out: nothing, or `Violation` with the problem.
`rcgen hardware` writes a test that applies the rules to a new driver and to the simulated device.
"""

from __future__ import annotations

from robocomp_dsl.hardware.conformance import base, joints, pictures, ranges, sensors
from robocomp_dsl.hardware.conformance.rule import ConformanceRule, Violation

__all__ = ["RULES", "ConformanceRule", "Violation"]

RULES: dict[str, tuple[ConformanceRule, ...]] = {
    "laser": ranges.LASER,
    "ultrasound": ranges.ULTRASOUND,
    "differentialrobot": base.BASE,
    "omnirobot": base.BASE,
    "imu": sensors.IMU,
    "gps": sensors.GPS,
    "battery": sensors.BATTERY,
    "touchsensor": sensors.TOUCH,
    "camera": pictures.CAMERA,
    "rgbd": pictures.RGBD,
    "model_camera": pictures.CAMERA,
    "model_rgbd": pictures.RGBD,
    "model_imu": sensors.IMU,
    "model_touch": sensors.TOUCH,
    "model_range": ranges.ULTRASOUND,
    "joint": joints.JOINTS,
    "prismaticjoint": joints.JOINTS,
}
"""The rules of each kind of device, by the tag of InnerModel; `model_…` kinds come from MJCF."""
