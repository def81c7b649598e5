"""An ultrasonic range finder: the Protocol of its drivers."""

from __future__ import annotations

from typing import Protocol

from robocomp_dsl.hardware.kinematics.planar import Pose


class UltrasoundDevice(Protocol):
    """A driver."""

    def distance(self) -> float:
        """The nearest thing in its cone, in mm."""

    def mounted(self) -> Pose:
        """Where it sits on the robot and where it looks."""
