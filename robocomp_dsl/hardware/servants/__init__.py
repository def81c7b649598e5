"""What answers for devices: one class per interface, from the device's values to the wire's.

The table binds interfaces to servants; a servant needs no simulator, a driver of real hardware that
keeps to the Protocol of its device is served by the same.
"""

from __future__ import annotations

from collections.abc import Mapping

from robocomp_dsl.hardware.servants.base import (
    DifferentialRobotServant,
    GenericBaseServant,
    OmniRobotServant,
)
from robocomp_dsl.hardware.servants.battery import BatteryServant
from robocomp_dsl.hardware.servants.camera import CameraServant, RgbdServant
from robocomp_dsl.hardware.servants.cartesian_controller import CartesianControllerServant
from robocomp_dsl.hardware.servants.control_board import ControlBoardServant
from robocomp_dsl.hardware.servants.display import DisplayServant
from robocomp_dsl.hardware.servants.full_pose import FullPoseServant
from robocomp_dsl.hardware.servants.gps import GpsServant
from robocomp_dsl.hardware.servants.head_camera import HeadCameraServant
from robocomp_dsl.hardware.servants.imu import ImuServant
from robocomp_dsl.hardware.servants.inner_model import InnerModelServant
from robocomp_dsl.hardware.servants.joint_motor import JointMotorServant
from robocomp_dsl.hardware.servants.joint_motor_simple import JointMotorSimpleServant
from robocomp_dsl.hardware.servants.laser import LaserServant
from robocomp_dsl.hardware.servants.rgbd import SeenServant
from robocomp_dsl.hardware.servants.servant import Servant
from robocomp_dsl.hardware.servants.simulation import SimulationServant
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
    "RoboCompInnerModelManager::InnerModelManager": InnerModelServant,
    "RoboCompCameraSimple::CameraSimple": CameraServant,
    "RoboCompCameraRGBDSimple::CameraRGBDSimple": RgbdServant,
    "RoboCompCamera::Camera": HeadCameraServant,
    "RoboCompDisplay::Display": DisplayServant,
    "RoboCompRGBD::RGBD": SeenServant,
    "RoboCompGPS::GPS": GpsServant,
    "RoboCompUltrasound::Ultrasound": UltrasoundServant,
    "RoboCompBatteryStatus::BatteryStatus": BatteryServant,
    "RoboCompSimulation::Simulation": SimulationServant,
}
"""The servant of each interface."""
