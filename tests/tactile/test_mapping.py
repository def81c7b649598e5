"""Equations 1 and 2: readings, commands, displacements, speeds, torques and limits."""

from __future__ import annotations

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from robocomp_dsl.simulation.robots.catalog import description
from robocomp_dsl.tactile.arm.mapping import PartMapping
from robocomp_dsl.tactile.errors import InvalidCommand

HALF_PI = np.pi / 2
FULL = np.full(5, -10.0), np.full(5, 10.0)


def mapping(gamma, sigma, *, low=FULL[0], high=FULL[1], available=(True,) * 5, to_si=1.0):
    return PartMapping(
        np.array(gamma, float),
        np.array(sigma, float),
        np.array(low, float),
        np.array(high, float),
        np.array(available),
        np.full(len(gamma), to_si),
    )


NAO_LEFT = mapping([-1, 1, 1, -1, 1], [HALF_PI, 0, HALF_PI, 0, 0])
NAO_RIGHT = mapping([-1, -1, -1, 1, -1], [HALF_PI, 0, HALF_PI, 0, 0])
DEGREES = np.pi / 180
ICUB = mapping(
    np.array([-1, 1, 1, 1, 1]) * DEGREES,
    [0] * 5,
    low=[-200] * 5,
    high=[200] * 5,
    to_si=DEGREES,
)
NO_WRIST = mapping(
    [-1, -1, -1, 1, 1], [HALF_PI, 0, HALF_PI, 0, 0.25], available=[True] * 4 + [False]
)


@pytest.mark.parametrize(
    ("part", "device", "degrees"),
    [  # the right arms of the paper's first listing
        (NAO_RIGHT, [1.19, -1.10, 2.07, 0.04, 0.0], [21.8, 63.0, -28.6, 2.3, 0.0]),
        (ICUB, [-16.1, 83.3, 0.0, 15.5, -59.0], [16.1, 83.3, 0.0, 15.5, -59.0]),
    ],
)
def test_mapping_reads_listing_in_generic_degrees(part, device, degrees):
    assert np.rad2deg(part.read(np.array(device))) == pytest.approx(degrees, abs=0.05)


def test_mapping_zero_lets_arm_hang():
    assert NAO_LEFT.command(np.zeros(5)).values == pytest.approx([HALF_PI, 0, -HALF_PI, 0, 0])


def test_mapping_swaps_limits_for_negative_gamma_and_clips_in_device_units():
    part = mapping([-1], [HALF_PI], low=[-0.3], high=[1.3], available=[True])
    low, high = part.limits
    assert (low[0], high[0]) == pytest.approx((HALF_PI - 1.3, HALF_PI + 0.3))
    sent = part.command(np.array([HALF_PI + 1.0]))
    assert sent.values == pytest.approx([-0.3])
    assert sent.clipped.tolist() == [True]


def test_mapping_displacements_ignore_sigma_and_speeds_are_positive():
    moved = NAO_LEFT.displacement(np.full(5, 0.1)).values
    assert moved == pytest.approx([-0.1, 0.1, 0.1, -0.1, 0.1])
    assert NAO_LEFT.speed(np.full(5, 0.5)).values == pytest.approx([0.5] * 5)
    assert ICUB.speed(np.full(5, 0.5)).values == pytest.approx([np.rad2deg(0.5)] * 5)
    assert ICUB.velocity(np.full(5, 0.5)).values[0] == pytest.approx(-np.rad2deg(0.5))


def test_mapping_of_missing_joint_reads_sigma_and_drops_commands():
    assert NO_WRIST.read(np.zeros(4))[4] == 0.25
    sent = NO_WRIST.command(np.array([0, 0, 0, 0, 0.7]))
    assert len(sent.values) == 4
    assert sent.dropped.tolist() == [False, False, False, False, True]
    assert not NO_WRIST.command(np.array([0, 0, 0, 0, 0.25])).dropped.any()
    assert NO_WRIST.displacement(np.full(5, 0.1)).dropped.tolist() == [False] * 4 + [True]
    low, high = NO_WRIST.limits
    assert low[4] == high[4] == 0.25
    assert NO_WRIST.read_speed(np.ones(4))[4] == NO_WRIST.read_torque(np.ones(4))[4] == 0.0


@pytest.mark.parametrize("bad", [[np.nan] * 5, [np.inf, 0, 0, 0, 0], [0.0] * 4])
def test_mapping_refuses_invalid_commands(bad):
    with pytest.raises(InvalidCommand):
        NAO_LEFT.command(np.array(bad, float))


@pytest.mark.parametrize("wrong", [{"gamma": [0.0]}, {"low": [2.0], "high": [1.0]}])
def test_mapping_refuses_invalid_construction(wrong):
    given_ = {"gamma": [1.0], "low": [0.0], "high": [1.0]} | wrong
    with pytest.raises(ValueError, match=r"gamma|limit"):
        mapping(given_["gamma"], [0.0], low=given_["low"], high=given_["high"], available=[True])


numbers = st.floats(-3, 3)
gammas = st.floats(0.01, 60).map(lambda g: g) | st.floats(-60, -0.01)


@given(gammas, numbers, numbers, numbers)
def test_mapping_reads_back_its_command(gamma, sigma, generic, torque):
    part = mapping([gamma], [sigma], low=[-1e6], high=[1e6], available=[True], to_si=DEGREES)
    back = part.read(part.command(np.array([generic])).values)
    assert back == pytest.approx([generic], abs=1e-9)
    assert part.read_torque(part.torque(np.array([torque])).values) == pytest.approx([torque])


@given(gammas, numbers, numbers)
def test_mapping_of_torque_and_speed_conserves_power(gamma, torque, speed):
    part = mapping([gamma], [0.0], available=[True], low=[-1], high=[1], to_si=DEGREES)
    device = part.velocity(np.array([speed])).values * DEGREES
    assert part.torque(np.array([torque])).values * device == pytest.approx([torque * speed])


@given(gammas, numbers, st.floats(0.1, 100))
def test_mapping_of_stiffness_conserves_energy(gamma, moved, stiffness):
    part = mapping([gamma], [0.0], available=[True], low=[-1], high=[1], to_si=DEGREES)
    device = part.displacement(np.array([moved])).values * DEGREES
    energy = part.stiffness(np.array([stiffness])).values * device**2
    assert energy == pytest.approx([stiffness * moved**2], abs=1e-12)


def test_joint_positions_invert_readings_without_clipping() -> None:
    mapping = description("icub_v2").part("left_arm").mapping
    degrees = np.array([-40.0, 200.0, 10.0, 60.0, 5.0])  # the second is beyond its limit
    positions = mapping.joint_positions(mapping.read(degrees))
    assert positions == pytest.approx(np.radians(degrees))
