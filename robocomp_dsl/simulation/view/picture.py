"""Offscreen pictures of a model, rendered by MuJoCo.

In: `MjModel` and `MjData`, a size, a viewpoint. Out: pixels, or a PNG file.
"""

from __future__ import annotations

import math
import struct
import zlib
from dataclasses import dataclass
from pathlib import Path
from types import TracebackType
from typing import Any, Self

import mujoco
import numpy as np
from numpy.typing import NDArray

from robocomp_dsl.hardware.devices.errors import NoRendering
from robocomp_dsl.simulation.models.mesh_marker import (
    MARKER_COLOUR,
    marked_meshes,
    marker_size,
)
from robocomp_dsl.simulation.view.offscreen import new_context

Pixels = NDArray[np.uint8]
Floats = NDArray[np.float64]

_MOST_GEOMS = 200_000
_FRAME = mujoco.mjtFrame
_LABEL = mujoco.mjtLabel
SCREEN = ".screen"
"""Suffix of the names of textures that change at run time."""
_SKY = 0.4
"""Share of the far plane's distance: the sky box is not nearer, scenes are much smaller."""
_LEAST_MARGIN = 0.1  # m
_LONGEST_LABEL = 99
DEFAULT_SIZE = (1280, 960)
LARGEST = 8192
"""Maximum pixels per side."""


@dataclass(frozen=True, slots=True)
class Viewpoint:
    """The viewpoint, and the items shown besides shapes.

    `azimuth` and `elevation` are in degrees, in MuJoCo's convention; at a `distance` of 1 the ball
    around all shapes except planes just fits. `camera` names a camera of the model to use instead.
    """

    azimuth: float = 120.0
    elevation: float = -25.0
    distance: float = 1.0
    camera: str = ""
    frames: bool = False
    names: bool = False
    contacts: bool = False


