"""`RGBD` over a camera with depth: images with the states of the joints and of the base under it.

Both images have the same viewpoint, so every registration is exact. Pixels without an object have
an infinite distance, and points with w = 0, whose x, y, z are the direction.
"""

# ruff: noqa: N802  called as in the interface

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

import numpy as np
from numpy.typing import NDArray

from robocomp_dsl.hardware.devices.camera import CameraSettings, Picture
from robocomp_dsl.hardware.servants.cameras.carried_camera import CarriedCameraServant
from robocomp_dsl.runtime import types as rt

Floats = NDArray[np.float32]
_BYTES = {"color": 3, "depth": 4}
"""Bytes of a pixel."""


class RgbdServant(CarriedCameraServant):
    """The first device of the port is the camera, the second, if any, the base under it."""

    def __init__(
        self, interface: rt.Interface, port: str, ids: tuple[str, ...], devices: Mapping[str, Any]
    ) -> None:
        super().__init__(interface, port, ids, devices)
        self._registration = self.types.Registration.DepthInColor

    def getRGBDParams(self) -> Any:
        """Configuration of the camera."""
        it = self.camera().settings
        parameters = {
            name: self.types.CameraParameters(
                focal=round(it.focal),
                width=it.width,
                height=it.height,
                size=it.width * it.height * size,
                FPS=round(1 / it.period),
            )
            for name, size in _BYTES.items()
        }
        return self.types.TRGBDParams(
            **parameters,
            timerPeriod=round(it.period * 1000),
            talkToBase=bool(self.bases),
            talkToJointMotor=self.has_joints(),
            driver="robocomp_dsl",
            device=self.ids[0],
        )

    def setRegistration(self, value: Any) -> None:
        """Store the request; the images are the same for all registrations."""
        self._registration = value

    def getRegistration(self) -> Any:
        """The last requested registration."""
        return self._registration

    def getData(self) -> tuple[Any, ...]:
        """Colour bytes and distances."""
        seen = self.camera().picture()
        return seen.colour.ravel(), seen.depth.ravel(), *self.robot_state()

    def getDepthInIR(self) -> tuple[Any, ...]:
        """Distances."""
        return self.camera().picture().depth.ravel(), *self.robot_state()

    def getDepth(self) -> tuple[Any, ...]:
        """Distances."""
        return self.getDepthInIR()

    def getImage(self) -> tuple[Any, ...]:
        """Colours, distances and points of the same instant."""
        seen = self.camera().picture()
        return self._colours(seen), seen.depth.ravel(), self._points(seen), *self.robot_state()

    def getRGB(self) -> tuple[Any, ...]:
        """Colours."""
        return self._colours(self.camera().picture()), *self.robot_state()

    def getXYZ(self) -> tuple[Any, ...]:
        """One point per pixel."""
        return self._points(self.camera().picture()), *self.robot_state()

    def getXYZByteStream(self) -> tuple[Any, ...]:
        """The points as bytes: x, y, z, w of each as 32-bit floats, little endian."""
        found = homogeneous(self.camera().settings, self.camera().picture().depth)
        return found.astype("<f4").view(np.uint8).ravel(), *self.robot_state()

    def _colours(self, seen: Picture) -> Any:
        red, green, blue = seen.colour.reshape(-1, 3).T
        return self.types.ColorSeq.from_columns(red=red, green=green, blue=blue)

    def _points(self, seen: Picture) -> Any:
        x, y, z, w = homogeneous(self.camera().settings, seen.depth).T
        return self.types.PointSeq.from_columns(x=x, y=y, z=z, w=w)


def homogeneous(settings: CameraSettings, depth: Floats) -> Floats:
    """One point per pixel in the frame of the camera (mm), shape (number of pixels, 4)."""
    height, width = depth.shape
    x = (np.arange(width, dtype=np.float32) - (width - 1) / 2) / settings.focal
    y = ((height - 1) / 2 - np.arange(height, dtype=np.float32)) / settings.focal
    somewhere = np.isfinite(depth)
    z = np.where(somewhere, depth, 1.0)
    points: Floats = np.stack([x[None, :] * z, y[:, None] * z, z, somewhere], axis=-1)
    return points.astype(np.float32).reshape(-1, 4)
