"""What range finders keep to."""

from __future__ import annotations

import numpy as np

from robocomp_dsl.hardware.laser import LaserDevice, Scan
from robocomp_dsl.hardware.rules.rule import Pass, finite, later, must, rules
from robocomp_dsl.hardware.ultrasound import UltrasoundDevice

_SCANS = 3.0
"""Periods within which a new scan must have come."""


def a_scan_has_as_many_rays_as_the_settings_say(laser: LaserDevice, passes: Pass) -> None:
    """Angles and distances are arrays of 32 bits, one entry a ray."""
    scan, n = _fresh(laser, passes), laser.settings.measures
    for name, values in (("angles", scan.angles), ("distances", scan.distances)):
        must(values.shape == (n,), f"`{name}` has the shape {values.shape}, not ({n},)")
        must(values.dtype == np.float32, f"`{name}` is made of {values.dtype}, not float32")


def angles_go_from_left_to_right_as_set(laser: LaserDevice, passes: Pass) -> None:
    """In rad, negative on the left."""
    found, wanted = _fresh(laser, passes).angles, laser.settings.angles()
    off = float(np.abs(found - wanted).max()) if found.shape == wanted.shape else np.inf
    must(off < 1e-3, f"angles differ by up to {off:.4f} rad from those of the settings")


def distances_lie_within_the_range(laser: LaserDevice, passes: Pass) -> None:
    """In mm; what is absent or too far reads the largest."""
    scan, it = _fresh(laser, passes), laser.settings
    finite("distances", scan.distances)
    low, high = float(scan.distances.min()), float(scan.distances.max())
    said = f"distances from {low:g} to {high:g} mm leave {it.min_range:g} to {it.max_range:g} mm"
    must(it.min_range - 0.5 <= low and high <= it.max_range + 0.5, said)


def scans_follow_each_other(laser: LaserDevice, passes: Pass) -> None:
    """A new scan comes within three periods, and the old one stays as it was."""
    first = _fresh(laser, passes)
    kept = first.distances.copy()
    passes(_SCANS * laser.settings.period)
    later("scan", first.time, laser.scan().time)
    must(np.array_equal(first.distances, kept), "a scan was written over by the next one")


def _fresh(laser: LaserDevice, passes: Pass) -> Scan:
    passes(_SCANS * laser.settings.period)
    return laser.scan()


def a_distance_is_a_length(sonar: UltrasoundDevice, passes: Pass) -> None:
    """In mm, not negative."""
    passes(0.2)
    found = sonar.distance()
    finite("distance", found)
    must(found >= 0, f"the distance is {found:g} mm")


def it_knows_where_it_is_mounted(sonar: UltrasoundDevice, _: Pass) -> None:
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
