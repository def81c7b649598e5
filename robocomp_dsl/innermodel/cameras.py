"""The geometry of the cameras of an InnerModel: pixels, and rays in the frame of a camera.

A camera looks along z, x to the right and y up; pixels count from the upper left corner. Its
optical axis is at the middle of the picture (RoboComp, class Cam).
"""

# ruff: noqa: N802, N803  names as in RoboComp

from __future__ import annotations

import math

import numpy as np
from numpy.typing import ArrayLike

from robocomp_dsl.innermodel.errors import InnerModelError
from robocomp_dsl.innermodel.queries import PoseQueries
from robocomp_dsl.innermodel.shared_state import Floats, locked, number, vector
from robocomp_dsl.model import innermodel


class CameraGeometry(PoseQueries):
    """The part of `InnerModel` about cameras (`camera` and `rgbd`)."""

    @locked
    def project(self, reference: str, origVec: ArrayLike, cameraId: str) -> Floats:
        """The pixel of a point of `reference`: column, row, and distance in mm; shape (3,).

        Raises `InnerModelError` for a point beside the camera (z = 0), which no pixel shows. A
        point behind it is projected through the centre, as in RoboComp.
        """
        camera = self._camera(cameraId)
        x, y, z = point = self.transform(cameraId, vector(origVec, "a point", 3), reference)
        if z == 0:
            raise InnerModelError(f"the point is beside `{cameraId}`, so it has no pixel")
        column = camera.focal * x / z + camera.width / 2
        row = -camera.focal * y / z + camera.height / 2
        return np.array((column, row, math.hypot(*point)))

    @locked
    def backProject(self, cameraId: str, coord: ArrayLike) -> Floats:
        """The ray through a pixel (column, row), in the frame of the camera: (x, y, 1)."""
        camera = self._camera(cameraId)
        column, row = vector(coord, "a pixel", 2, 3)[:2]
        return np.array(
            (
                (column - camera.width / 2) / camera.focal,
                -(row - camera.height / 2) / camera.focal,
                1.0,
            )
        )

    @locked
    def imageCoordPlusDepthTo(
        self, cameraId: str, coord: ArrayLike, depth: float, to: str
    ) -> Floats:
        """The point that a pixel shows at `depth` mm along z of the camera, in `to`."""
        ray = self.backProject(cameraId, coord)
        return self.transform(to, ray * number(depth, "depth"), cameraId)

    @locked
    def getCameraFocal(self, cameraId: str) -> float:
        """The focal length in pixels."""
        return self._camera(cameraId).focal

    @locked
    def getCameraWidth(self, cameraId: str) -> int:
        """The width of the picture in pixels."""
        return self._tree.node_of(cameraId, innermodel.Camera, "a camera").width

    @locked
    def getCameraHeight(self, cameraId: str) -> int:
        """The height of the picture in pixels."""
        return self._tree.node_of(cameraId, innermodel.Camera, "a camera").height

    def _camera(self, id: str) -> innermodel.Camera:
        camera = self._tree.node_of(id, innermodel.Camera, "a camera")
        if camera.focal <= 0:
            raise InnerModelError(f"the camera `{id}` has no `focal` length")
        return camera
