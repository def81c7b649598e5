"""Pictures in any format that Pillow reads.

In: a path. Out: pixels, or the reason of the failure.
"""

from __future__ import annotations

import warnings
from pathlib import Path

import numpy as np

from robocomp_dsl.extras import MissingExtra
from robocomp_dsl.hardware.devices.display import Image

LARGEST = 1024
"""Maximum pixels per side; larger pictures are scaled down."""


class PictureError(Exception):
    """The picture cannot be read; the message gives the reason."""


def read_picture(path: Path) -> Image:
    """Shape (height, width, 3), rows from the top. Raises `PictureError`."""
    try:
        from PIL import Image as Pillow  # noqa: PLC0415 - most worlds have no pictures
        from PIL import UnidentifiedImageError  # noqa: PLC0415
    except ModuleNotFoundError as error:
        raise PictureError(str(MissingExtra("reading pictures", "simulation", error))) from None
    try:
        with warnings.catch_warnings():
            warnings.simplefilter("error", Pillow.DecompressionBombWarning)
            with Pillow.open(path) as picture:
                picture.draft("RGB", (LARGEST, LARGEST))
                picture.thumbnail((LARGEST, LARGEST))
                return np.asarray(picture.convert("RGB"))
    except FileNotFoundError:
        raise PictureError("No such file or directory") from None
    except UnidentifiedImageError:
        raise PictureError("it is no picture") from None
    except (
        OSError,
        ValueError,
        SyntaxError,
        Pillow.DecompressionBombError,
        Pillow.DecompressionBombWarning,
    ) as error:
        raise PictureError(str(error) or "it cannot be read") from None
