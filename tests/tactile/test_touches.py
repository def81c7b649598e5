"""Touches from taxels, normalised forces, calibration and compensation."""

from __future__ import annotations

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from robocomp_dsl.tactile.skin import triangle
from robocomp_dsl.tactile.skin.manager import Compensation, SkinManager
from robocomp_dsl.tactile.skin.normalise import Normaliser, Sensitivity
from robocomp_dsl.tactile.skin.touches import TaxelGraph, clusters

LINE = np.arange(10)[:, None] * [0.01, 0, 0]


@pytest.mark.parametrize(
    ("touched", "expected"),
    [
        ([], []),
        ([3], [[3]]),
        ([2, 3, 4], [[2, 3, 4]]),
        ([0, 2, 3, 7], [[0], [2, 3], [7]]),
        ([9, 0, 1, 8], [[0, 1], [8, 9]]),
    ],
)
def test_touches_are_connected_neighbours(touched, expected):
    mask = np.zeros(10, bool)
    mask[touched] = True
    found = TaxelGraph.of(LINE).touches(mask)
    assert [touch.tolist() for touch in found] == expected


def test_touches_reach_is_inclusive_and_limbs_are_separate():
    pair = np.array([[0, 0, 0], [0.015, 0, 0]])
    assert len(clusters(pair)) == 1
    assert len(clusters(pair * 1.001)) == 2
    apart = TaxelGraph.of(pair, np.array([0, 1]))
    assert len(apart.touches(np.ones(2, bool))) == 2
    assert clusters(np.empty((0, 3))) == []


@settings(max_examples=50)
@given(st.integers(0, 1000), st.integers(1, 60))
def test_touches_agree_with_breadth_first_search(seed, count):
    points = np.random.default_rng(seed).uniform(0, 0.08, (count, 3))
    left, groups = set(range(count)), []
    while left:
        group, todo = set(), [min(left)]
        while todo:
            touch = todo.pop()
            group.add(touch)
            near = np.linalg.norm(points - points[touch], axis=1) <= 0.015
            todo += [k for k in np.flatnonzero(near) if k not in group]
        left -= group
        groups.append(sorted(group))
    assert [cluster.tolist() for cluster in clusters(points)] == groups


def test_touch_forces_are_normalised_per_patch():
    skin = Normaliser.of([Sensitivity(0.05, 2, 200), Sensitivity()], np.array([0, 0, 0, 1]))
    assert skin.force(np.array([2.0, 100, 240, 3])) == pytest.approx([0, 5, 10, 3])
    assert skin.saturated(np.array([2.0, 100, 240, 3])).tolist() == [False, False, True, False]


@pytest.mark.parametrize("wrong", [{"gain": 0}, {"floor": -1}, {"floor": 3, "saturation": 2}])
def test_touch_sensitivities_are_validated(wrong):
    with pytest.raises(ValueError, match="needed"):
        Sensitivity(**wrong)


def test_skin_triangle_has_ten_taxels_at_measured_pitch():
    taxels = triangle.LAYOUT[list(triangle.PRESSURE)]
    apart = np.linalg.norm(taxels[:, None] - taxels[None], axis=2) + np.eye(10)
    assert apart.min(axis=1) == pytest.approx(np.full(10, 0.0065), abs=5e-5)
    assert triangle.index(1, 2, 3) == 192 + 24 + 3


def test_skin_part_publishes_all_channels():
    vector = triangle.published(np.array([0, 5, 13]), np.array([1, 2, 3], np.uint8), 24)
    assert vector.tolist() == [1, 240, 240, 240, 240, 2] + [240] * 7 + [3] + [240] * 10


RAW = 240.0


def calibrated(**settings_) -> SkinManager:
    return SkinManager.calibrated(np.full((100, 3), RAW), Compensation(**settings_))


def test_touch_is_force_above_threshold():
    manager = calibrated(smooth=False)
    counts = manager.compensate(np.array([RAW, RAW - 8, RAW - 100]))
    assert counts == pytest.approx([0, 8, 100])
    assert manager.touched(counts).tolist() == [False, False, True]
    binary = calibrated(smooth=False, binary=True)
    assert binary.compensate(np.array([RAW + 9, RAW - 8, RAW - 9])) == pytest.approx([0, 0, 100])


def test_baseline_follows_slow_drift_but_hardly_touch():
    manager = calibrated(smooth=False)
    raw = np.array([RAW - 4, RAW + 4, RAW - 100])
    for _ in range(3000):
        left = manager.compensate(raw)
    assert left[:2] == pytest.approx([0, 0], abs=0.1)
    assert manager.baseline == pytest.approx([19, 11, 15 + 100 - left[2]], abs=0.1)
    assert calibrated(smooth=False, contact_gain=0.0).compensate(raw)[2] == 100


def test_baseline_smoothing_delays_and_never_stops():
    manager = calibrated(alpha=0.5, gain=0.0, contact_gain=0.0)
    manager.compensate(np.full(3, RAW))
    steps = [manager.compensate(np.full(3, RAW - 80))[0] for _ in range(3)]
    assert steps == pytest.approx([40, 60, 70])
    stuck = calibrated(alpha=1.0, gain=0.0, contact_gain=0.0)
    stuck.compensate(np.full(3, RAW))
    assert stuck.compensate(np.full(3, RAW - 80))[0] == pytest.approx(0.8)


def test_baseline_noise_sets_threshold_and_distant_baseline_alarms():
    with pytest.raises(ValueError, match="one frame"):
        SkinManager.calibrated(np.empty((0, 3)), Compensation())
    noise = np.random.default_rng(0).normal(size=(2000, 1)) * 4
    samples = np.hstack((RAW + noise, np.full((2000, 1), 254.0), 0 * noise))
    manager = SkinManager.calibrated(samples, Compensation())
    assert manager.threshold == pytest.approx([1.645 * 4, 1, 1], rel=0.05)
    assert manager.alarms().tolist() == [False, True, True]
    upright = SkinManager.calibrated(np.full((5, 1), 15.0), Compensation(zero_up=True))
    assert upright.baseline == pytest.approx([15.0])
