"""What `generic_arm` does when its boards or its description are not what they should be."""

from __future__ import annotations

import subprocess
import sys
import threading
from pathlib import Path
from typing import Any

import numpy as np
import pytest

from robocomp_dsl.hardware.control.modes import Interaction, Mode
from robocomp_dsl.hardware.control.protection.faults import FaultCode
from robocomp_dsl.runtime.component.lifecycle import LifecycleState
from robocomp_dsl.runtime.time.clock_interface import Tick
from robocomp_dsl.runtime.time.simulated_clock import SimulatedClock
from tests.touch.arm_client import ARM, DESCRIPTIONS, arm_on, refused, until

GOAL = np.array([0.5, 0.6, 0.3, 0.9, 0.2])
NONE = np.zeros(0)
BOTH = pytest.mark.parametrize("robot", ["nao_h25", "icub_v2"])
ON_TWO = (
    "{joint: LWristYaw, part: LArm,",
    "{joint: HeadYaw, part: Head,",
)


@pytest.fixture
def on_two(tmp_path: Path) -> Path:
    """An arm whose last joint is on another board: that of the head."""
    text = (DESCRIPTIONS / "nao_h25.yaml").read_text()
    assert ON_TWO[0] in text
    (tmp_path / "two.yaml").write_text(text.replace(*ON_TWO))
    return tmp_path / "two.yaml"


# -- boards that go away, and come back -----------------------------------------------------------


PATIENT = 600.0


class Ticking:
    """A source of time, until it is held up; the clock notices that soon, and nothing else."""

    def __init__(self) -> None:
        self.clock, self._over, self._held = SimulatedClock(PATIENT), threading.Event(), False
        self._thread = threading.Thread(target=self._run)
        self._thread.start()

    def _run(self) -> None:
        moment = 0
        while not self._over.wait(0.001):
            if not self._held:
                moment += 1_000_000
                self.clock.on_tick(Tick(moment))

    def hold_up(self, *, held: bool) -> None:
        self._held = held
        self.clock._timeout = 0.1 if held else PATIENT
        self.clock._notify()

    def close(self) -> None:
        self._over.set()
        self._thread.join()


def test_while_nobody_tells_the_time_the_arm_is_stopped_and_all_goes_on_behind() -> None:
    """The board answers all the while: it is the time that is missing."""
    ticking = Ticking()
    try:
        with arm_on("nao_h25", clock=ticking.clock) as (arm, served):
            arm.sets_off(arm.drive, np.array([0, 0, 0, 0.2, 0]))
            served.calls.clear()
            ticking.hold_up(held=True)
            until(lambda: arm.runner.lifecycle.state is LifecycleState.EMERGENCY)
            until(lambda: ("LArm", "stopMotion") in served.calls)
            until(lambda: arm.runner.worker.control.trouble)
            assert "simulated clock lost" in refused(arm.getState)
            assert "simulated clock lost" in refused(arm.move, GOAL, NONE)
            count = len(arm.states)
            ticking.hold_up(held=False)
            until(lambda: arm.runner.lifecycle.state is LifecycleState.COMPUTE)
            until(lambda: len(arm.states) > count + 20)
            assert ("LArm", "getJoints") in served.calls  # it may be another board
            rest = arm.rest().position
            arm.move(rest + 0.1, NONE)
            assert arm.rest().position == pytest.approx(rest + 0.1, abs=0.03)
    finally:
        ticking.close()


@BOTH
def test_a_board_that_goes_away_is_an_emergency_until_it_is_there_again(robot: str) -> None:
    with arm_on(robot) as (arm, served):
        arm.sets_off(arm.drive, np.array([0, 0, 0, 0.2, 0]))
        served.away()
        life = arm.runner.lifecycle
        until(lambda: life.state is LifecycleState.EMERGENCY)
        published = arm.runner.statistics.of("GenericArmState", "armState")
        count = published.calls
        for call, arguments in ((arm.getState, ()), (arm.move, (GOAL, NONE)), (arm.stop, ())):
            assert "the arm does not answer" in refused(call, *arguments)
        assert arm.getLimits().available.any()  # known without the board
        assert published.calls == count
        served.calls.clear()
        served.connect()
        until(lambda: life.state is LifecycleState.COMPUTE)
        # nobody drives any more, whatever the board was doing meanwhile
        assert (served.calls[2][1], served.calls[0][1]) == ("stopMotion", "getJoints")
        rest = arm.rest().position
        until(lambda: len(arm.states) > count + 20)
        assert arm.getState().position == pytest.approx(rest, abs=0.03)
        arm.move(GOAL, NONE)
        assert arm.rest().position == pytest.approx(GOAL, abs=0.05)