class Renderer:
    """Renders one model; a context manager. Raises `NoRendering`."""

    def __init__(self, model: Any, width: int = 1280, height: int = 960) -> None:
        if not (0 < width <= LARGEST and 0 < height <= LARGEST):
            raise NoRendering(f"a picture has 1 to {LARGEST} pixels a side, not {width}x{height}")
        self.model, self.width, self.height = model, width, height
        model.vis.global_.offwidth = max(int(model.vis.global_.offwidth), width)
        model.vis.global_.offheight = max(int(model.vis.global_.offheight), height)
        self._gl = new_context(width, height)
        self._gl.make_current()
        try:
            self._context = mujoco.MjrContext(model, mujoco.mjtFontScale.mjFONTSCALE_150)
        except mujoco.FatalError as error:
            self._gl.free()
            raise NoRendering(f"OpenGL cannot render this model: {error}") from None
        mujoco.mjr_setBuffer(mujoco.mjtFramebuffer.mjFB_OFFSCREEN, self._context)
        most = min(_MOST_GEOMS, 1000 + 8 * model.ngeom + model.nsite)
        self._scene = mujoco.MjvScene(model, maxgeom=most)
        self._markers = marked_meshes(model)
        self._screens = {i: _checksum(model, i) for i in range(model.ntex) if _is_screen(model, i)}

    def __enter__(self) -> Self:
        return self

    def __exit__(
        self,
        kind: type[BaseException] | None,
        error: BaseException | None,
        trace: TracebackType | None,
    ) -> None:
        self._context.free()
        self._gl.free()

    def render(self, data: Any, look: Viewpoint = Viewpoint()) -> Pixels:
        """The image, shape (height, width, 3)."""
        option, camera = mujoco.MjvOption(), self._camera(look, data)
        option.frame = _FRAME.mjFRAME_BODY if look.frames else _FRAME.mjFRAME_NONE
        option.label = _LABEL.mjLABEL_BODY if look.names else _LABEL.mjLABEL_NONE
        flags = mujoco.mjtVisFlag
        for flag in (flags.mjVIS_CONTACTPOINT, flags.mjVIS_CONTACTFORCE):
            option.flags[flag] = look.contacts
        everything = mujoco.mjtCatBit.mjCAT_ALL
        mujoco.mjv_updateScene(self.model, data, option, None, camera, everything, self._scene)
        if not look.camera:
            self._mark(data, look.names)
        self._refresh()
        view = mujoco.MjrRect(0, 0, self.width, self.height)
        mujoco.mjr_render(view, self._scene, self._context)
        pixels = np.empty((self.height, self.width, 3), dtype=np.uint8)
        mujoco.mjr_readPixels(pixels, None, view, self._context)
        return pixels[::-1]

    def _mark(self, data: Any, names: bool) -> None:
        """Draw the markers of missing meshes, at least at a visible size."""
        low, high = scene_extent(self.model, data)
        size = marker_size(float(np.linalg.norm(high - low)))
        for site, name in self._markers.items():
            if self._scene.ngeom >= self._scene.maxgeom:
                return
            drawn = self._scene.geoms[self._scene.ngeom]
            mujoco.mjv_initGeom(
                drawn,
                mujoco.mjtGeom.mjGEOM_BOX,
                np.full(3, size / 2),
                data.site_xpos[site],
                data.site_xmat[site],
                np.array(MARKER_COLOUR, np.float32),
            )
            drawn.label = name[:_LONGEST_LABEL] if names else ""
            self._scene.ngeom += 1

    def _refresh(self) -> None:
        """Update the textures of screens whose image has changed."""
        for texture, known in self._screens.items():
            now = _checksum(self.model, texture)
            if now != known:
                self._screens[texture] = now
                mujoco.mjr_uploadTexture(self.model, self._context, texture)

    def depths(self) -> NDArray[np.float32]:
        """Depth of the last image [m], infinite without an object.

        Shape (height, width). From window coordinates with 1 at the near plane and 0 at the far
        one, d = n·f / (w·(f - n) + n).
        """
        depths = np.empty((self.height, self.width), dtype=np.float32)
        self._context.readDepthMap = mujoco.mjtDepthMap.mjDEPTH_ZEROFAR
        mujoco.mjr_readPixels(
            None, depths, mujoco.MjrRect(0, 0, self.width, self.height), self._context
        )
        extent, planes = float(self.model.stat.extent), self.model.vis.map
        near, far = (float(row) * extent for row in (planes.znear, planes.zfar))
        wide = depths.astype(np.float64)
        metres = near * far / (wide * (far - near) + near)
        metres[metres > _SKY * far] = np.inf
        return np.ascontiguousarray(metres[::-1], dtype=np.float32)

    def _camera(self, look: Viewpoint, data: Any) -> Any:
        camera = mujoco.MjvCamera()
        if look.camera:
            number = find_camera(self.model, look.camera)
            camera.type, camera.fixedcamid = mujoco.mjtCamera.mjCAMERA_FIXED, number
            return camera
        camera.type = mujoco.mjtCamera.mjCAMERA_FREE
        low, high = scene_extent(self.model, data)
        camera.lookat = (low + high) / 2
        radius = max(float(np.linalg.norm(high - low)) / 2, 1e-3)
        opening = math.radians(float(self.model.vis.global_.fovy)) * min(
            1, self.width / self.height
        )
        camera.distance = look.distance * radius / math.sin(opening / 2)
        camera.azimuth, camera.elevation = look.azimuth, look.elevation
        return camera


def find_camera(model: Any, name: str) -> int:
    """The number of a camera of the model. Raises `NoRendering`, which lists the cameras."""
    number = int(mujoco.mj_name2id(model, mujoco.mjtObj.mjOBJ_CAMERA, name))
    if number < 0:
        names = [f"`{model.camera(i).name}`" for i in range(model.ncam) if model.camera(i).name]
        known = f"its cameras are {', '.join(names)}" if names else "it has none"
        raise NoRendering(f"the model has no camera `{name}`: {known}")
    return number


