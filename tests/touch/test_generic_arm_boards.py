"""`generic_arm` on several boards, and concurrent commands."""

from __future__ import annotations

import threading
from pathlib import Path

import numpy as np
import pytest

from robocomp_dsl.hardware.control.modes import Mode
from robocomp_dsl.hardware.control.protection.faults import FaultCode
from tests.support.waiting import wait_until
from tests.touch.arm_client import ARM, DESCRIPTIONS, GOAL, NONE, arm_on, refusal_of

OTHER_BOARD = (
    "{joint: LWristYaw, part: LArm,",
    "{joint: HeadYaw, part: Head,",
)


@pytest.fixture
def two_board_description(tmp_path: Path) -> Path:
    """An arm whose last joint is on another board: that of the head."""
    text = (DESCRIPTIONS / "nao_h25.yaml").read_text()
    assert OTHER_BOARD[0] in text
    (tmp_path / "two.yaml").write_text(text.replace(*OTHER_BOARD))
    return tmp_path / "two.yaml"


def test_generic_arm_drives_two_boards(two_board_description: Path) -> None:
    with arm_on("nao_h25", description=two_board_description, board="LArm", board2="Head") as (
        arm,
        served,
    ):
        assert arm.getLimits().available.all()
        arm.move(GOAL, NONE)
        assert arm.wait_for_rest().position == pytest.approx(GOAL, abs=0.05)
        board = served.part.board
        head = board.position[board.spec.names.index("HeadYaw")]
        wrist = board.position[board.spec.names.index("LWristYaw")]
        assert head == pytest.approx(0.2, abs=0.02)
        assert wrist == pytest.approx(0.0, abs=0.02)
        arm.drive(np.array([0, 0, 0, 0, -0.5]))
        wait_until(lambda: arm.getState().position[4] < 0)
        arm.stop()
        boards = {board for board, operation in served.calls if operation == "stopMotion"}
        assert boards == {"LArm", "Head"}


def test_generic_arm_moves_no_board_when_first_one_refuses(two_board_description: Path) -> None:
    with arm_on("nao_h25", description=two_board_description, board="LArm", board2="Head") as (
        arm,
        served,
    ):
        board = served.part.board
        board.fault(np.array([board.spec.names.index("HeadYaw")]), FaultCode.OVERCURRENT, "burnt")
        before = arm.getState().position
        served.calls.clear()
        # the second reading begins when the first, which contains the fault, has been processed
        wait_until(lambda: served.calls.count(("Head", "getState")) > 1)
        assert "`board2`" in refusal_of(arm.move, GOAL, NONE)
        assert ("LArm", "positionMove") not in served.calls
        assert arm.wait_for_rest().position == pytest.approx(before, abs=0.02)


def test_generic_arm_stops_other_boards_when_goal_is_refused(two_board_description: Path) -> None:
    with arm_on("nao_h25", description=two_board_description, board="LArm", board2="Head") as (
        arm,
        served,
    ):
        before = arm.getState().position
        served.failing["Head", "positionMove"] = ARM.interfaces.Refused("not today")
        served.ticking = False  # the component's own polls would let time pass before the stop
        assert "`board2`: not today" in refusal_of(arm.move, GOAL, NONE)
        served.ticking = True
        assert ("LArm", "positionMove") in served.calls
        assert ("LArm", "stopMotion") in served.calls
        assert arm.wait_for_rest().position == pytest.approx(before, abs=0.1)


def test_generic_arm_restores_mode_changed_by_another_client() -> None:
    with arm_on("nao_h25") as (arm, served):

        def meanwhile() -> None:
            del served.before["LArm", "positionMove"]
            served.part.commands.set_mode(list(served.joints["LArm"]), Mode.VELOCITY)

        served.before["LArm", "positionMove"] = meanwhile
        arm.move(GOAL, NONE)
        assert arm.wait_for_rest().position == pytest.approx(GOAL, abs=0.05)


def test_generic_arm_renews_line_motion_beside_other_commands(
    caplog: pytest.LogCaptureFixture,
) -> None:
    with arm_on("icub_v2") as (arm, _):
        control = arm.runner.worker.control
        for number in range(40):
            sent, seen = control._sent, len(arm.states)
            arm.glide(0.0, 0.0, 0.01)
            wait_until(lambda sent=sent: control._sent > sent)
            wait_until(lambda seen=seen: len(arm.states) > seen + 3)  # renewed meanwhile
            if number % 4 == 0:
                arm.move(arm.getLimits().start, NONE)
        assert "later command replaced" not in caplog.text
        assert "failed" not in caplog.text
        assert arm.runner.statistics.failures == 0


def test_generic_arm_carries_out_later_command() -> None:
    """`stop` comes while the board still changes its mode for `drive`: it must not drive then."""
    with arm_on("nao_h25") as (arm, served):
        boards = arm.runner.worker.control._boards
        stopping = threading.Thread(target=arm.stop)

        def meanwhile() -> None:
            commands = boards._commands
            stopping.start()
            wait_until(lambda: boards._commands > commands)

        served.before["LArm", "setControlMode"] = meanwhile
        arm.follow(GOAL)
        wait_until(lambda: ("LArm", "stopMotion") in served.calls)
        stopping.join(60)
        wait_until(lambda: len(arm.states) > 20)
        assert ("LArm", "setPosition") not in served.calls
