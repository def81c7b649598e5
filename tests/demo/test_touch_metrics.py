"""What touches came to, from recordings in which it is known."""

from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest

from tests.demo.touch_demo_samples import ARM, FELT, demo, part, recording, skin, world

outcome = demo().metrics


@pytest.fixture(scope="module")
def body(tmp_path_factory: pytest.TempPathFactory) -> object:
    return demo().body.Body(world(tmp_path_factory.mktemp("body")), skin(), part())


def test_touch_metrics_match_recorded_times_force_and_field(body) -> None:
    first, second = outcome.outcomes(recording(), body)
    assert (first.robot, first.place, first.field) == ("NAO", "lower_arm_outer", "lower_arm_outer")
    assert second.field == "lower_arm_under"
    assert first.gain == 0.9  # the strongest of two
    assert first.force == pytest.approx(2.0)
    assert first.contact == pytest.approx(FELT)
    assert second.contact == pytest.approx(FELT + 2.0)
    assert (first.moved_after, first.cleared_after) == pytest.approx((60, 140))
    assert not first.trouble
    assert not second.trouble


def test_touch_metrics_path_is_that_of_body(body) -> None:
    it = recording()
    first, _ = outcome.outcomes(it, body)
    place, field = it.places[0], part().fields[0]
    body.pose(it.rest, part().start)
    before = body.centre(place)
    body.pose(it.rest, part().start + field.motion)
    way = 1000 * np.linalg.norm(body.centre(place) - before)
    assert first.withdrawn == pytest.approx(way)
    assert way > 40
    assert first.farthest == pytest.approx(1.2)


@pytest.mark.parametrize(
    ("changes", "message"),
    [
        ({"force": 0.0}, "the skin felt nothing"),
        ({"answers": ()}, "no field of the reflex answered 2.0 N"),
        ({"motion": 0.05}, "the arm went away by 3 mm only"),
        ({"motion": 0.0}, "the arm went away by 0 mm only"),
    ],
)
def test_touch_metrics_report_missing_withdrawal(body, changes, message) -> None:
    first, _ = outcome.outcomes(recording(**changes), body)
    assert first.trouble == f"NAO, lower arm outer: {message}"


def test_touch_metrics_report_arm_that_stays_in_contact(body) -> None:
    it = recording()
    felt = it.force.copy()
    felt[it.frame_time > FELT + 0.01] = it.force[np.argmax(it.force.any(axis=1))]
    first, _ = outcome.outcomes(replace(it, force=felt), body)
    assert first.trouble == "NAO, lower arm outer: the arm did not come free of the finger"


def test_touch_metrics_ignore_forces_on_other_arm() -> None:
    it = recording()
    other = [i for i, limb in enumerate(it.skin.limbs) if not limb.startswith(f"{ARM}/")]
    it.force[:, np.isin(it.skin.limb, other)] = 1.0
    assert outcome.arm_force(it).max() == pytest.approx(2.0)
    assert outcome.arm_force(it).min() == 0.0


def test_touch_metrics_table_lists_outcomes(body) -> None:
    rows = outcome.outcomes(recording(), body)
    assert list(outcome.table(rows)) == [
        "robot  place            force  field            withdrawn  to motion  cleared",
        "                            N                          mm         ms       ms",
        "NAO    lower arm outer    2.0  lower arm outer         58         60      140",
        "NAO    lower arm under    2.0  lower arm under         91         60      140",
    ]
    lost = outcome.outcomes(recording(force=0.0), body)
    assert list(outcome.table(lost))[2].split() == [
        "NAO", "lower", "arm", "outer", "0.0", "none", "never", "never", "never"
    ]  # fmt: skip


def test_recording_file_round_trips(tmp_path: Path) -> None:
    it = recording()
    demo().recording.save(it, tmp_path / "new" / "nao.npz")
    back = demo().recording.load(tmp_path / "new" / "nao.npz")
    for name in ("frame_time", "force", "arm_time", "arm", "finger_time", "finger"):
        assert np.array_equal(getattr(back, name), getattr(it, name)), name
    for name in ("points", "normals", "limb", "origins", "axes", "limbs", "bodies"):
        assert np.array_equal(getattr(back.skin, name), getattr(it.skin, name)), name
    for name in ("robot", "part", "presses", "answers", "rest"):
        assert getattr(back, name) == getattr(it, name), name
    place, other = back.place("lower_arm_under"), it.place("lower_arm_under")
    assert (place.limb, place.radius, *place.centre) == (other.limb, other.radius, *other.centre)
