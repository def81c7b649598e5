"""Shared by camera servants that report the robot's state with each image.

In: the devices of the port, cameras before the base that carries them. Out: the states of all
joints of the world and of the base at the same instant.
"""

from __future__ import annotations

from collections.abc import Mapping
from contextlib import nullcontext
from typing import Any, ClassVar

from robocomp_dsl.hardware.devices.camera import CameraDevice
from robocomp_dsl.hardware.servants.base import base_state_to_message
from robocomp_dsl.hardware.servants.joints.joint_motor import JointMotorServant
from robocomp_dsl.hardware.servants.servant import Servant
from robocomp_dsl.runtime import types as rt

_ANY_TIME = nullcontext()


class CarriedCameraServant(Servant):
    """`cameras` and `bases` are the ids of cameras and bases; there may be no base."""

    NEEDS_LOCK: ClassVar[bool] = False

    def __init__(
        self, interface: rt.Interface, port: str, ids: tuple[str, ...], devices: Mapping[str, Any]
    ) -> None:
        super().__init__(interface, port, ids, devices)
        self._motors = JointMotorServant(interface, port, ids, devices)
        self.cameras = [device_id for device_id in ids if hasattr(devices[device_id], "picture")]
        self.bases = [device_id for device_id in ids if device_id not in self.cameras]

    def camera(self, number: int = 0) -> CameraDevice:
        """The camera with that number."""
        found: CameraDevice = self.device(self.cameras[number])
        return found

    def has_joints(self) -> bool:
        """Whether anything in the world has a motor."""
        return any(hasattr(device, "board") for device in tuple(self._devices.values()))

    def robot_state(self) -> tuple[Any, Any]:
        """The states of the joints by name and of the base; empty and zero if there are none."""
        state = self.types.TBaseState
        with getattr(self.camera(), "lock", _ANY_TIME):  # a real device does not wait
            joints = self._motors.getAllMotorState() if self.has_joints() else {}
            base = (
                base_state_to_message(state, self.device(self.bases[0]).state())
                if self.bases
                else state()
            )
        return joints, base
