"""Pictures on planes.

In: an `MjSpec` and the path of a picture in any format that Pillow reads. Out: a material that
shows it, once for each file; or a reason why there is none.
"""

from __future__ import annotations

import warnings
from pathlib import Path
from typing import Any

import mujoco

LARGEST = 1024
"""Pixels along one side; a larger picture is made smaller."""


class TextureError(Exception):
    """There is no picture; the message says why."""


def add_material(spec: Any, path: Path, tile: float) -> str:
    """The name of a material that repeats the picture every `tile` m. Raises `TextureError`."""
    name = f"{path}@{tile:g}"
    if any(one.name == name for one in spec.materials):
        return name
    width, height, data = _pixels(path)
    texture = spec.add_texture(
        name=name,
        type=mujoco.mjtTexture.mjTEXTURE_2D,
        width=width,
        height=height,
        nchannel=3,
    )
    texture.data = data
    material = spec.add_material(name=name, texuniform=True, texrepeat=[1 / tile, 1 / tile])
    material.textures[mujoco.mjtTextureRole.mjTEXROLE_RGB] = name
    return name


def _pixels(path: Path) -> tuple[int, int, bytes]:
    try:
        from PIL import Image, UnidentifiedImageError  # noqa: PLC0415 - most worlds have no pictures
    except ImportError:
        raise TextureError("pictures need Pillow: pip install pillow") from None
    try:
        with warnings.catch_warnings():
            warnings.simplefilter("error", Image.DecompressionBombWarning)
            with Image.open(path) as picture:
                picture.draft("RGB", (LARGEST, LARGEST))
                picture.thumbnail((LARGEST, LARGEST))
                # MuJoCo begins below, pictures begin above
                shown = picture.convert("RGB").transpose(Image.Transpose.FLIP_TOP_BOTTOM)
    except FileNotFoundError:
        raise TextureError("No such file or directory") from None
    except UnidentifiedImageError:
        raise TextureError("it is no picture") from None
    except (
        OSError,
        ValueError,
        SyntaxError,
        Image.DecompressionBombError,
        Image.DecompressionBombWarning,
    ) as error:
        raise TextureError(str(error) or "it cannot be read") from None
    return shown.width, shown.height, shown.tobytes()
