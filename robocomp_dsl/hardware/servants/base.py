"""`GenericBase`, `DifferentialRobot` and `OmniRobot` over a mobile base."""

# ruff: noqa: N802  called as in the interface

from __future__ import annotations

from typing import Any

from robocomp_dsl.hardware.devices.mobile_base import MobileBaseDevice
from robocomp_dsl.hardware.kinematics.planar import ORIGIN, Pose
from robocomp_dsl.hardware.servants.servant import Servant


def base_state_to_message(struct: type[Any], state: Any) -> Any:
    """A `BaseState` as an instance of `struct`."""
    return struct(
        x=state.odometry.x,
        correctedX=state.corrected.x,
        z=state.odometry.z,
        correctedZ=state.corrected.z,
        alpha=state.odometry.alpha,
        correctedAlpha=state.corrected.alpha,
        advVx=getattr(state, "side", 0.0),
        advVz=state.adv,
        rotV=state.rot,
        isMoving=state.moving,
    )


class GenericBaseServant(Servant):
    """The operations that every base supports."""

    @property
    def _base(self) -> MobileBaseDevice:
        found: MobileBaseDevice = self.device()
        return found

    def getBaseState(self) -> Any:
        """The whole state."""
        return base_state_to_message(self.types.TBaseState, self._base.state())

    def getBasePose(self) -> tuple[int, int, float]:
        """The odometry pose alone, in whole millimetres."""
        pose = self._base.state().odometry
        return round(pose.x), round(pose.z), pose.alpha


class _BaseServant(GenericBaseServant):
    """The common operations of both interfaces."""

    def stopBase(self) -> None:
        """Stop as fast as possible."""
        self._base.stop()

    def resetOdometer(self) -> None:
        """Reset the odometry to x = z = alpha = 0."""
        self._base.set_odometry(ORIGIN)

    def setOdometer(self, state: Any) -> None:
        """Set the odometry to the pose in `state`."""
        self._base.set_odometry(Pose(state.x, state.z, state.alpha))

    def setOdometerPose(self, x: int, z: int, alpha: float) -> None:
        """Set the odometry to this pose."""
        self._base.set_odometry(Pose(x, z, alpha))

    def correctOdometer(self, x: int, z: int, alpha: float) -> None:
        """Set the corrected pose."""
        self._base.correct(Pose(x, z, alpha))


class DifferentialRobotServant(_BaseServant):
    """A base that moves ahead and turns."""

    def poll(self) -> list[tuple[Any, ...]]:
        """The state and its time, as the topic's inputs."""
        state = self._base.state()
        return [(base_state_to_message(self.types.TBaseState, state), state.time)]

    def setSpeedBase(self, adv: float, rot: float) -> None:
        """Drive until the next command."""
        self._base.set_speed(0.0, adv, rot)


class OmniRobotServant(_BaseServant):
    """A base that also moves sideways."""

    def setSpeedBase(self, advx: float, advz: float, rot: float) -> None:
        """Drive until the next command."""
        self._base.set_speed(advx, advz, rot)
