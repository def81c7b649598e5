"""Conformance rules for cameras."""

from __future__ import annotations

import numpy as np

from robocomp_dsl.hardware.conformance.rule import Advance, require, require_later, rules
from robocomp_dsl.hardware.devices.camera import CameraDevice


def a_picture_has_the_size_of_the_settings(camera: CameraDevice, advance: Advance) -> None:
    """Rows, columns and three colours of 8 bits."""
    advance(2 * camera.settings.period)
    seen, it = camera.picture().colour, camera.settings
    expected = (it.height, it.width, 3)
    require(seen.shape == expected, f"`colour` has the shape {seen.shape}, not {expected}")
    require(seen.dtype == np.uint8, f"`colour` has the type {seen.dtype}, not uint8")


def a_depth_is_a_distance_or_infinite(camera: CameraDevice, advance: Advance) -> None:
    """In mm along the axis, for each pixel."""
    advance(2 * camera.settings.period)
    depth, it = camera.picture().depth, camera.settings
    require(depth.shape == (it.height, it.width), f"`depth` has the shape {depth.shape}")
    require(depth.dtype == np.float32, f"`depth` has the type {depth.dtype}, not float32")
    require(not np.isnan(depth).any() and (depth >= 0).all(), "`depth` holds NaN or is negative")


def pictures_follow_each_other(camera: CameraDevice, advance: Advance) -> None:
    """A new picture arrives within three periods, and the old one is unchanged."""
    advance(2 * camera.settings.period)
    first = camera.picture()
    before = first.colour.copy()
    advance(3 * camera.settings.period)
    require_later("picture", first.time, camera.picture().time)
    require(np.array_equal(first.colour, before), "a picture was written over by the next one")


CAMERA = rules(a_picture_has_the_size_of_the_settings, pictures_follow_each_other)
RGBD = (*CAMERA, *rules(a_depth_is_a_distance_or_infinite))
