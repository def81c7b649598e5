"""Conformance rules for mobile bases."""

from __future__ import annotations

import math

from robocomp_dsl.hardware.conformance.rule import (
    Advance,
    ConformanceRule,
    Violation,
    finite,
    require,
    require_later,
    rules,
)
from robocomp_dsl.hardware.devices.errors import CommandRefused
from robocomp_dsl.hardware.devices.mobile_base import MobileBaseDevice
from robocomp_dsl.hardware.kinematics.planar import ORIGIN, Pose

SLOW = 100.0
"""Speed of the drives (mm/s)."""


def a_state_is_made_of_numbers_and_goes_on(base: MobileBaseDevice, advance: Advance) -> None:
    """Poses in mm and rad, speeds in mm/s and rad/s, time in s."""
    advance(0.2)
    first = base.state()
    for name in ("odometry", "corrected"):
        pose = getattr(first, name)
        finite(name, (pose.x, pose.z, pose.alpha))
    finite("speeds", (first.side, first.adv, first.rot))
    advance(0.2)
    require_later("state", first.time, base.state().time)


def senseless_speeds_are_refused(base: MobileBaseDevice, _: Advance) -> None:
    """NaN, and values beyond the limits."""
    for adv in (math.nan, math.inf, 2 * base.limits.max_adv):
        try:
            base.set_speed(0.0, adv, 0.0)
        except CommandRefused:
            continue
        base.stop()
        raise Violation(f"`set_speed` takes {adv} mm/s, the limit is {base.limits.max_adv:g} mm/s")


def odometry_goes_on_from_where_it_is_set(base: MobileBaseDevice, advance: Advance) -> None:
    """Setting the corrected pose alone."""
    by_wheels, corrected = Pose(-200.0, 300.0, -0.5), Pose(1000.0, -500.0, 1.0)
    advance(0.1)
    base.set_odometry(by_wheels)
    base.correct(corrected)
    advance(0.1)
    state = base.state()
    _near("odometry", state.odometry, by_wheels)
    _near("corrected", state.corrected, corrected)


def it_drives_ahead_and_stops(base: MobileBaseDevice, advance: Advance) -> None:
    """100 mm/s for 1.5 s."""
    base.set_odometry(ORIGIN)
    base.set_speed(0.0, SLOW, 0.0)
    advance(1.5)
    driven = base.state()
    base.stop()
    advance(1.5)
    after = base.state()
    require(driven.moving, "it does not tell that it moves")
    require(
        60 < driven.odometry.z < 160, f"after 1.5 s it has gone {driven.odometry.z:.0f} mm ahead"
    )
    require(abs(driven.odometry.x) < 30, f"it went {driven.odometry.x:.0f} mm sideways")
    require(not after.moving and abs(after.adv) < SLOW / 4, f"it still drives {after.adv:.0f} mm/s")


def it_turns_from_ahead_to_the_right(base: MobileBaseDevice, advance: Advance) -> None:
    """Headings grow clockwise seen from above."""
    base.set_odometry(ORIGIN)
    base.set_speed(0.0, 0.0, 0.3)
    advance(1.5)
    base.stop()
    alpha = base.state().odometry.alpha
    advance(1.0)
    require(0.2 < alpha < 0.7, f"after 1.5 s at 0.3 rad/s it has turned by {alpha:.2f} rad")


def _near(name: str, found: Pose, expected: Pose) -> None:
    off = math.hypot(found.x - expected.x, found.z - expected.z)
    require(
        off < 20 and abs(found.alpha - expected.alpha) < 0.05,
        f"`{name}` is {found}, not {expected}",
    )


BASE = (
    *rules(
        a_state_is_made_of_numbers_and_goes_on,
        senseless_speeds_are_refused,
        odometry_goes_on_from_where_it_is_set,
    ),
    ConformanceRule(it_drives_ahead_and_stops, moves_robot=True),
    ConformanceRule(it_turns_from_ahead_to_the_right, moves_robot=True),
)
