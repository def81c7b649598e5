"""A simulated screen: a texture on a plane that changes at run time.

In: images. Out: what cameras of the world see on the plane. The texture has the aspect ratio of the
plane; images are stretched to it.
"""

from __future__ import annotations

from typing import Any

import mujoco
import numpy as np

from robocomp_dsl.hardware.devices.display import Image
from robocomp_dsl.simulation.view.picture import SCREEN

_LONG = 512
_SHORT = 16
"""Pixels of the longer side, and the minimum of the shorter side."""


def add_screen(spec: Any, name: str, width: float, height: float, shown: Image) -> str:
    """The material of a screen with this aspect ratio and initial image."""
    longer = max(width, height)
    size = [max(round(_LONG * side / longer), _SHORT) for side in (width, height)]
    texture = spec.add_texture(
        name=f"{name}{SCREEN}",
        type=mujoco.mjtTexture.mjTEXTURE_2D,
        width=size[0],
        height=size[1],
        nchannel=3,
    )
    texture.data = _stretched(shown, size[0], size[1]).tobytes()
    material = spec.add_material(name=texture.name, texuniform=False, texrepeat=[1, 1])
    material.textures[mujoco.mjtTextureRole.mjTEXROLE_RGB] = texture.name
    return str(material.name)


class Screen:
    """The device `name`."""

    def __init__(self, *, name: str) -> None:
        self.name = name
        self._shown: Image | None = None

    # -- as a part of the world ---------------------------------------------------------------

    def build(self, spec: Any) -> None:
        """Nothing to add: the plane already has its texture."""

    def bind(self, model: Any, data: Any, random: np.random.Generator) -> None:  # noqa: ARG002
        """Find the texture."""
        self.find(model, data)

    def find(self, model: Any, data: Any) -> None:  # noqa: ARG002
        """Show the same image in another model."""
        self._model = model
        self._texture = int(model.texture(f"{self.name}{SCREEN}").id)
        if self._shown is not None:
            self.show(self._shown)

    def before_step(self, dt: float) -> None:
        """No motors."""

    def after_step(self, dt: float) -> None:
        """No sensors."""

    # -- as a device --------------------------------------------------------------------------

    def show(self, image: Image) -> None:
        """Show an image, shape (height, width, 3), rows from the top."""
        self._shown = image
        model, at = self._model, self._texture
        width, height = int(model.tex_width[at]), int(model.tex_height[at])
        first = int(model.tex_adr[at])
        shown = _stretched(image, width, height).ravel()
        model.tex_data[first : first + len(shown)] = shown


def _stretched(image: Image, width: int, height: int) -> Image:
    """The nearest pixels of `image`, rows from the bottom as in MuJoCo."""
    rows = np.arange(height)[::-1] * image.shape[0] // height
    columns = np.arange(width) * image.shape[1] // width
    return np.ascontiguousarray(image[rows][:, columns])
