"""The topic buffer of the touch demo: the latest messages of a robot, and its state."""

from types import SimpleNamespace

import numpy as np
import pytest

from tests.demo.touch_demo_samples import ARM, demo, places, skin


@pytest.fixture
def buffer():
    return demo().topic_buffer.TopicBuffer(skin(), ARM)


def frame(time: float, *felt: int, size: int = 0) -> SimpleNamespace:
    force = np.zeros(size or len(skin().limb), dtype=np.float32)
    force[list(felt)] = 0.5
    return SimpleNamespace(time=time, force=force)


def state(time: float, *angles: float, moving: bool = False) -> SimpleNamespace:
    return SimpleNamespace(time=time, position=np.array([*angles, 0, 0, 0, 0.0]), moving=moving)


def taxel_of_arm() -> int:
    where = skin()
    return int(where.of(f"{ARM}/lower_arm")[0])


def taxel_of_other_arm() -> int:
    where = skin()
    return int(where.of("right_arm/lower_arm")[0])


def test_topic_buffer_skin_is_free_since_first_frame_without_touch(buffer) -> None:
    free_since = []
    for i, felt in enumerate(
        [(), (taxel_of_arm(),), (taxel_of_arm(),), (), (taxel_of_other_arm(),)]
    ):
        buffer.frame(frame(0.02 * i, *felt))
        free_since.append(buffer.free_since)
    inf = float("inf")
    assert free_since == pytest.approx([0.0, inf, inf, 0.06, 0.06])


def test_topic_buffer_drops_frames_of_another_length(buffer) -> None:
    buffer.frame(frame(0.0, taxel_of_arm()))
    buffer.frame(frame(0.02, size=3))
    assert buffer.free_since == float("inf")
    assert len(buffer.felt_within(1.0)) == len(skin().limb)


def test_topic_buffer_reports_largest_recent_force(buffer) -> None:
    for i, felt in enumerate([(taxel_of_other_arm(),), (taxel_of_arm(),), ()]):
        buffer.frame(frame(0.02 * i, *felt))
    assert not buffer.felt_within(0.01).any()
    assert np.flatnonzero(buffer.felt_within(0.03)).tolist() == [taxel_of_arm()]
    assert np.flatnonzero(buffer.felt_within(1.0)).tolist() == sorted(
        [taxel_of_arm(), taxel_of_other_arm()]
    )


@pytest.mark.parametrize(
    ("angles", "moving", "at_rest"),
    [
        ([0, 0, 0, 0, 0], False, True),
        ([0, 0, 0, 0, 0], True, False),  # it says that it moves
        ([0, 0.001, 0.002, 0.001, 0], False, True),
        ([0, 0.01, 0.02, 0.03, 0.04], False, False),
        ([0.5, 0, 0, 0, 0], False, False),
    ],
)
def test_topic_buffer_reports_resting_arm(buffer, angles, moving, at_rest) -> None:
    for i, angle in enumerate(angles):
        buffer.arm_state(state(0.01 * i, angle, moving=moving))
    assert buffer.is_at_rest(0.04, 0.004) is at_rest


def test_topic_buffer_needs_enough_time_to_report_rest(buffer) -> None:
    buffer.arm_state(state(0.0, 0.1))
    assert not buffer.is_at_rest(0.04, 0.004)


def test_topic_buffer_stores_frozen_reflex(buffer) -> None:
    buffer.arm_state(state(0.0, 0.1))
    buffer.frame(frame(0.1))
    buffer.reflex_state(SimpleNamespace(name="Frozen"))
    buffer.frame(frame(0.2))
    buffer.reflex_state(SimpleNamespace(name="Returning"))
    assert buffer.frozen_since(0.1)
    assert not buffer.frozen_since(0.15)


def test_topic_buffer_accepts_restarted_time(buffer) -> None:
    for i in range(300):
        buffer.frame(frame(0.02 * i))
        buffer.arm_state(state(0.02 * i, 0.1))
    buffer.finger_at(5.98, np.ones(3))
    buffer.arm_state(state(5.5, 0.1))  # only late
    assert buffer.now == pytest.approx(5.98)
    buffer.frame(frame(0.02, taxel_of_arm()))
    assert buffer.now == pytest.approx(0.02)
    assert buffer.felt_within(10.0)[taxel_of_arm()] == 0.5
    assert buffer.angles[0] == 0.1
    assert not buffer.is_at_rest(0.04, 0.004)  # too short to tell
    buffer.finger_at(0.03, np.zeros(3))
    assert buffer.finger.tolist() == [0, 0, 0]


def test_topic_buffer_becomes_recording(buffer) -> None:
    buffer.frame(frame(0.02, taxel_of_arm()))
    buffer.arm_state(state(0.03, 0.1))
    buffer.arm_state(state(0.04, 0.2))
    buffer.finger_at(0.03, np.ones(3))
    buffer.finger_at(0.03, np.zeros(3))  # the same moment again
    buffer.answer(SimpleNamespace(time=0.02, field="f", gain=0.5, force=0.4, distance=0))
    assert buffer.complete
    assert buffer.now == 0.04
    press = demo().recording.Press("lower_arm_outer", 0.0, 0.05)
    it = buffer.recording("NAO", [press], places=places(), rest={"HeadYaw": 0.0})
    assert it.frame_time.tolist() == [0.02]
    assert it.force.shape == (1, len(skin().limb))
    assert it.arm[:, 0].tolist() == [0.1, 0.2]
    assert it.finger.tolist() == [[1, 1, 1]]
    assert it.answers == (demo().recording.Answer(0.02, "f", 0.5, 0.4),)
    assert it.part == ARM


def test_topic_buffer_stores_latest_samples_only() -> None:
    buffer = demo().topic_buffer.TopicBuffer(skin(), ARM, 3)
    for i in range(10):
        buffer.arm_state(state(0.01 * i, float(i)))
        buffer.frame(frame(0.01 * i))
    it = buffer.recording("NAO", [], places=(), rest={})
    assert it.arm[:, 0].tolist() == [7, 8, 9]
    assert len(it.force) == 3
