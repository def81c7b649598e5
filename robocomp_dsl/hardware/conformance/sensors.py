"""Conformance rules for sensors with a few values."""

from __future__ import annotations

import math

from robocomp_dsl.hardware.conformance.rule import Advance, finite, require, require_later, rules
from robocomp_dsl.hardware.devices.battery import BatteryDevice
from robocomp_dsl.hardware.devices.gps import GpsDevice
from robocomp_dsl.hardware.devices.imu import ImuDevice
from robocomp_dsl.hardware.devices.touch_sensor import TouchSensorDevice

GRAVITY = 9.81
REST_MM = 5000.0
"""Permitted drift of a receiver at rest."""


def at_rest_it_feels_gravity(imu: ImuDevice, advance: Advance) -> None:
    """About 9.81 m/s², and almost no rotation (rad/s)."""
    advance(0.5)
    it = imu.measure()
    felt = math.hypot(*it.acceleration)
    require(abs(felt - GRAVITY) < 0.7, f"the acceleration at rest is {felt:.2f} m/s²")
    require(
        math.hypot(*it.angular_velocity) < 0.2, f"at rest it turns by {it.angular_velocity} rad/s"
    )


def the_magnetic_field_is_a_direction(imu: ImuDevice, advance: Advance) -> None:
    """Of unit length."""
    advance(0.1)
    length = math.hypot(*imu.measure().field)
    require(abs(length - 1) < 0.01, f"`field` has the length {length:.3f}")


def reset_makes_this_orientation_the_reference(imu: ImuDevice, advance: Advance) -> None:
    """All angles are 0 then."""
    advance(0.1)
    imu.reset()
    advance(0.1)
    angles = imu.measure().orientation
    require(max(map(abs, angles)) < 0.05, f"after `reset` the orientation is {angles} rad")


def measurements_follow_each_other(imu: ImuDevice, advance: Advance) -> None:
    """Each with its time in s."""
    advance(0.05)
    first = imu.measure().time
    advance(0.05)
    require_later("measure", first, imu.measure().time)


def it_is_somewhere_on_the_globe(gps: GpsDevice, advance: Advance) -> None:
    """Latitude and longitude in degrees."""
    advance(0.2)
    place = gps.place()
    finite("place", (place.latitude, place.longitude, place.altitude))
    message = f"{place.latitude:g}, {place.longitude:g} is no place"
    require(abs(place.latitude) <= 90 and abs(place.longitude) <= 180, message)


def reset_makes_this_position_the_origin(gps: GpsDevice, advance: Advance) -> None:
    """Within the permitted drift of a receiver at rest."""
    advance(0.2)
    gps.reset()
    advance(0.2)
    far = math.hypot(*gps.position())
    require(far < REST_MM, f"after `reset` it is {far:g} mm from the origin")


def a_charge_is_a_share(battery: BatteryDevice, advance: Advance) -> None:
    """Charge from 0 to 1; voltage (V) above 0, power (W) and remaining time (s) not negative."""
    advance(0.1)
    it = battery.charge()
    require(0 <= it.left <= 1, f"`left` is {it.left:g} of 1")
    require(it.voltage > 0 and math.isfinite(it.voltage), f"`voltage` is {it.voltage:g} V")
    require(it.power >= 0 and it.remaining >= 0, f"{it.power:g} W for {it.remaining:g} s more")


def it_feels_a_force_or_nothing(sensor: TouchSensorDevice, advance: Advance) -> None:
    """In N, or 1 and 0."""
    advance(0.1)
    found = sensor.value()
    finite("value", found)
    require(found >= 0, f"the value is {found:g}")


IMU = rules(
    at_rest_it_feels_gravity,
    the_magnetic_field_is_a_direction,
    reset_makes_this_orientation_the_reference,
    measurements_follow_each_other,
)
GPS = rules(it_is_somewhere_on_the_globe, reset_makes_this_position_the_origin)
BATTERY = rules(a_charge_is_a_share)
TOUCH = rules(it_feels_a_force_or_nothing)
