"""The truncated cone, its fit from points, and taxel position files."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from robocomp_dsl.tactile.errors import BadFit, DescriptionError
from robocomp_dsl.tactile.skin.cone import Cone, cartesian, cylindrical
from robocomp_dsl.tactile.skin.cone_fit import fit_cone
from robocomp_dsl.tactile.skin.positions import read_positions

FOREARM = Cone(0.02, 0.10, 0.032, 0.026)


@pytest.mark.parametrize(
    ("x", "theta", "point"),
    [
        (0.02, 0.0, (0.02, 0.0, 0.032)),
        (0.10, np.pi / 2, (0.10, 0.026, 0.0)),
        (0.06, np.pi, (0.06, 0.0, -0.029)),
    ],
)
def test_cone_points_satisfy_equation_six(x, theta, point):
    assert FOREARM.points(x, theta) == pytest.approx(point, abs=1e-12)


def test_cone_normals_are_orthogonal_to_surface():
    theta = np.linspace(-3, 3, 13)
    along = FOREARM.points(0.08, theta) - FOREARM.points(0.04, theta)
    angle = FOREARM.points(0.06, theta + 1e-6) - FOREARM.points(0.06, theta - 1e-6)
    normals = FOREARM.normals(theta)
    assert np.einsum("ij,ij->i", along, normals) == pytest.approx(np.zeros(13), abs=1e-12)
    assert np.einsum("ij,ij->i", angle, normals) == pytest.approx(np.zeros(13), abs=1e-12)
    assert np.linalg.norm(normals, axis=1) == pytest.approx(np.ones(13))
    assert (normals[:, 0] > 0).all()


@given(st.floats(-1, 1), st.floats(-3.1, 3.1), st.floats(0.01, 1))
def test_cone_coordinates_round_trip(x, theta, rho):
    assert cylindrical(cartesian(x, theta, rho)) == pytest.approx((x, theta, rho))


@pytest.mark.parametrize("wrong", [(0.1, 0.1, 1, 1), (0.2, 0.1, 1, 1), (0, 1, 0, 1), (0, 1, 1, -1)])
def test_cone_refuses_invalid_dimensions(wrong):
    with pytest.raises(ValueError, match="cone"):
        Cone(*wrong)


def rotation(seed: int) -> np.ndarray:
    q, _ = np.linalg.qr(np.random.default_rng(seed).normal(size=(3, 3)))
    return q * np.sign(np.linalg.det(q))


@settings(max_examples=30)
@given(st.integers(0, 10_000), st.floats(-0.3, 0.3), st.floats(0.02, 0.05), st.floats(0.05, 0.2))
def test_cone_fit_finds_tilted_cone(seed, slope, radius, length):
    points = Cone(0.0, length, radius, radius + slope * 0.05)
    rng = np.random.default_rng(seed)
    x = np.concatenate(([0.0, length], rng.uniform(0, length, 200)))
    local = points.points(x, rng.uniform(-np.pi, np.pi, len(x)))
    turn, shift = rotation(seed), rng.normal(size=3) * 0.1
    tilted = turn[:, 0] + 0.2 * turn[:, 1]
    fit = fit_cone(local @ turn.T + shift, axis=tilted)
    assert fit.rms < 1e-9
    assert abs(fit.axes[:, 0] @ turn[:, 0]) == pytest.approx(1.0, abs=1e-9)
    fitted = np.array([fit.cone.r0, fit.cone.r1, fit.cone.length])
    assert fitted == pytest.approx([points.r0, points.r1, length], abs=1e-7)


def test_cone_fit_of_noisy_half_covered_skin_is_as_good_as_noise():
    rng = np.random.default_rng(3)
    x, theta = rng.uniform(0, 0.07, 240), rng.uniform(-2, 2, 240)
    points = Cone(0.0, 0.07, 0.0372, 0.0332).points(x, theta)
    points = points[:, [1, 0, 2]] + rng.normal(size=points.shape) * 0.001
    fit = fit_cone(points)
    assert fit.axes[:, 0][1] > 0.99
    assert fit.rms == pytest.approx(0.001, rel=0.15)
    assert fit.cone.r0 == pytest.approx(0.0372, abs=0.001)
    assert fit.cone.r1 == pytest.approx(0.0332, abs=0.001)
    inside = fit.to_limb(points)[:, 0]
    assert inside.min() == pytest.approx(fit.cone.x0)


@pytest.mark.parametrize(
    ("points", "message"),
    [
        (np.zeros((20, 3)), "too few"),
        (np.random.default_rng(0).normal(size=(20, 3)) * [1, 1, 0], "one plane"),
        (np.full((20, 3), np.nan), "finite"),
        (np.zeros((20, 2)), "rows of three"),
    ],
)
def test_cone_fit_refuses_points_of_another_shape(points, message):
    with pytest.raises(BadFit, match=message):
        fit_cone(points)


NEW = """name l_forearm
spatial_sampling taxel
taxel2Repr ( 0 0 -1 )
[calibration]
0.01\t0.02\t0.03\t0 0 2
0 0 0 0 0 0
-0.01 0.02 0.03 0.6 0.8 0

[mapping]
this is of no concern
"""


def test_position_file_is_read_by_index():
    read = read_positions(NEW, Path("left.txt"))
    assert read.name == "l_forearm"
    assert read.used.tolist() == [True, False, True]
    assert read.positions[2] == pytest.approx([-0.01, 0.02, 0.03])
    assert read.normals[0] == pytest.approx([0, 0, 1])
    assert read.normals[1] == pytest.approx([0, 0, 0])


def test_position_file_of_older_form_has_plain_rows():
    read = read_positions("0.1 0 0 1 0 0\r\n0 0.1 0 0 0 0\r\n", Path("torso.txt"))
    assert read.name == "torso"
    assert read.used.all()
    assert read.normals[1] == pytest.approx([0, 0, 0])


@pytest.mark.parametrize(
    ("text", "places"),
    [
        ("[calibration]\n0 0 1 0 0\n0 0 1 0 0 1\n", [(2, 1, "it has 5")]),
        ("[calibration]\n0 0 1 x 0 nan\n", [(2, 7, "`x` is not"), (2, 11, "`nan` is not")]),
        ("[other]\n0 0 1 0 0 1\n", [(1, 1, "no [calibration] section")]),
        ("", [(1, 1, "no taxel")]),
        ("[calibration]\n", [(1, 1, "no taxel")]),
        ("1 2 3 4 5 6\n  7\n", [(2, 3, "it has 1")]),
    ],
)
def test_position_file_reports_faults_with_position(text, places):
    with pytest.raises(DescriptionError) as caught:
        read_positions(text, Path("f.txt"))
    findings = caught.value.findings
    assert [(f.location.line, f.location.column) for f in findings] == [
        (line, column) for line, column, _ in places
    ]
    assert all(messages in f.message for f, (_, _, messages) in zip(findings, places, strict=True))
