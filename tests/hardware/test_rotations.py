"""Euler angles of rotations: of the two solutions the one of the smaller norm."""

from __future__ import annotations

import math

import numpy as np
import pytest

from robocomp_dsl.hardware.kinematics.rotations import angles, heading, rotation

DEGREES = range(-180, 181)


@pytest.mark.parametrize("axis", range(3), ids="xyz")
def test_angles_of_turn_about_one_axis_are_one_angle_and_two_zeros(axis: int) -> None:
    for degrees in DEGREES:
        turn = [0.0, 0.0, 0.0]
        turn[axis] = math.radians(degrees)
        found = list(angles(rotation(*turn)))
        if abs(degrees) == 180:  # both signs are the same rotation
            found[axis] = math.copysign(found[axis], degrees)
        assert found == pytest.approx(turn, abs=1e-12), degrees


@pytest.mark.parametrize("seed", range(3))
def test_angles_reproduce_random_rotations_with_smaller_norm(seed: int) -> None:
    random = np.random.default_rng(seed)
    for written in random.uniform(-math.pi, math.pi, (2000, 3)).tolist():
        turned = rotation(*written)
        rx, ry, rz = found = angles(turned)
        assert rotation(*found) == pytest.approx(turned, abs=1e-12)
        for solution in (written, (rx + math.pi, math.pi - ry, rz + math.pi)):
            wrapped = [math.remainder(angle, math.tau) for angle in solution]
            assert math.hypot(*found) <= math.hypot(*wrapped) + 1e-9


@pytest.mark.parametrize("ry", [math.pi / 2, -math.pi / 2])
def test_angles_of_upright_rotation_have_no_rz(ry: float) -> None:
    for rx in np.linspace(-3, 3, 13).tolist():
        assert angles(rotation(rx, ry, 0)) == pytest.approx((rx, ry, 0), abs=1e-9)


def test_angles_have_no_negative_zero() -> None:
    assert [str(angle) for angle in angles(np.eye(3))] == ["0.0", "0.0", "0.0"]


def test_heading_of_tilted_rotation_is_direction_of_z_axis() -> None:
    for degrees in DEGREES:
        turned = rotation(0, math.radians(degrees), 0) @ rotation(0.4, 0, -0.3)
        expected = math.radians(degrees)
        assert math.sin(heading(turned) - expected) == pytest.approx(0, abs=1e-12)
        assert math.cos(heading(turned) - expected) == pytest.approx(1)
