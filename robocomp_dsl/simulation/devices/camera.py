"""A simulated camera: its thread renders a copy of the world's state.

In: a frame, whose z axis is the viewing direction, and the optics. Out: pictures on request, at
most one per camera period. It renders offscreen (`view.offscreen`); for a
missing library the error names the Debian package.
"""

from __future__ import annotations

import math
from concurrent.futures import ThreadPoolExecutor
from typing import Any, Self

import mujoco
import numpy as np
from numpy.typing import NDArray

from robocomp_dsl.hardware.devices.camera import CameraSettings, Picture
from robocomp_dsl.hardware.servants.fair_lock import FairLock
from robocomp_dsl.simulation.scene.axes import MM
from robocomp_dsl.simulation.view.picture import Renderer, Viewpoint, add_lighting
from robocomp_dsl.simulation.world.noise import NoiseLevel


class Camera:
    """The device `name` on the body `body`. `turns` is the lock of its world.

    `model_camera` is the name of a camera in a model file; its settings take precedence.
    """

    def __init__(
        self,
        settings: CameraSettings,
        body: str,
        level: NoiseLevel,
        *,
        name: str,
        model_camera: str = "",
    ) -> None:
        self._settings = settings
        self._at = body
        self._level = level
        self.name = name
        self._model_camera = model_camera
        self._renderer = _RenderThread(settings)
        self._random = np.random.default_rng(0)
        self._latest: Picture | None = None
        self.lock = FairLock()

    # -- as a part of the world ---------------------------------------------------------------

    def build(self, spec: Any) -> None:
        """Add a camera that looks along the z axis of its frame, y up."""
        width, height = self._settings.width, self._settings.height
        spec.visual.global_.offwidth = max(spec.visual.global_.offwidth, width)
        spec.visual.global_.offheight = max(spec.visual.global_.offheight, height)
        add_lighting(spec)
        if not self._model_camera:
            self.place(spec)

    def place(self, spec: Any) -> None:
        """Add only the camera itself, for a viewer with pictures of its own size."""
        width, height = self._settings.width, self._settings.height
        angle = 2 * np.degrees(np.arctan2(height / 2, self._settings.focal))
        # MuJoCo's cameras look along -z with y up; z ahead of RoboComp is its y
        spec.body(self._at).add_camera(
            name=self.name,
            fovy=float(angle),
            quat=[np.sqrt(0.5), np.sqrt(0.5), 0.0, 0.0],
            resolution=[width, height],
        )

    def bind(self, model: Any, data: Any, random: np.random.Generator) -> None:
        """Start without a picture."""
        self._random = random
        self._latest = None
        self.find(model, data)

    def find(self, model: Any, data: Any) -> None:
        """The same camera in another model."""
        self._model, self._data = model, data

    # -- as a device --------------------------------------------------------------------------

    @property
    def settings(self) -> CameraSettings:
        """Size and optics."""
        return self._settings

    def picture(self) -> Picture:
        """The latest picture; a new one in each camera period.

        Holds the lock of the world only while its state is copied.
        """
        with self.lock:
            time = float(self._data.time)
            known = self._latest
            if known and known.time <= time and self._frame(known.time) == self._frame(time):
                return known
            model = self._model
            data = mujoco.MjData(model)
            for field in ("qpos", "qvel", "mocap_pos", "mocap_quat", "time"):
                setattr(data, field, getattr(self._data, field))
        self._latest = self._noisy(
            self._renderer.render(model, data, self._model_camera or self.name)
        )
        return self._latest

    def close(self) -> None:
        """Free the rendering resources; the next picture recreates them."""
        self._renderer.close()

    def _frame(self, time: float) -> int:
        """Index of the current camera period since time 0, independent of the time of the call."""
        return math.floor(time / self._settings.period + 1e-6)

    def _noisy(self, seen: Picture) -> Picture:
        spread = self._settings.noise * self._level.factor
        depth = seen.depth
        if spread and depth.size:
            depth = depth + self._random.normal(0.0, spread, depth.shape).astype(np.float32)
        for array in (seen.colour, depth):
            array.flags.writeable = False
        return Picture(seen.time, seen.colour, depth)


class _RenderThread:
    """The rendering thread: an OpenGL context belongs to one thread for its lifetime."""

    def __init__(self, settings: CameraSettings) -> None:
        self._settings = settings
        self._thread = ThreadPoolExecutor(1, thread_name_prefix="camera")
        self._painter: Renderer | None = None

    def __deepcopy__(self, memo: object) -> Self:
        return self  # copies of the world use the same renderer

    def render(self, model: Any, data: Any, name: str) -> Picture:
        """Render; other callers wait meanwhile, the world continues."""
        return self._thread.submit(self._draw, model, data, name).result()

    def close(self) -> None:
        """Free the rendering context (about 90 MB) after the last picture; returns immediately."""
        self._thread.submit(self._free)

    def _draw(self, model: Any, data: Any, name: str) -> Picture:
        mujoco.mj_forward(model, data)
        painter = self._painter_for(model)
        colour = np.ascontiguousarray(painter.render(data, Viewpoint(camera=name)))
        depth: NDArray[np.float32] = np.empty((0, 0), np.float32)
        if self._settings.depth:
            depth = painter.depths() / np.float32(MM)
        return Picture(float(data.time), colour, depth)

    def _painter_for(self, model: Any) -> Renderer:
        if self._painter is None or self._painter.model is not model:
            self._free()
            self._painter = Renderer(model, self._settings.width, self._settings.height)
        return self._painter

    def _free(self) -> None:
        if self._painter is not None:
            self._painter.__exit__(None, None, None)
            self._painter = None
