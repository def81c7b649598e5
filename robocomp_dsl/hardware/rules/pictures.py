"""What cameras keep to."""

from __future__ import annotations

import numpy as np

from robocomp_dsl.hardware.camera import CameraDevice
from robocomp_dsl.hardware.rules.rule import Pass, later, must, rules


def a_picture_has_the_size_of_the_settings(camera: CameraDevice, passes: Pass) -> None:
    """Rows, columns and three colours of 8 bits."""
    passes(2 * camera.settings.period)
    seen, it = camera.picture().colour, camera.settings
    wanted = (it.height, it.width, 3)
    must(seen.shape == wanted, f"`colour` has the shape {seen.shape}, not {wanted}")
    must(seen.dtype == np.uint8, f"`colour` is made of {seen.dtype}, not uint8")


def a_depth_is_a_distance_or_infinite(camera: CameraDevice, passes: Pass) -> None:
    """In mm along the axis, for each pixel."""
    passes(2 * camera.settings.period)
    depth, it = camera.picture().depth, camera.settings
    must(depth.shape == (it.height, it.width), f"`depth` has the shape {depth.shape}")
    must(depth.dtype == np.float32, f"`depth` is made of {depth.dtype}, not float32")
    must(not np.isnan(depth).any() and (depth >= 0).all(), "`depth` holds NaN or is negative")


def pictures_follow_each_other(camera: CameraDevice, passes: Pass) -> None:
    """A new one comes within three periods, and the old one stays as it was."""
    passes(2 * camera.settings.period)
    first = camera.picture()
    kept = first.colour.copy()
    passes(3 * camera.settings.period)
    later("picture", first.time, camera.picture().time)
    must(np.array_equal(first.colour, kept), "a picture was written over by the next one")


CAMERA = rules(a_picture_has_the_size_of_the_settings, pictures_follow_each_other)
RGBD = (*CAMERA, *rules(a_depth_is_a_distance_or_infinite))
