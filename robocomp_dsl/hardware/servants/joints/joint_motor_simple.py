"""`JointMotorSimple` over a control board: the same motors as `JointMotor`, one at a time."""

# ruff: noqa: N802  called as in the interface

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

from robocomp_dsl.hardware.servants.joints.joint_motor import JointMotorServant
from robocomp_dsl.hardware.servants.servant import Servant
from robocomp_dsl.runtime import types as rt


class JointMotorSimpleServant(Servant):
    """All motors of the port are on one board; an empty name selects the only motor."""

    FAILURES = JointMotorServant.FAILURES

    def __init__(
        self, interface: rt.Interface, port: str, ids: tuple[str, ...], devices: Mapping[str, Any]
    ) -> None:
        super().__init__(interface, port, ids, devices)
        self._motors = JointMotorServant(interface, port, ids, devices)

    def setPosition(self, name: str, goal: Any) -> None:
        """Send the motor to a position; goals beyond its limits are rejected."""
        self._motors.move([self._named(name)], [goal.position], [goal.maxSpeed])

    def setVelocity(self, name: str, goal: Any) -> None:
        """Move the motor at a velocity; a `maxAcc` of 0 leaves the acceleration unchanged."""
        self._motors.drive([self._named(name)], [goal.velocity], [goal.maxAcc])

    def setZeroPos(self, name: str) -> None:
        """Send the motor home."""
        self._motors.setZeroPos(self._named(name))

    def getMotorParams(self, motor: str) -> Any:
        """Configuration and limits of the motor."""
        return self._motors.getMotorParams(self._named(motor))

    def getMotorState(self, motor: str) -> Any:
        """The current state of the motor."""
        return self._motors.getMotorState(self._named(motor))

    def _named(self, name: str) -> str:
        return self.ids[0] if not name and len(self.ids) == 1 else name
