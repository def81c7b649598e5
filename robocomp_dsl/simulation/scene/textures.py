"""Pictures as textures.

In: an `MjSpec` and the path of a picture in any format that Pillow reads. Out: a material with the
picture, one per file; or the reason of a failure.
"""

from __future__ import annotations

from pathlib import Path
from typing import Any

import mujoco

from robocomp_dsl.hardware.formats.picture_file import read_picture


def add_material(spec: Any, path: Path, tile: float) -> str:
    """The name of a material that repeats the picture every `tile` m. Raises `PictureError`."""
    name = f"{path}@{tile:g}"
    if any(known.name == name for known in spec.materials):
        return name
    picture = read_picture(path)
    height, width, _ = picture.shape
    texture = spec.add_texture(
        name=name,
        type=mujoco.mjtTexture.mjTEXTURE_2D,
        width=width,
        height=height,
        nchannel=3,
    )
    texture.data = picture[::-1].tobytes()  # MuJoCo's first row is at the bottom
    material = spec.add_material(name=name, texuniform=True, texrepeat=[1 / tile, 1 / tile])
    material.textures[mujoco.mjtTextureRole.mjTEXROLE_RGB] = name
    return name
