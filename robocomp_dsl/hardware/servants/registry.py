"""The table that maps each device interface to its servant class.

A servant needs no simulator: it serves every driver that implements the Protocol of its device.
"""

from __future__ import annotations

from collections.abc import Mapping

from robocomp_dsl.hardware.servants.base import (
    DifferentialRobotServant,
    GenericBaseServant,
    OmniRobotServant,
)
from robocomp_dsl.hardware.servants.battery import BatteryServant
from robocomp_dsl.hardware.servants.cameras.camera import CameraSimpleServant, RgbdSimpleServant
from robocomp_dsl.hardware.servants.cameras.display import DisplayServant
from robocomp_dsl.hardware.servants.cameras.head_camera import HeadCameraServant
from robocomp_dsl.hardware.servants.cameras.rgbd import RgbdServant
from robocomp_dsl.hardware.servants.full_pose import FullPoseServant
from robocomp_dsl.hardware.servants.gps import GpsServant
from robocomp_dsl.hardware.servants.imu import ImuServant
from robocomp_dsl.hardware.servants.joints.cartesian_controller import CartesianControllerServant
from robocomp_dsl.hardware.servants.joints.control_board import ControlBoardServant
from robocomp_dsl.hardware.servants.joints.joint_motor import JointMotorServant
from robocomp_dsl.hardware.servants.joints.joint_motor_simple import JointMotorSimpleServant
from robocomp_dsl.hardware.servants.laser import LaserServant
from robocomp_dsl.hardware.servants.servant import Servant
from robocomp_dsl.hardware.servants.skin import SkinServant
from robocomp_dsl.hardware.servants.touch_sensor import TouchSensorServant
from robocomp_dsl.hardware.servants.ultrasound import UltrasoundServant

__all__ = ["SERVANTS"]

SERVANTS: Mapping[str, type[Servant]] = {
    "RoboCompDifferentialRobot::DifferentialRobot": DifferentialRobotServant,
    "RoboCompOmniRobot::OmniRobot": OmniRobotServant,
    "RoboCompGenericBase::GenericBase": GenericBaseServant,
    "RoboCompFullPoseEstimation::FullPoseEstimation": FullPoseServant,
    "RoboCompLaser::Laser": LaserServant,
    "RoboCompJointMotor::JointMotor": JointMotorServant,
    "RoboCompJointMotorSimple::JointMotorSimple": JointMotorSimpleServant,
    "RoboCompControlBoard::ControlBoard": ControlBoardServant,
    "RoboCompCartesianController::CartesianController": CartesianControllerServant,
    "RoboCompIMU::IMU": ImuServant,
    "RoboCompTouchSensor::TouchSensor": TouchSensorServant,
    "RoboCompSkin::Skin": SkinServant,
    "RoboCompCameraSimple::CameraSimple": CameraSimpleServant,
    "RoboCompCameraRGBDSimple::CameraRGBDSimple": RgbdSimpleServant,
    "RoboCompCamera::Camera": HeadCameraServant,
    "RoboCompDisplay::Display": DisplayServant,
    "RoboCompRGBD::RGBD": RgbdServant,
    "RoboCompGPS::GPS": GpsServant,
    "RoboCompUltrasound::Ultrasound": UltrasoundServant,
    "RoboCompBatteryStatus::BatteryStatus": BatteryServant,
}
"""Interface name to servant class, for devices that simulated and real robots have."""
