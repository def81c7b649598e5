"""What a group in one process reports to its supervisor."""

from __future__ import annotations

import time

import pytest

from robocomp_dsl.runtime.component.hang_report import HangReport
from robocomp_dsl.runtime.group_process.group_supervision import GroupSupervision


class Recorder:
    """A `StateNotifier` and a `HangNotifier`."""

    watchdog_s = 2.0

    def __init__(self) -> None:
        self.calls: list[object] = []

    def state_changed(self, state: str, reason: str = "") -> None:
        self.calls.append((state, reason))

    def ping(self) -> None:
        self.calls.append("ping")

    def beat(self, seconds: float) -> None:
        self.calls.append(seconds)

    def report(self, report: HangReport) -> None:
        self.calls.append(report.activity)


@pytest.fixture
def recorder() -> Recorder:
    return Recorder()


@pytest.fixture
def supervision(recorder: Recorder) -> GroupSupervision:
    return GroupSupervision(["arm", "eye"], recorder, recorder)


def test_group_supervision_computes_when_all_members_do(
    supervision: GroupSupervision, recorder: Recorder
) -> None:
    ready: list[str] = []
    arm = supervision.of_member("arm", lambda: ready.append("arm"))
    eye = supervision.of_member("eye", lambda: ready.append("eye"))
    arm.states.state_changed("compute")
    eye.states.state_changed("compute")
    eye.states.state_changed("emergency", "no camera")
    arm.states.state_changed("finalize")
    assert recorder.calls == [
        ("initialize", "eye"),
        ("compute", ""),
        ("emergency", "eye: no camera"),
        ("finalize", "arm"),
    ]
    assert ready == ["arm", "eye", "eye"]


def test_group_supervision_pings_when_all_members_did(
    supervision: GroupSupervision, recorder: Recorder
) -> None:
    arm = supervision.of_member("arm", lambda: None)
    eye = supervision.of_member("eye", lambda: None)
    assert arm.states.watchdog_s == recorder.watchdog_s
    for _ in range(3):
        arm.states.ping()
    assert recorder.calls == []
    eye.states.ping()
    eye.states.ping()
    assert recorder.calls == ["ping"]
    supervision.ended("arm")
    eye.states.ping()
    assert recorder.calls == ["ping", "ping"]


def test_group_supervision_beats_in_longest_interval_until_all_ended(
    supervision: GroupSupervision, recorder: Recorder
) -> None:
    arm = supervision.of_member("arm", lambda: None)
    eye = supervision.of_member("eye", lambda: None)
    arm.hangs.beat(1.0)
    eye.hangs.beat(5.0)
    arm.hangs.beat(1.0)
    supervision.ended("eye")
    arm.hangs.beat(0.0)
    assert recorder.calls == [1.0, 5.0, 5.0, 1.0, 0.0]


def test_group_supervision_names_member_that_hangs(
    supervision: GroupSupervision, recorder: Recorder
) -> None:
    report = HangReport(time.time(), "compute", 2.0, "", ())
    supervision.of_member("eye", lambda: None).hangs.report(report)
    assert recorder.calls == ["compute of eye"]
