"""RoboComp's first `Camera`: the cameras of a head by number, in five image formats.

An image is a sequence of bytes, rows from the top; `BOTH` concatenates the images of all cameras.
Luminance is that of ITU-R BT.601. Each image comes with the states of the joints and of the base.
"""

# ruff: noqa: N802  called as in the interface

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

import numpy as np
from numpy.typing import NDArray

from robocomp_dsl.hardware.devices.camera import CameraSettings
from robocomp_dsl.hardware.devices.errors import CommandRefused
from robocomp_dsl.hardware.servants.cameras.carried_camera import CarriedCameraServant
from robocomp_dsl.runtime import types as rt

Bytes = NDArray[np.uint8]

BOTH = 5
"""The number for all cameras together, as used by RoboComp's components."""

_LUMINANCE = np.array([0.299, 0.587, 0.114], dtype=np.float32)


class HeadCameraServant(CarriedCameraServant):
    """The devices of the port are cameras, then the base under the first, if any."""

    def __init__(
        self, interface: rt.Interface, port: str, ids: tuple[str, ...], devices: Mapping[str, Any]
    ) -> None:
        super().__init__(interface, port, ids, devices)
        self._fed = np.empty((0, 0, 3), dtype=np.uint8)

    def getYUVImage(self, cam: int) -> tuple[Any, ...]:
        """Luminance, then interleaved u and v of every second pixel of every second row."""
        return self._image_to_message(self._all(cam, _semi_planar))

    def getYImage(self, cam: int) -> tuple[Any, ...]:
        """Luminance."""
        return self._image_to_message(self._all(cam, _luminance))

    def getYLogPolarImage(self, cam: int) -> tuple[Any, ...]:
        """Rejected: the interface does not define the rings and rays of such an image."""
        self._numbers(cam)
        raise CommandRefused("log-polar images are not made; `getYImage` has the same luminance")

    def getYImageCR(self, cam: int, div: int) -> tuple[Any, ...]:
        """Luminance, averaged over blocks of `div` by `div` pixels; partial blocks are dropped."""
        smallest = min(min(picture.shape[:2]) for picture in self._seen(cam))
        if not 1 <= div <= smallest:
            raise CommandRefused(f"`div` is {div}, it must be 1 to {smallest}")
        return self._image_to_message(self._all(cam, lambda seen: _reduced(_luminance(seen), div)))

    def getRGBPackedImage(self, cam: int) -> tuple[Any, ...]:
        """Red, green and blue of each pixel."""
        return self._image_to_message(self._all(cam, lambda seen: seen))

    def getYRGBImage(self, cam: int) -> tuple[Any, ...]:
        """Luminance, red, green and blue, as consecutive planes."""
        return self._image_to_message(self._all(cam, _planes))

    def getCamParams(self) -> Any:
        """The settings of the first camera; the interface assumes identical cameras."""
        it = self._settings(0)
        return self.types.TCamParams(
            name=self.cameras[0],
            driver="robocomp_dsl",
            device=self.port,
            mode="RGB",
            focal=round(it.focal),
            width=it.width,
            height=it.height,
            size=it.width * it.height,
            numCams=len(self.cameras),
            FPS=round(1 / it.period),
            timerPeriod=round(it.period * 1000),
            leftCamera=0,
            rightCamera=min(1, len(self.cameras) - 1),
            bothCameras=BOTH,
            talkToBase=bool(self.bases),
            talkToJointMotor=self.has_joints(),
        )

    def setInnerImage(self, roi: Any) -> None:
        """Replaces the image of the first camera, in colour or grey; an empty image ends it."""
        it, region = self._settings(0), np.asarray(roi, dtype=np.uint8)
        if region.size not in (0, it.width * it.height, it.width * it.height * 3):
            raise CommandRefused(
                f"an image of {it.width} x {it.height} has {it.width * it.height} bytes, or three "
                f"times as many with colours; not {region.size}"
            )
        shape = (it.height, it.width) if region.size else (0, 0)
        grey = region.size == it.width * it.height
        seen = region.reshape(*shape, 1 if grey else 3)
        self._fed = np.repeat(seen, 3, axis=2) if grey else seen

    # -- images -------------------------------------------------------------------------------

    def _numbers(self, cam: int) -> range:
        count = len(self.cameras)
        if cam == BOTH:
            return range(count)
        if not 0 <= cam < count:
            raise CommandRefused(f"there is no camera {cam}: 0 to {count - 1}, or {BOTH} for all")
        return range(cam, cam + 1)

    def _seen(self, cam: int) -> list[Bytes]:
        """The latest images, each of shape (height, width, 3)."""
        return [
            self._fed if i == 0 and self._fed.size else self.camera(i).picture().colour
            for i in self._numbers(cam)
        ]

    def _all(self, cam: int, form: Any) -> Bytes:
        joined: Bytes = np.concatenate([form(picture).ravel() for picture in self._seen(cam)])
        return joined

    def _settings(self, number: int) -> CameraSettings:
        return self.camera(number).settings

    # -- states -------------------------------------------------------------------------------

    def _image_to_message(self, image: Bytes) -> tuple[Any, ...]:
        """The image with the states of the joints and of the base; empty if there are none."""
        joints, base = self.robot_state()
        moving = any(joint.isMoving for joint in joints.values())
        return image, self.types.THeadState(motorsState=joints, isMoving=moving), base


def _luminance(seen: Bytes) -> Bytes:
    """Shape (height, width)."""
    grey: Bytes = (seen @ _LUMINANCE).round().astype(np.uint8)
    return grey


def _planes(seen: Bytes) -> Bytes:
    return np.concatenate([_luminance(seen)[None], np.moveaxis(seen, 2, 0)])


def _semi_planar(seen: Bytes) -> Bytes:
    """4:2:0 in two planes; an odd last row or column has chroma samples of its own."""
    grey = seen @ _LUMINANCE
    few = seen[::2, ::2].astype(np.float32)
    blue, red = few[..., 2] - grey[::2, ::2], few[..., 0] - grey[::2, ::2]
    colours = np.stack([blue * 0.564, red * 0.713], axis=-1) + 128
    return np.concatenate([_luminance(seen).ravel(), _byte(colours).ravel()])


def _reduced(grey: Bytes, div: int) -> Bytes:
    rows, columns = grey.shape[0] // div, grey.shape[1] // div
    blocks = grey[: rows * div, : columns * div].reshape(rows, div, columns, div)
    return _byte(blocks.mean(axis=(1, 3)))


def _byte(values: NDArray[Any]) -> Bytes:
    rounded: Bytes = values.round().clip(0, 255).astype(np.uint8)
    return rounded