def test_springs_come_back_with_the_board_and_the_start_pose_does_not() -> None:
    with arm_on("nao_h25", "begin=start") as (arm, served):
        arm.rest()
        arm.move(GOAL, NONE)
        arm.rest()
        arm.setStiffness(np.full(5, 5.0), np.full(5, 0.2))
        served.away()
        until(lambda: arm.runner.lifecycle.state is LifecycleState.EMERGENCY)
        board = served.part.board
        board.impedance.stiffness[:] = 0.1  # it has been switched off and on
        served.connect()
        until(lambda: arm.runner.lifecycle.state is LifecycleState.COMPUTE)
        row = board.spec.names.index("LElbowRoll")
        assert board.impedance.stiffness[row] == pytest.approx(5.0)
        assert board.table.interactions[row] is Interaction.COMPLIANT
        assert arm.rest().position == pytest.approx(GOAL, abs=0.15)


def test_a_glide_that_a_board_no_longer_takes_ends_without_an_emergency(
    caplog: pytest.LogCaptureFixture,
) -> None:
    with arm_on("icub_v2") as (arm, served):
        arm.glide(0.0, 0.0, 0.02)
        until(lambda: arm.runner.worker.control._glide is not None)
        board = served.part.board
        board.fault(np.array([board.spec.names.index("l_elbow")]), FaultCode.OVERCURRENT, "burnt")
        until(lambda: "line motion of the hand ended" in caplog.text)
        assert "`l_elbow` has a hardware fault" in caplog.text
        assert arm.runner.lifecycle.state is LifecycleState.COMPUTE
        assert arm.runner.statistics.failures == 0
        arm.glide(0.0, 0.0, 0.02)  # refused, and not tried again and again
        until(lambda: "`glide` is not carried out" in caplog.text)
        assert arm.runner.worker.control._glide is None


def test_a_port_that_is_wired_to_the_wrong_board_says_so() -> None:
    with arm_on("nao_h25", board="RArm") as (arm, _):
        message = refused(arm.getState)
        for word in ("`board`", "`LShoulderPitch`", "`LArm`", "RShoulderPitch", "connected"):
            assert word in message
        assert arm.runner.lifecycle.state is LifecycleState.EMERGENCY


def test_a_joint_at_fault_is_told_in_the_words_of_its_board() -> None:
    with arm_on("nao_h25") as (arm, served):
        board = served.part.board
        board.fault(
            np.array([board.spec.names.index("LElbowRoll")]), FaultCode.OVERCURRENT, "burnt"
        )
        message = refused(arm.move, GOAL, NONE)
        assert "`board`" in message
        assert "`LElbowRoll` has a hardware fault" in message
        assert arm.getState().position.shape == (5,)  # it still knows where it is
        assert arm.runner.lifecycle.state is LifecycleState.COMPUTE
        served.part.commands.set_mode(["LElbowRoll"], Mode.FORCE_IDLE)
        arm.move(GOAL, NONE)
        assert arm.rest().position == pytest.approx(GOAL, abs=0.05)


@pytest.mark.parametrize("wrong", ["position", "velocity", "torque"])
def test_a_board_that_tells_no_numbers_is_an_emergency(wrong: str) -> None:
    with arm_on("nao_h25") as (arm, served):

        def broken(state: Any) -> None:
            getattr(state, wrong)[served.joints["LArm"].index("LElbowRoll")] = np.nan

        served.after["LArm", "getState"] = broken
        until(lambda: arm.runner.lifecycle.state is LifecycleState.EMERGENCY)
        assert "`board` reports values that are not finite for `LElbowRoll`" in refused(
            arm.getState
        )
        served.after.clear()
        until(lambda: arm.runner.lifecycle.state is LifecycleState.COMPUTE)
        assert arm.getState().position.shape == (5,)


def test_a_board_that_has_become_another_is_looked_at_again() -> None:
    with arm_on("nao_h25") as (arm, served):

        def short(state: Any) -> None:
            state.position = state.position[:2]

        served.after["LArm", "getState"] = short
        until(lambda: arm.runner.lifecycle.state is LifecycleState.EMERGENCY)
        assert "other joints than before" in refused(arm.stop)
        served.after.clear()
        until(lambda: arm.runner.lifecycle.state is LifecycleState.COMPUTE)


