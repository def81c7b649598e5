"""What `generic_arm` does when its board is away or faulty."""

from __future__ import annotations

import threading
from typing import Any

import numpy as np
import pytest

from robocomp_dsl.hardware.control.modes import Interaction, Mode
from robocomp_dsl.hardware.control.protection.faults import FaultCode
from robocomp_dsl.runtime.component.lifecycle import LifecycleState
from robocomp_dsl.runtime.time.clock_interface import Tick
from robocomp_dsl.runtime.time.simulated_clock import SimulatedClock
from tests.support.waiting import wait_until
from tests.touch.arm_client import GOAL, NONE, arm_on, refusal_of

BOTH = pytest.mark.parametrize("robot", ["nao_h25", "icub_v2"])

PATIENT = 600.0


class PausableClockSource:
    """A source of time that can be paused; the clock notices soon, nothing else does."""

    def __init__(self) -> None:
        self.clock, self._closed, self._paused = SimulatedClock(PATIENT), threading.Event(), False
        self._thread = threading.Thread(target=self._run)
        self._thread.start()

    def _run(self) -> None:
        moment = 0
        while not self._closed.wait(0.001):
            if not self._paused:
                moment += 1_000_000
                self.clock.on_tick(Tick(moment))

    def pause(self, *, paused: bool) -> None:
        self._paused = paused
        self.clock._timeout = 0.1 if paused else PATIENT
        self.clock._notify()

    def close(self) -> None:
        self._closed.set()
        self._thread.join()


def test_generic_arm_stops_when_clock_is_lost_and_resumes() -> None:
    """The board replies throughout: only the time is missing."""
    source = PausableClockSource()
    try:
        with arm_on("nao_h25", clock=source.clock) as (arm, served):
            arm.start_motion(arm.drive, np.array([0, 0, 0, 0.2, 0]))
            served.calls.clear()
            source.pause(paused=True)
            wait_until(lambda: arm.runner.lifecycle.state is LifecycleState.EMERGENCY)
            wait_until(lambda: ("LArm", "stopMotion") in served.calls)
            wait_until(lambda: arm.runner.worker.control.trouble)
            assert "simulated clock lost" in refusal_of(arm.getState)
            assert "simulated clock lost" in refusal_of(arm.move, GOAL, NONE)
            count = len(arm.states)
            source.pause(paused=False)
            wait_until(lambda: arm.runner.lifecycle.state is LifecycleState.COMPUTE)
            wait_until(lambda: len(arm.states) > count + 20)
            assert ("LArm", "getJoints") in served.calls  # it may be another board
            rest = arm.wait_for_rest().position
            arm.move(rest + 0.1, NONE)
            assert arm.wait_for_rest().position == pytest.approx(rest + 0.1, abs=0.03)
    finally:
        source.close()


@BOTH
def test_generic_arm_is_in_emergency_while_board_is_away(robot: str) -> None:
    with arm_on(robot) as (arm, served):
        arm.start_motion(arm.drive, np.array([0, 0, 0, 0.2, 0]))
        served.disconnect()
        life = arm.runner.lifecycle
        wait_until(lambda: life.state is LifecycleState.EMERGENCY)
        published = arm.runner.statistics.of("GenericArmState", "armState")
        count = published.calls
        for call, arguments in ((arm.getState, ()), (arm.move, (GOAL, NONE)), (arm.stop, ())):
            assert "the arm does not answer" in refusal_of(call, *arguments)
        assert arm.getLimits().available.any()  # known without the board
        assert published.calls == count
        served.calls.clear()
        served.connect()
        wait_until(lambda: life.state is LifecycleState.COMPUTE)
        # nobody drives any more, whatever the board was doing meanwhile
        assert (served.calls[2][1], served.calls[0][1]) == ("stopMotion", "getJoints")
        rest = arm.wait_for_rest().position
        wait_until(lambda: len(arm.states) > count + 20)
        assert arm.getState().position == pytest.approx(rest, abs=0.03)
        arm.move(GOAL, NONE)
        assert arm.wait_for_rest().position == pytest.approx(GOAL, abs=0.05)


