"""`CartesianController` over an end effector: positions in m, rotations as axis and angle."""

# ruff: noqa: N802  called as in the interface

from __future__ import annotations

import math
from collections.abc import Sequence
from typing import Any, ClassVar

import numpy as np
from numpy.typing import NDArray

from robocomp_dsl.hardware.devices.errors import CommandRefused, HardwareError, require_finite
from robocomp_dsl.hardware.kinematics.cartesian_controller import (
    CartesianController,
    CartesianState,
    UnreachableGoal,
)
from robocomp_dsl.hardware.kinematics.cartesian_line import rotation_about
from robocomp_dsl.hardware.kinematics.rotations import Matrix
from robocomp_dsl.hardware.servants.servant import Servant
from robocomp_dsl.tactile.arm.inverse import Solution, rotation_vector

_STATES = tuple(CartesianState)  # in the order of the interface
_MM = 1e-3


class CartesianControllerServant(Servant):
    """One end effector."""

    FAILURES: ClassVar[tuple[tuple[type[HardwareError], str], ...]] = (
        (UnreachableGoal, "Unreachable"),
        (HardwareError, "CartesianRefused"),
    )

    @property
    def _led(self) -> CartesianController:
        found: CartesianController = self.device().controller
        return found

    def getJoints(self) -> list[str]:
        """The joints of the chain."""
        return list(self._led.joints)

    def getPose(self) -> Any:
        """The pose of the end effector."""
        return self._pose_to_message(self.device().pose())

    def getState(self) -> Any:
        """The pose of the end effector, and the state of the controller."""
        return self.types.HandState(
            time=self.device().joint_board.board.time,
            pose=self.getPose(),
            motion=self.types.MotionState(_STATES.index(self._led.state)),
        )

    # -- motion -------------------------------------------------------------------------------

    def goToPose(self, pose: Any, seconds: float) -> Any:
        """Move the end effector to a pose."""
        return self._solution(self._led.go_to(self._goal(_matrix(pose)), seconds or None))

    def goToPosition(self, place: Any, seconds: float) -> Any:
        """Move the end effector to a position."""
        return self._solution(self._led.go_to(self._goal(_point(place)), seconds or None))

    def getDesired(self) -> Any:
        """The solution for the last goal."""
        found = self._led.desired
        if found is None or len(found.q) != np.count_nonzero(self._led.free):
            raise CommandRefused("no goal has been set since the free joints were changed")
        return self._solution(found)

    def checkMotionDone(self) -> bool:
        """Whether no motion is in progress."""
        return self._led.state is not CartesianState.MOVING

    def stopControl(self) -> None:
        """Stop the end effector."""
        self._led.stop()

    def askForPose(self, pose: Any) -> Any:
        """Solve for a pose."""
        return self._solution(self._led.solve(self._goal(_matrix(pose))))

    def askForPosition(self, place: Any) -> Any:
        """Solve for a position."""
        return self._solution(self._led.solve(self._goal(_point(place))))

    # -- settings -----------------------------------------------------------------------------

    def setTrajTime(self, seconds: float) -> None:
        """Set the default duration of a motion."""
        self._led.seconds = _positive(seconds=seconds)

    def getTrajTime(self) -> float:
        """The default duration of a motion."""
        return self._led.seconds

    def setInTargetTol(self, distance: float, angle: float) -> None:
        """Set the tolerance of a goal."""
        far, turned = _positive(distance=distance) / _MM, _positive(angle=angle)
        self._led.distance, self._led.angle = far, turned

    def getInTargetTol(self) -> tuple[float, float]:
        """The tolerance of a goal."""
        return self._led.distance * _MM, self._led.angle

    def setTrackingMode(self, on: bool) -> None:
        """Set whether the end effector tracks its goal after arrival."""
        self._led.tracking = on

    def getTrackingMode(self) -> bool:
        """Whether the end effector tracks its goal after arrival."""
        return self._led.tracking

    def setDOF(self, free: Sequence[bool]) -> None:
        """Set which joints may move."""
        self._led.set_free_joints(np.array(free, bool))

    def getDOF(self) -> NDArray[np.bool_]:
        """Which joints may move."""
        return self._led.free

    # -- conversions --------------------------------------------------------------------------

    def declared_error(self, declared: type[Any], error: HardwareError) -> Exception:
        """The best solution is part of the exception."""
        if not isinstance(error, UnreachableGoal):
            return super().declared_error(declared, error)
        exception: Exception = declared(
            what=str(error), distance=error.nearest.distance * _MM, angle=error.nearest.angle
        )
        return exception

    def _goal(self, pose: Matrix) -> Matrix:
        found: Matrix = self.device().goal(pose)
        return found

    def _solution(self, found: Solution) -> Any:
        pose, joints = self.device().solution_pose(found)
        return self.types.HandSolution(pose=self._pose_to_message(pose), joints=joints)

    def _pose_to_message(self, pose: Matrix) -> Any:
        vector = rotation_vector(pose[:3, :3])
        angle = float(np.linalg.norm(vector))
        axis = vector / angle if angle else np.array([0.0, 0.0, 1.0])
        x, y, z = pose[:3, 3].tolist()
        turn = dict(zip(("axisX", "axisY", "axisZ"), axis.tolist(), strict=True))
        return self.types.HandPose(place=self.types.HandPlace(x=x, y=y, z=z), angle=angle, **turn)


def _point(place: Any) -> Matrix:
    return np.array([place.x, place.y, place.z])


def _matrix(pose: Any) -> Matrix:
    """A pose as (4, 4). Raises `CommandRefused` for an axis of zero length."""
    axis = np.array([pose.axisX, pose.axisY, pose.axisZ])
    length = float(np.linalg.norm(axis))
    if not (math.isfinite(length) and math.isfinite(pose.angle)):
        raise CommandRefused("the turn of the goal holds NaN or infinity")
    if length < 1e-9 and pose.angle:
        raise CommandRefused("a turn by an angle needs an axis that has a length")
    matrix = np.eye(4)
    if pose.angle:
        matrix[:3, :3] = rotation_about(axis * (pose.angle / length))
    matrix[:3, 3] = _point(pose.place)
    return matrix


def _positive(**values: float) -> float:
    require_finite(**values)
    ((name, value),) = values.items()
    if value <= 0.0:
        raise CommandRefused(f"`{name}` is {value:g}, it must be above 0")
    return value
