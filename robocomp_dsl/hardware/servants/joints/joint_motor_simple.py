"""`JointMotorSimple` over a control board: the same motors as `JointMotor`, one at a time."""

# ruff: noqa: N802  called as in the interface

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

from robocomp_dsl.hardware.servants.joints.joint_motor import JointMotorServant
from robocomp_dsl.hardware.servants.servant import Servant
from robocomp_dsl.runtime import types as rt


class JointMotorSimpleServant(Servant):
    """All motors of the port are on one board; an empty name is the only one there is."""

    FAILURES = JointMotorServant.FAILURES

    def __init__(
        self, interface: rt.Interface, port: str, ids: tuple[str, ...], devices: Mapping[str, Any]
    ) -> None:
        super().__init__(interface, port, ids, devices)
        self._motors = JointMotorServant(interface, port, ids, devices)

    def setPosition(self, name: str, goal: Any) -> None:
        """Send the motor to a position; beyond its limits is refused."""
        self._motors.move([self._named(name)], [goal.position], [goal.maxSpeed])

    def setVelocity(self, name: str, goal: Any) -> None:
        """Turn the motor; a `maxAcc` of 0 leaves the acceleration as it is."""
        self._motors.drive([self._named(name)], [goal.velocity], [goal.maxAcc])

    def setZeroPos(self, name: str) -> None:
        """Send the motor home."""
        self._motors.setZeroPos(self._named(name))

    def getMotorParams(self, motor: str) -> Any:
        """How the motor is built and limited."""
        return self._motors.getMotorParams(self._named(motor))

    def getMotorState(self, motor: str) -> Any:
        """What the motor does now."""
        return self._motors.getMotorState(self._named(motor))

    def _named(self, name: str) -> str:
        return self.ids[0] if not name and len(self.ids) == 1 else name