def test_what_fails_in_a_stream_is_told_once(caplog: pytest.LogCaptureFixture) -> None:
    with arm_on("nao_h25") as (arm, _):
        for _ in range(30):
            arm.follow(np.zeros(3))
        arm.drive(np.zeros(0))
        arm.getLimits()
        until(lambda: "5 finite velocities" in caplog.text)
        assert caplog.text.count("5 values are needed, not 3") == 1


# -- the form of the paper ------------------------------------------------------------------------

SERVO = """
  <generic_servo id="{index}">
    <destination_servo_id>{joint}</destination_servo_id>
    <transform_factor>{gamma}</transform_factor>
    <transform_displacement>{sigma}</transform_displacement>
    <speed>4.0</speed>
    <limits min="-3" max="3"/>
  </generic_servo>"""


def test_an_arm_that_the_papers_listing_describes(tmp_path: Path) -> None:
    """Joints by their numbers on the board, two servos left out, and its misspelt tag."""
    servos = "".join(
        SERVO.format(index=index, joint=joint, gamma=gamma, sigma=sigma)
        for index, joint, gamma, sigma in ((0, 0, -1, 1.5708), (1, 1, 1, 0), (3, 3, -1, 0))
    )
    (tmp_path / "arm.xml").write_text(
        f"""<Generic_Robot_Part>left_arm</Generic_Robot_Part>
<generic_servo_number>5</generic_servo_number>{servos}
<initial_positions>
  <servo type="rad" destination_servo_id="3" pos="-0.6"/>
  <servo type="rad" destination_servo_id="5" pos="0.4"/>
</initial_postions>"""
    )
    with arm_on("nao_h25", description=tmp_path / "arm.xml") as (arm, served):
        limits = arm.getLimits()
        assert limits.available.tolist() == [True, True, False, True, False]
        assert "no kinematic chain" in refused(arm.getChain)
        outcome = arm.move(GOAL, NONE)
        assert outcome.dropped.tolist() == [False, False, True, False, True]
        assert arm.rest().position == pytest.approx([0.5, 0.6, 0, 0.9, 0], abs=0.05)
        hand = served.part.board.spec.names.index("LHand")
        until(lambda: abs(served.part.board.position[hand] - 0.4) < 0.03)


# -- several boards -------------------------------------------------------------------------------


def test_one_arm_on_two_boards(on_two: Path) -> None:
    with arm_on("nao_h25", description=on_two, board="LArm", board2="Head") as (arm, served):
        assert arm.getLimits().available.all()
        arm.move(GOAL, NONE)
        assert arm.rest().position == pytest.approx(GOAL, abs=0.05)
        board = served.part.board
        head = board.position[board.spec.names.index("HeadYaw")]
        wrist = board.position[board.spec.names.index("LWristYaw")]
        assert head == pytest.approx(0.2, abs=0.02)
        assert wrist == pytest.approx(0.0, abs=0.02)
        arm.drive(np.array([0, 0, 0, 0, -0.5]))
        until(lambda: arm.getState().position[4] < 0)
        arm.stop()
        boards = {board for board, operation in served.calls if operation == "stopMotion"}
        assert boards == {"LArm", "Head"}


def test_when_one_board_refuses_the_other_is_not_moved(on_two: Path) -> None:
    with arm_on("nao_h25", description=on_two, board="LArm", board2="Head") as (arm, served):
        board = served.part.board
        board.fault(np.array([board.spec.names.index("HeadYaw")]), FaultCode.OVERCURRENT, "burnt")
        before = arm.getState().position
        served.calls.clear()
        # the second reading begins when the first, which tells of the fault, has been taken in
        until(lambda: served.calls.count(("Head", "getState")) > 1)
        assert "`board2`" in refused(arm.move, GOAL, NONE)
        assert ("LArm", "positionMove") not in served.calls
        assert arm.rest().position == pytest.approx(before, abs=0.02)


def test_a_board_that_refuses_the_goal_itself_stops_the_others(on_two: Path) -> None:
    with arm_on("nao_h25", description=on_two, board="LArm", board2="Head") as (arm, served):
        before = arm.getState().position
        served.failing["Head", "positionMove"] = ARM.interfaces.Refused("not today")
        served.ticking = False  # the component's own polls would let time pass before the stop
        assert "`board2`: not today" in refused(arm.move, GOAL, NONE)
        served.ticking = True
        assert ("LArm", "positionMove") in served.calls
        assert ("LArm", "stopMotion") in served.calls
        assert arm.rest().position == pytest.approx(before, abs=0.1)


