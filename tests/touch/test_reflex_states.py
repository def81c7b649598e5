"""The reflex component over simulated time: what it does when, and where the arm goes."""

from __future__ import annotations

import re
import subprocess
import sys
from collections.abc import Iterator
from pathlib import Path

import numpy as np
import pytest

from tests.touch.kinematic_robot import REFLEX, ReflexHarness, interfaces


@pytest.fixture
def harness() -> Iterator[ReflexHarness]:
    system = ReflexHarness(law="fixed")
    yield system
    system.close()


def test_reflex_withdraws_holds_and_returns(harness: ReflexHarness) -> None:
    harness.wait_until_watching()
    start, field = harness.robot.pose, harness.field("lower_arm_under")
    assert harness.robot.moves == []
    harness.press("lower_arm_under", 5.0)
    harness.run(0.02)
    assert harness.state == "Withdrawing"
    _, goal, _ = harness.robot.moves[0]
    gain = (goal - start)[0] / field.motion[0]
    assert 0.5 < gain <= 1.0
    assert goal == pytest.approx(start + gain * field.motion)
    harness.release()
    harness.run(0.3)
    assert harness.state == "Holding"
    harness.run(0.4)
    assert harness.state == "Returning"
    assert harness.robot.moves[-1][1] == pytest.approx(harness.robot.part.start)
    harness.run(2.0)
    assert harness.state == "Watching"
    assert harness.robot.pose == pytest.approx(start, abs=0.03)
    assert harness.reflex.getStatistics().withdrawals == 1
    assert len(harness.robot.moves) == 2
    assert np.isfinite(harness.robot.poses).all()


def test_reflex_states_match_interface() -> None:
    machine = REFLEX.worker.SPEC.machine
    assert {state.name for state in machine.states} == {
        state_.name for state_ in interfaces.ReflexState
    }


def test_reflex_documentation_draws_state_machine(tmp_path: Path) -> None:
    rcgen = Path(sys.executable).with_name("rcgen")
    file = REFLEX.folder / "reflex.cdsl"
    subprocess.run([rcgen, "doc", "-q", file, "-o", tmp_path / "doc"], check=True, timeout=60)
    page = (tmp_path / "doc" / "components" / "reflex.html").read_text(encoding="utf-8")
    drawings = re.findall(r"<svg.*?</svg>", page, re.DOTALL)
    (drawn,) = [drawing for drawing in drawings if ">Withdrawing<" in drawing]
    labels = re.findall(r"<text[^>]*>([^<]+)", drawn)
    assert sorted(labels) == sorted(
        [state_.name for state_ in interfaces.ReflexState]
        + [transition.event for transition in REFLEX.worker.SPEC.machine.transitions]
    )