def picture_size(model: Any, look: Viewpoint) -> tuple[int, int]:
    """The default width and height: those of the camera if it has some. Raises `NoRendering`."""
    if look.camera:
        width, height = model.cam_resolution[find_camera(model, look.camera)].tolist()
        if width > 1 and height > 1:  # MuJoCo's default is one pixel
            return width, height
    return DEFAULT_SIZE


def _is_screen(model: Any, texture: int) -> bool:
    return str(model.texture(texture).name).endswith(SCREEN)


def _checksum(model: Any, texture: int) -> int:
    first = int(model.tex_adr[texture])
    size = int(model.tex_width[texture]) * int(model.tex_height[texture])
    return zlib.crc32(model.tex_data[first : first + size * int(model.tex_nchannel[texture])])


def scene_extent(model: Any, data: Any) -> tuple[Floats, Floats]:
    """The corners of the bounding box of all visible shapes but planes.

    The marker of a missing mesh counts as a point, and only if it is not farther from the shapes
    than these are large. Without shapes it is the box of the markers, else of the frames.
    """
    visible = (model.geom_type != mujoco.mjtGeom.mjGEOM_PLANE) & (model.geom_rgba[:, 3] > 0)
    real = np.flatnonzero(visible)
    markers = data.site_xpos[list(marked_meshes(model))]
    if not len(real):
        points = markers if len(markers) else data.xpos
        low, high = points.min(axis=0), points.max(axis=0)
        margin = max(0.1 * float(np.linalg.norm(high - low)), _LEAST_MARGIN)
        return low - margin, high + margin
    turn = data.geom_xmat[real].reshape(-1, 3, 3)
    centre = data.geom_xpos[real] + np.einsum("nij,nj->ni", turn, model.geom_aabb[real, :3])
    half = np.einsum("nij,nj->ni", np.abs(turn), model.geom_aabb[real, 3:])
    low, high = (centre - half).min(axis=0), (centre + half).max(axis=0)
    size = float(np.linalg.norm(high - low))
    near = markers[((markers > low - size) & (markers < high + size)).all(axis=1)]
    corners = np.concatenate(([low, high], near))
    return corners.min(axis=0), corners.max(axis=0)


def add_lighting(spec: Any) -> None:
    """Add light and sky to a model that has neither, so that its pictures are not black."""
    if not len(spec.lights):
        spec.visual.headlight.ambient = [0.5, 0.5, 0.5]
        spec.visual.headlight.diffuse = [0.6, 0.6, 0.6]
        spec.visual.headlight.specular = [0.1, 0.1, 0.1]
    if not any(texture.type == mujoco.mjtTexture.mjTEXTURE_SKYBOX for texture in spec.textures):
        spec.add_texture(
            name="sky of the view",
            type=mujoco.mjtTexture.mjTEXTURE_SKYBOX,
            builtin=mujoco.mjtBuiltin.mjBUILTIN_GRADIENT,
            rgb1=[0.85, 0.9, 0.95],
            rgb2=[0.45, 0.55, 0.65],
            width=256,
            height=256,
        )


def png(pixels: Pixels) -> bytes:
    """A PNG file (RFC 2083) of pixels of shape (height, width, 3)."""
    height, width, _ = pixels.shape
    lines = np.concatenate(
        (np.zeros((height, 1), np.uint8), pixels.reshape(height, 3 * width)), axis=1
    )

    def chunk(kind: bytes, data: bytes) -> bytes:
        return (
            struct.pack(">I", len(data)) + kind + data + struct.pack(">I", zlib.crc32(kind + data))
        )

    head = struct.pack(">IIBBBBB", width, height, 8, 2, 0, 0, 0)
    body = chunk(b"IDAT", zlib.compress(lines.tobytes(), 6))
    return b"\x89PNG\r\n\x1a\n" + chunk(b"IHDR", head) + body + chunk(b"IEND", b"")


def save(path: Path, pixels: Pixels) -> None:
    """Write a PNG file atomically. Raises `OSError`."""
    part = path.with_name(path.name + ".part")
    part.write_bytes(png(pixels))
    part.replace(path)