def test_a_mode_that_somebody_else_changed_is_changed_back() -> None:
    with arm_on("nao_h25") as (arm, served):

        def meanwhile() -> None:
            del served.before["LArm", "positionMove"]
            served.part.commands.set_mode(list(served.joints["LArm"]), Mode.VELOCITY)

        served.before["LArm", "positionMove"] = meanwhile
        arm.move(GOAL, NONE)
        assert arm.rest().position == pytest.approx(GOAL, abs=0.05)


def test_a_glide_that_is_renewed_and_other_commands_do_not_disturb_each_other(
    caplog: pytest.LogCaptureFixture,
) -> None:
    with arm_on("icub_v2") as (arm, _):
        control = arm.runner.worker.control
        for number in range(40):
            sent, seen = control._sent, len(arm.states)
            arm.glide(0.0, 0.0, 0.01)
            until(lambda sent=sent: control._sent > sent)
            until(lambda seen=seen: len(arm.states) > seen + 3)  # renewed meanwhile
            if number % 4 == 0:
                arm.move(arm.getLimits().start, NONE)
        assert "later command replaced" not in caplog.text
        assert "failed" not in caplog.text
        assert arm.runner.statistics.failures == 0


def test_the_later_command_wins() -> None:
    """`stop` comes while the board still changes its mode for `drive`: it must not drive then."""
    with arm_on("nao_h25") as (arm, served):
        boards = arm.runner.worker.control._boards
        stopping = threading.Thread(target=arm.stop)

        def meanwhile() -> None:
            commands = boards._commands
            stopping.start()
            until(lambda: boards._commands > commands)

        served.before["LArm", "setControlMode"] = meanwhile
        arm.follow(GOAL)
        until(lambda: ("LArm", "stopMotion") in served.calls)
        stopping.join(60)
        until(lambda: len(arm.states) > 20)
        assert ("LArm", "setPosition") not in served.calls


# -- descriptions ---------------------------------------------------------------------------------

NAO = DESCRIPTIONS / "nao_h25.yaml"
WRONG = {
    "part": ([f"description={NAO}", "part=left_leg"], ("nao_h25.yaml:", "left_arm, right_arm")),
    "near": ([f"description={NAO}", "part=left_arn"], ("did you mean `left_arm`?",)),
    "file": (["description=nobody.yaml"], ("file not found: `nobody.yaml`", "etc/nobody.yaml")),
    "folder": ([f"description={DESCRIPTIONS}"], ("file not found",)),
    "fault": (["description=FAULTY"], ("faulty.yaml:9:51", "did you mean `gamma`?")),
    "bytes": (["description=BYTES"], ("bytes.yaml:1:1", "not UTF-8 text")),
    "boards": (["description=SPREAD"], ("on 5 physical parts", "ports for 3")),
}


def written(folder: Path) -> dict[str, Path]:
    text = NAO.read_text()
    (folder / "faulty.yaml").write_text(text.replace(" gamma: -1", " gama: -1", 1))
    (folder / "bytes.yaml").write_bytes(b"\xff\xfe\x00")
    spread, number = "", 0
    for line in text.splitlines(keepends=True):
        number += "gamma" in line and "part: LArm" in line
        spread += line.replace("part: LArm", f"part: piece{number}")
    (folder / "spread.yaml").write_text(spread)
    return {name.upper(): folder / f"{name}.yaml" for name in ("faulty", "bytes", "spread")}


@pytest.mark.parametrize("case", WRONG)
def test_a_wrong_description_ends_it_with_the_place_and_the_way_out(
    case: str, tmp_path: Path
) -> None:
    settings, words = WRONG[case]
    files = written(tmp_path)
    options = []
    for setting in settings:
        key, _, value = setting.partition("=")
        options += ["--set", f"{key}={files.get(value, value)}"]
    done = subprocess.run(
        [sys.executable, "main.py", "--domain", f"wrong-{tmp_path.name}", *options],
        cwd=ARM.folder,
        capture_output=True,
        text=True,
        timeout=60,
        check=False,
    )
    assert done.returncode == 1
    for word in words:
        assert word in done.stderr
    assert "Traceback" not in done.stderr
    assert "finalize" not in done.stderr
    assert "ConfigError" not in done.stderr
