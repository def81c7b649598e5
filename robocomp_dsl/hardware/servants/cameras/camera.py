"""`CameraSimple` and `CameraRGBDSimple` over cameras; images stay numpy arrays throughout."""

# ruff: noqa: N802  called as in the interface

from __future__ import annotations

import logging
from collections.abc import Mapping
from typing import Any, ClassVar

import numpy as np

from robocomp_dsl.hardware.devices.camera import CameraDevice, Picture, points
from robocomp_dsl.hardware.devices.errors import CommandRefused, DeviceGone, NoRendering
from robocomp_dsl.hardware.servants.cameras.exposure import Exposure
from robocomp_dsl.hardware.servants.servant import Servant
from robocomp_dsl.runtime import types as rt

_MS = 1000.0

log = logging.getLogger("robocomp.camera")


class CameraSimpleServant(Servant):
    """One camera; a picture is rendered while the world continues."""

    NEEDS_LOCK: ClassVar[bool] = False

    def getImage(self) -> Any:
        """The latest image."""
        it = self.device().picture().colour
        height, width, channels = it.shape
        return self.types.TImage(
            compressed=False, width=width, height=height, depth=channels, image=it.ravel()
        )


class RgbdSimpleServant(Servant):
    """All cameras of the port by name; an empty name selects the only camera."""

    NEEDS_LOCK: ClassVar[bool] = False

    def __init__(
        self, interface: rt.Interface, port: str, ids: tuple[str, ...], devices: Mapping[str, Any]
    ) -> None:
        super().__init__(interface, port, ids, devices)
        self._exposures = {name: Exposure() for name in ids}

    def poll(self) -> list[tuple[Any, ...]]:
        """Colour and depth of every camera that has a new picture."""
        messages = []
        for name, exposure in tuple(self._exposures.items()):
            try:
                camera = self._camera(name)
                seen = exposure.next(camera, wait=self.on_deployment_clock())
            except DeviceGone:
                continue
            except NoRendering as error:  # the next call would fail as well
                log.error("`%s` is not published: %s", name, error)  # noqa: TRY400
                del self._exposures[name]
                continue
            if seen is not None:
                messages.append((self._image(name, camera, seen), self._depth(name, camera, seen)))
        return messages

    def getImage(self, camera: str) -> Any:
        """The latest colour image."""
        found = self._camera(camera)
        return self._image(camera, found, found.picture())

    def getDepth(self, camera: str) -> Any:
        """The latest depth image: 32-bit floats in mm, infinite without an object."""
        found = self._camera(camera)
        return self._depth(camera, found, found.picture())

    def getPoints(self, camera: str) -> Any:
        """The latest points, in the frame of the camera."""
        found = self._camera(camera)
        return self._points(found, found.picture())

    def getAll(self, camera: str) -> Any:
        """All three of the same instant."""
        found = self._camera(camera)
        seen = found.picture()
        return self.types.TRGBD(
            image=self._image(camera, found, seen),
            depth=self._depth(camera, found, seen),
            points=self._points(found, seen),
        )

    def _camera(self, name: str) -> CameraDevice:
        if not name and len(self.ids) == 1:
            name = self.ids[0]
        if name not in self.ids:
            raise CommandRefused(f"there is no camera `{name}`: {', '.join(self.ids)}")
        found: CameraDevice = self.device(name)
        return found

    def _image(self, name: str, camera: CameraDevice, seen: Picture) -> Any:
        height, width, channels = seen.colour.shape
        return self.types.TImage(
            depth=channels,
            image=seen.colour.ravel(),
            **self._frame(name, camera, seen, width, height),
        )

    def _depth(self, name: str, camera: CameraDevice, seen: Picture) -> Any:
        height, width = seen.depth.shape
        return self.types.TDepth(
            depthFactor=1.0,
            depth=seen.depth.view(np.uint8).ravel(),
            **self._frame(name, camera, seen, width, height),
        )

    def _points(self, camera: CameraDevice, seen: Picture) -> Any:
        x, y, z = points(camera.settings, seen.depth).T
        cloud = self.types.PointsType.from_columns(x=x, y=y, z=z)
        return self.types.TPoints(points=cloud, compressed=False, **self._time(camera, seen))

    def _frame(
        self, name: str, camera: CameraDevice, seen: Picture, width: int, height: int
    ) -> dict[str, Any]:
        focal = round(camera.settings.focal)
        return {
            "compressed": False,
            "cameraID": self.ids.index(name) if name else 0,
            "width": width,
            "height": height,
            "focalx": focal,
            "focaly": focal,
        } | self._time(camera, seen)

    @staticmethod
    def _time(camera: CameraDevice, seen: Picture) -> dict[str, Any]:
        return {
            "alivetime": round(seen.time * _MS),
            "period": camera.settings.period * _MS,
        }
