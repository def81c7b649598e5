"""What is heard of a robot, and what of it is known at once."""

from types import SimpleNamespace

import numpy as np
import pytest

from tests.demo.touched import ARM, demo, places, skin


@pytest.fixture
def heard():
    return demo().topic_buffer.TopicBuffer(skin(), ARM)


def frame(time: float, *felt: int, size: int = 0) -> SimpleNamespace:
    force = np.zeros(size or len(skin().limb), dtype=np.float32)
    force[list(felt)] = 0.5
    return SimpleNamespace(time=time, force=force)


def state(time: float, *angles: float, moving: bool = False) -> SimpleNamespace:
    return SimpleNamespace(time=time, position=np.array([*angles, 0, 0, 0, 0.0]), moving=moving)


def mine() -> int:
    where = skin()
    return int(where.of(f"{ARM}/lower_arm")[0])


def others() -> int:
    where = skin()
    return int(where.of("right_arm/lower_arm")[0])


def test_topic_buffer_skin_is_free_since_first_frame_without_touch(heard) -> None:
    message = []
    for i, felt in enumerate([(), (mine(),), (mine(),), (), (others(),)]):
        heard.frame(frame(0.02 * i, *felt))
        message.append(heard.free_since)
    inf = float("inf")
    assert message == pytest.approx([0.0, inf, inf, 0.06, 0.06])


def test_topic_buffer_drops_frames_of_another_length(heard) -> None:
    heard.frame(frame(0.0, mine()))
    heard.frame(frame(0.02, size=3))
    assert heard.free_since == float("inf")
    assert len(heard.felt_within(1.0)) == len(skin().limb)


def test_topic_buffer_reports_largest_recent_force(heard) -> None:
    for i, felt in enumerate([(others(),), (mine(),), ()]):
        heard.frame(frame(0.02 * i, *felt))
    assert not heard.felt_within(0.01).any()
    assert np.flatnonzero(heard.felt_within(0.03)).tolist() == [mine()]
    assert np.flatnonzero(heard.felt_within(1.0)).tolist() == sorted([mine(), others()])


@pytest.mark.parametrize(
    ("angles", "moving", "stands"),
    [
        ([0, 0, 0, 0, 0], False, True),
        ([0, 0, 0, 0, 0], True, False),  # it says that it moves
        ([0, 0.001, 0.002, 0.001, 0], False, True),
        ([0, 0.01, 0.02, 0.03, 0.04], False, False),
        ([0.5, 0, 0, 0, 0], False, False),
    ],
)
def test_topic_buffer_reports_resting_arm(heard, angles, moving, stands) -> None:
    for i, angle in enumerate(angles):
        heard.arm_state(state(0.01 * i, angle, moving=moving))
    assert heard.stands(0.04, 0.004) is stands


def test_topic_buffer_needs_enough_time_to_report_rest(heard) -> None:
    heard.arm_state(state(0.0, 0.1))
    assert not heard.stands(0.04, 0.004)


def test_topic_buffer_stores_frozen_reflex(heard) -> None:
    heard.arm_state(state(0.0, 0.1))
    heard.frame(frame(0.1))
    heard.reflex_state(SimpleNamespace(name="Frozen"))
    heard.frame(frame(0.2))
    heard.reflex_state(SimpleNamespace(name="Returning"))
    assert heard.frozen_since(0.1)
    assert not heard.frozen_since(0.15)


def test_topic_buffer_accepts_restarted_time(heard) -> None:
    for i in range(300):
        heard.frame(frame(0.02 * i))
        heard.arm_state(state(0.02 * i, 0.1))
    heard.finger_at(5.98, np.ones(3))
    heard.arm_state(state(5.5, 0.1))  # only late
    assert heard.now == pytest.approx(5.98)
    heard.frame(frame(0.02, mine()))
    assert heard.now == pytest.approx(0.02)
    assert heard.felt_within(10.0)[mine()] == 0.5
    assert heard.angles[0] == 0.1
    assert not heard.stands(0.04, 0.004)  # too short to tell
    heard.finger_at(0.03, np.zeros(3))
    assert heard.finger.tolist() == [0, 0, 0]


def test_topic_buffer_becomes_recording(heard) -> None:
    heard.frame(frame(0.02, mine()))
    heard.arm_state(state(0.03, 0.1))
    heard.arm_state(state(0.04, 0.2))
    heard.finger_at(0.03, np.ones(3))
    heard.finger_at(0.03, np.zeros(3))  # the same moment again
    heard.answer(SimpleNamespace(time=0.02, field="f", gain=0.5, force=0.4, distance=0))
    assert heard.complete
    assert heard.now == 0.04
    press = demo().recording.Press("lower_arm_outer", 0.0, 0.05)
    it = heard.recording("NAO", [press], places=places(), rest={"HeadYaw": 0.0})
    assert it.frame_time.tolist() == [0.02]
    assert it.force.shape == (1, len(skin().limb))
    assert it.arm[:, 0].tolist() == [0.1, 0.2]
    assert it.finger.tolist() == [[1, 1, 1]]
    assert it.answers == (demo().recording.Answer(0.02, "f", 0.5, 0.4),)
    assert it.part == ARM


def test_topic_buffer_stores_latest_samples_only() -> None:
    heard = demo().topic_buffer.TopicBuffer(skin(), ARM, 3)
    for i in range(10):
        heard.arm_state(state(0.01 * i, float(i)))
        heard.frame(frame(0.01 * i))
    it = heard.recording("NAO", [], places=(), rest={})
    assert it.arm[:, 0].tolist() == [7, 8, 9]
    assert len(it.force) == 3
