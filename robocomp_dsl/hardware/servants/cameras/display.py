"""`Display` over a screen: images are checked before they are shown."""

# ruff: noqa: N802, N803  called as in the interface

from __future__ import annotations

from pathlib import Path
from typing import Any

import numpy as np

from robocomp_dsl.hardware.devices.display import DisplayDevice
from robocomp_dsl.hardware.devices.errors import CommandRefused
from robocomp_dsl.hardware.servants.servant import Servant

_GREY, _COLOURED = 1, (3, 4)
"""Channels; a fourth channel is ignored."""


class DisplayServant(Servant):
    """One screen."""

    @property
    def _screen(self) -> DisplayDevice:
        found: DisplayDevice = self.device()
        return found

    def setImage(self, img: Any) -> None:
        """Show an image."""
        width, height, depth = img.width, img.height, img.depth
        if min(width, height) < 1 or (depth != _GREY and depth not in _COLOURED):
            raise CommandRefused(f"{width} x {height} pixels of {depth} bytes are no image")
        pixels = np.asarray(img.Img, dtype=np.uint8)
        if pixels.size != width * height * depth:
            raise CommandRefused(
                f"{width} x {height} pixels of {depth} bytes are {width * height * depth} bytes, "
                f"not {pixels.size}"
            )
        shaped = pixels.reshape(height, width, depth)[:, :, :3]
        self._screen.show(np.broadcast_to(shaped, (height, width, 3)).copy())

    def setImageFromFile(self, pathImg: str) -> None:
        """Show the image in a file on the machine of the simulator."""
        from robocomp_dsl.hardware.formats.picture_file import PictureError, read_picture  # noqa: PLC0415 - most worlds have none

        try:
            image = read_picture(Path(pathImg))
        except PictureError as error:
            raise CommandRefused(f"`{pathImg}` cannot be shown: {error}") from None
        self._screen.show(image)
