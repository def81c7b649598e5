"""Conformance rules for range finders."""

from __future__ import annotations

import numpy as np

from robocomp_dsl.hardware.conformance.rule import Advance, finite, require, require_later, rules
from robocomp_dsl.hardware.devices.laser import LaserDevice, Scan
from robocomp_dsl.hardware.devices.ultrasound import UltrasoundDevice

_SCANS = 3.0
"""Maximum number of periods until a new scan."""


def a_scan_has_as_many_rays_as_the_settings_say(laser: LaserDevice, advance: Advance) -> None:
    """Angles and distances are arrays of 32-bit floats, one entry per ray."""
    scan, n = _fresh(laser, advance), laser.settings.measures
    for name, values in (("angles", scan.angles), ("distances", scan.distances)):
        require(values.shape == (n,), f"`{name}` has the shape {values.shape}, not ({n},)")
        require(values.dtype == np.float32, f"`{name}` has the type {values.dtype}, not float32")


def angles_go_from_left_to_right_as_set(laser: LaserDevice, advance: Advance) -> None:
    """In rad, negative on the left."""
    found, expected = _fresh(laser, advance).angles, laser.settings.angles()
    off = float(np.abs(found - expected).max()) if found.shape == expected.shape else np.inf
    require(off < 1e-3, f"angles differ by up to {off:.4f} rad from those of the settings")


def distances_lie_within_the_range(laser: LaserDevice, advance: Advance) -> None:
    """In mm; without a hit the value is the maximum range."""
    scan, it = _fresh(laser, advance), laser.settings
    finite("distances", scan.distances)
    low, high = float(scan.distances.min()), float(scan.distances.max())
    message = f"distances from {low:g} to {high:g} mm leave {it.min_range:g} to {it.max_range:g} mm"
    require(it.min_range - 0.5 <= low and high <= it.max_range + 0.5, message)


def scans_follow_each_other(laser: LaserDevice, advance: Advance) -> None:
    """A new scan arrives within three periods, and the old one is unchanged."""
    first = _fresh(laser, advance)
    before = first.distances.copy()
    advance(_SCANS * laser.settings.period)
    require_later("scan", first.time, laser.scan().time)
    require(np.array_equal(first.distances, before), "a scan was written over by the next one")


def _fresh(laser: LaserDevice, advance: Advance) -> Scan:
    advance(_SCANS * laser.settings.period)
    return laser.scan()


def a_distance_is_a_length(sonar: UltrasoundDevice, advance: Advance) -> None:
    """In mm, not negative."""
    advance(0.2)
    found = sonar.distance()
    finite("distance", found)
    require(found >= 0, f"the distance is {found:g} mm")


def it_knows_where_it_is_mounted(sonar: UltrasoundDevice, _: Advance) -> None:
    """On the robot, in mm and rad."""
    pose = sonar.mounted()
    finite("mounted", (pose.x, pose.z, pose.alpha))


LASER = rules(
    a_scan_has_as_many_rays_as_the_settings_say,
    angles_go_from_left_to_right_as_set,
    distances_lie_within_the_range,
    scans_follow_each_other,
)
ULTRASOUND = rules(a_distance_is_a_length, it_knows_where_it_is_mounted)