def test_generic_arm_restores_stiffness_but_no_start_pose_with_board() -> None:
    with arm_on("nao_h25", "begin=start") as (arm, served):
        arm.wait_for_rest()
        arm.move(GOAL, NONE)
        arm.wait_for_rest()
        arm.setStiffness(np.full(5, 5.0), np.full(5, 0.2))
        served.disconnect()
        wait_until(lambda: arm.runner.lifecycle.state is LifecycleState.EMERGENCY)
        board = served.part.board
        board.impedance.stiffness[:] = 0.1  # it has been switched off and on
        served.connect()
        wait_until(lambda: arm.runner.lifecycle.state is LifecycleState.COMPUTE)
        row = board.spec.names.index("LElbowRoll")
        assert board.impedance.stiffness[row] == pytest.approx(5.0)
        assert board.table.interactions[row] is Interaction.COMPLIANT
        assert arm.wait_for_rest().position == pytest.approx(GOAL, abs=0.15)


def test_generic_arm_ends_refused_line_motion_without_emergency(
    caplog: pytest.LogCaptureFixture,
) -> None:
    with arm_on("icub_v2") as (arm, served):
        arm.glide(0.0, 0.0, 0.02)
        wait_until(lambda: arm.runner.worker.control._glide is not None)
        board = served.part.board
        board.fault(np.array([board.spec.names.index("l_elbow")]), FaultCode.OVERCURRENT, "burnt")
        wait_until(lambda: "line motion of the hand ended" in caplog.text)
        assert "`l_elbow` has a hardware fault" in caplog.text
        assert arm.runner.lifecycle.state is LifecycleState.COMPUTE
        assert arm.runner.statistics.failures == 0
        arm.glide(0.0, 0.0, 0.02)  # refusal_of, and not tried again and again
        wait_until(lambda: "`glide` is not carried out" in caplog.text)
        assert arm.runner.worker.control._glide is None


def test_generic_arm_reports_wrong_board_connection() -> None:
    with arm_on("nao_h25", board="RArm") as (arm, _):
        message = refusal_of(arm.getState)
        for word in ("`board`", "`LShoulderPitch`", "`LArm`", "RShoulderPitch", "connected"):
            assert word in message
        assert arm.runner.lifecycle.state is LifecycleState.EMERGENCY


def test_generic_arm_reports_joint_fault_of_board() -> None:
    with arm_on("nao_h25") as (arm, served):
        board = served.part.board
        board.fault(
            np.array([board.spec.names.index("LElbowRoll")]), FaultCode.OVERCURRENT, "burnt"
        )
        message = refusal_of(arm.move, GOAL, NONE)
        assert "`board`" in message
        assert "`LElbowRoll` has a hardware fault" in message
        assert arm.getState().position.shape == (5,)  # it still knows where it is
        assert arm.runner.lifecycle.state is LifecycleState.COMPUTE
        served.part.commands.set_mode(["LElbowRoll"], Mode.FORCE_IDLE)
        arm.move(GOAL, NONE)
        assert arm.wait_for_rest().position == pytest.approx(GOAL, abs=0.05)


@pytest.mark.parametrize("wrong", ["position", "velocity", "torque"])
def test_generic_arm_is_in_emergency_while_board_reports_non_finite_values(wrong: str) -> None:
    with arm_on("nao_h25") as (arm, served):

        def broken(state: Any) -> None:
            getattr(state, wrong)[served.joints["LArm"].index("LElbowRoll")] = np.nan

        served.after["LArm", "getState"] = broken
        wait_until(lambda: arm.runner.lifecycle.state is LifecycleState.EMERGENCY)
        assert "`board` reports values that are not finite for `LElbowRoll`" in refusal_of(
            arm.getState
        )
        served.after.clear()
        wait_until(lambda: arm.runner.lifecycle.state is LifecycleState.COMPUTE)
        assert arm.getState().position.shape == (5,)


def test_generic_arm_examines_changed_board_again() -> None:
    with arm_on("nao_h25") as (arm, served):

        def short(state: Any) -> None:
            state.position = state.position[:2]

        served.after["LArm", "getState"] = short
        wait_until(lambda: arm.runner.lifecycle.state is LifecycleState.EMERGENCY)
        assert "other joints than before" in refusal_of(arm.stop)
        served.after.clear()
        wait_until(lambda: arm.runner.lifecycle.state is LifecycleState.COMPUTE)


def test_generic_arm_reports_stream_failure_once(caplog: pytest.LogCaptureFixture) -> None:
    with arm_on("nao_h25") as (arm, _):
        for _ in range(30):
            arm.follow(np.zeros(3))
        arm.drive(np.zeros(0))
        arm.getLimits()
        wait_until(lambda: "5 finite velocities" in caplog.text)
        assert caplog.text.count("5 values are needed, not 3") == 1
