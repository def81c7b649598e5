"""An ultrasonic range finder: the Protocol of its drivers."""

from __future__ import annotations

from typing import Protocol

from robocomp_dsl.hardware.kinematics.planar import Pose


class UltrasoundDevice(Protocol):
    """A driver of an ultrasonic range finder."""

    def distance(self) -> float:
        """The distance of the nearest object in its cone, in mm."""

    def mounted(self) -> Pose:
        """Its mounting pose on the robot."""
