"""The force and distance law: the acceptance table, and what must hold for every touch."""

from __future__ import annotations

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from robocomp_dsl.tactile.reflex.law import Field, Law, respond, stimulus, total_motion
from robocomp_dsl.tactile.skin.cone import cartesian
from robocomp_dsl.tactile.skin.touches import clusters

THETA = np.array([-0.2, 0.3, 0.0, 0.5, 0.1])
LAW = Law(1.0, 10.0)
FIELD = Field("bottom", "lower_arm", np.array([0.05, 0.0, 0.03]), 0.03, THETA)
RHO = 0.03


def taxels(*rows):
    x, theta, force = np.array(rows, float).T
    return cartesian(x, theta, RHO), force


def motion(*rows) -> np.ndarray:
    points, forces = taxels(*rows)
    answers = [respond(LAW, FIELD, points[i], forces[i]) for i in clusters(points)]
    return total_motion([answer for answer in answers if answer], 5)


@pytest.mark.parametrize(
    ("rows", "gain"),
    [
        ([(0.05, 0, 10)], 1.0),
        ([(0.05, 0, 5.5)], 0.5),
        ([(0.065, 0, 10)], 0.5),
        ([(0.065, 0, 5.5)], 0.25),
        ([(0.05, np.pi / 6, 10)], 0.482362),
        ([(0.08, 0, 10)], 0.0),
        ([(0.0797, 0, 10)], 0.01),
        ([(0.05, 0, 1.0)], 0.0),
        ([(0.05, 0, 1.09)], 0.01),
        ([(0.05, 0, 20)], 1.0),
        ([(0.045, 0, 2), (0.055, 0, 6)], 0.314815),
        ([(0.05, 0, 10), (0.05, np.pi, 10)], 1.0),
        ([(0.05, 0, 10), (0.20, 0, 1.5)], 1.0),
    ],
)
def test_gain_matches_acceptance_table(rows, gain):
    assert motion(*rows) == pytest.approx(gain * THETA, abs=1e-6)


def test_gain_is_zero_at_threshold_and_edge():
    for rows in ([(0.08, 0, 10)], [(0.05, 0, 1.0)]):
        assert not motion(*rows).any()


def test_gain_of_case_seven_matches_each_step():
    felt = stimulus(*taxels((0.045, 0, 2), (0.055, 0, 6)), 0.03)
    assert felt.centre == pytest.approx([0.0525, 0, 0.03])
    assert felt.force == pytest.approx(4.090909, abs=1e-6)
    answer = respond(LAW, FIELD, *taxels((0.045, 0, 2), (0.055, 0, 6)))
    assert answer.distance == pytest.approx(0.0025)
    assert LAW.force_factor(felt.force) == pytest.approx(0.343434, abs=1e-6)
    assert FIELD.distance_factor(answer.distance) == pytest.approx(0.916667, abs=1e-6)
    expected = (-0.062963, 0.094444, 0, 0.157407, 0.031481)
    assert answer.motion == pytest.approx(expected, abs=1e-6)


def test_gain_weights_of_distant_taxels_are_not_negative():
    answer = respond(LAW, FIELD, *taxels((0.05, 0, 10), (0.20, 0, 1.5)))
    assert answer.gain == pytest.approx(1.0)


def test_reflex_motion_of_no_force_is_zero():
    assert respond(LAW, FIELD, *taxels((0.05, 0, 0))) is None
    assert respond(LAW, FIELD, np.empty((0, 3)), np.empty(0)) is None
    assert not total_motion([], 5).any()


def test_reflex_motion_adds_overlapping_fields():
    other = Field("side", "lower_arm", np.array([0.06, 0.0, 0.03]), 0.03, np.full(5, 0.1))
    point = taxels((0.05, 0, 10))
    both = [respond(LAW, field, *point) for field in (FIELD, other)]
    assert total_motion(both, 5) == pytest.approx(THETA + (1 - 0.01 / 0.03) * 0.1)


@pytest.mark.parametrize("wrong", [(1, 1), (2, 1), (-1, 1)])
def test_gain_refuses_invalid_thresholds(wrong):
    with pytest.raises(ValueError, match="threshold"):
        Law(*wrong)


def gain(points, forces) -> float:
    answer = respond(LAW, FIELD, points, forces)
    return answer.gain if answer else 0.0


places = st.tuples(st.floats(0.02, 0.08), st.floats(-0.8, 0.8), st.floats(0.05, 12))
touches = st.lists(places, min_size=1, max_size=12)


@given(touches, st.floats(1.0, 3.0))
def test_gain_does_not_decrease_with_force(rows, harder):
    points, forces = taxels(*rows)
    assert gain(points, forces * harder) >= gain(points, forces) - 1e-12


@given(st.floats(-np.pi, np.pi), st.floats(0, 0.04), st.floats(0, 0.01), st.floats(1, 15))
def test_gain_does_not_increase_with_distance(way, near, further, force):
    def at(distance):
        step = distance * np.array([np.cos(way), np.sin(way), 0.0])
        return gain((FIELD.centre + step)[None], np.array([force]))

    assert at(near + further) <= at(near) + 1e-12
    assert 0.0 <= at(near) <= 1.0


@given(touches, st.integers(0, 11), st.floats(-1e-9, 1e-9))
def test_stimulus_is_continuous_in_force(rows, which, change):
    points, forces = taxels(*rows)
    other = forces.copy()
    other[which % len(forces)] += change
    radius = 0.2  # wide enough that no taxel is left out
    smaller, two = stimulus(points, forces, radius), stimulus(points, other, radius)
    assert two.force == pytest.approx(smaller.force, abs=1e-7)
    assert two.centre == pytest.approx(smaller.centre, abs=1e-8)


@given(touches)
def test_stimulus_force_lies_between_taxel_forces(rows):
    points, forces = taxels(*rows)
    felt = stimulus(points, forces, FIELD.radius)
    if felt:
        assert forces.min() - 1e-9 <= felt.force <= forces.max() + 1e-9
