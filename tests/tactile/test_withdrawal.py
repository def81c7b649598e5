"""The goal and the duration of a withdrawal."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from robocomp_dsl.tactile.reflex.law import Field, Response, Stimulus
from robocomp_dsl.tactile.reflex.withdrawal import (
    ArmProperties,
    Withdrawal,
    add_responses,
    duration,
    initial,
    max_joint_distance,
    new_responses,
)
from tests.tactile.reflex_samples import OTHER, THETA

START = np.array([0.4, 0.2, 0.3, 0.6, 0.0])

ALL = np.ones(5, bool)

FACTS = ArmProperties(np.full(5, -0.5), np.full(5, 1.2), np.full(5, 2.0), START, ALL)


def response(gain: float, name: str = "a", motion: np.ndarray = THETA) -> Response:
    field = Field(name, "lower", np.zeros(3), 0.03, motion)
    return Response(field, Stimulus(np.zeros(3), 1.0), 0.0, gain, np.array([0.0, 0.0, -1.0]))


def withdrawn(*frames: list[Response], facts: ArmProperties = FACTS) -> Withdrawal:
    """What comes of the responses of one frame after the other."""
    withdrawal = initial(START, 7.0)
    for responses in frames:
        withdrawal = add_responses(withdrawal, responses, facts)
    return withdrawal


@pytest.mark.parametrize(
    ("frames", "motion"),
    [
        ([], 0 * THETA),
        ([[]], 0 * THETA),
        ([[response(0.5)]], 0.5 * THETA),
        ([[response(g)] for g in (0.01, 0.3, 0.7, 0.5)], 0.7 * THETA),  # it goes by its peak
        ([[response(0.5), response(1.0, "b", OTHER)]], 0.5 * THETA + OTHER),
        ([[response(0.5)], [response(1.0, "b", OTHER)]], 0.5 * THETA + OTHER),
        ([[response(0.5)], [], [response(0.2)]], 0.5 * THETA),
        ([[response(0.2), response(0.6)]], 0.6 * THETA),  # two touches in one field
    ],
)
def test_reflex_counts_strongest_response_of_each_field(frames, motion):
    withdrawal = withdrawn(*frames)
    assert withdrawal.goal == pytest.approx(START + motion)
    assert withdrawal.began == 7.0
    assert withdrawal.origin is START


def test_reflex_news_are_responses_that_count_anew():
    weak, strong, other = response(0.2), response(0.6), response(0.5, "b", OTHER)
    before = withdrawn([weak])
    assert new_responses(before, add_responses(before, [strong, other], FACTS)) == [strong, other]
    assert new_responses(before, add_responses(before, [response(0.1)], FACTS)) == []


def test_reflex_goals_stay_within_limits_and_missing_joints_stay_put():
    motion = withdrawn([response(1.0, "b", 50 * OTHER), response(1.0, "c", -50 * THETA)])
    assert (motion.goal >= FACTS.low).all()
    assert (motion.goal <= FACTS.high).all()
    lacking = ArmProperties(
        FACTS.low, np.full(5, 0.1), FACTS.speed, START, np.array([True] * 4 + [False])
    )
    motion = withdrawn([response(1.0, motion=np.ones(5))], facts=lacking)
    assert motion.goal == pytest.approx([0.1, 0.1, 0.1, 0.1, START[4]])


@given(st.lists(st.lists(st.floats(0.0, 1.0), min_size=1, max_size=3), max_size=8))
def test_reflex_never_takes_back_withdrawal(gains):
    motion, far = initial(START, 0.0), 0.0
    for frame in gains:
        motion = add_responses(
            motion, [response(g, n) for g, n in zip(frame, "abc", strict=False)], FACTS
        )
        assert max_joint_distance(motion.goal, START) >= far - 1e-12
        far = max_joint_distance(motion.goal, START)


def test_reflex_motion_lasts_as_long_as_slowest_joint():
    speed = np.array([1.0, 0.5, 2.0, 0.0, 1.0])
    assert duration(np.zeros(5), np.array([1.0, -1.0, 1.0, 1.0, 0.0]), speed) == 2.0
    assert duration(START, START, speed) == 0.0


@pytest.mark.parametrize(
    ("changes", "message"),
    [
        ({"low": np.zeros(4)}, "differ in length"),
        ({"available": np.ones(4, bool)}, "one entry per joint"),
        ({"start": np.full(5, np.nan)}, "NaN"),
        ({"high": np.full(5, -0.6)}, "above its upper"),
        ({"speed": np.zeros(5)}, "speed limit of 0"),
    ],
)
def test_reflex_refuses_invalid_arm_facts(changes, message):
    with pytest.raises(ValueError, match=message):
        replace(FACTS, **changes)


def test_reflex_ignores_facts_of_missing_joints():
    nothing = np.array([False] * 5)
    wild = np.full(5, np.nan)
    assert ArmProperties(wild, wild, wild, wild, nothing).within(THETA, START) == pytest.approx(
        START
    )
