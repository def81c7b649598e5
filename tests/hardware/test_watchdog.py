"""Who pushes torques, duty cycles or currents must go on doing so, or the joint holds its place."""

from __future__ import annotations

import numpy as np
import pytest

from robocomp_dsl.hardware.control.errors import BadValue
from robocomp_dsl.hardware.control.modes import Interaction, Mode
from robocomp_dsl.hardware.control.protection.faults import FaultCode
from robocomp_dsl.hardware.control.variables import RemoteVariables
from tests.support.simulated_arm import Arm

ELBOW = 3
PUSHES = {
    Mode.TORQUE: lambda command: command.set_torque([ELBOW], 0.3),
    Mode.PWM: lambda command: command.set_duty([ELBOW], 5.0),
    Mode.CURRENT: lambda command: command.set_current([ELBOW], 0.05),
}


def ready(name: str, seconds: float, mode: Mode) -> Arm:
    arm = Arm(name)
    arm.command.set_mode(None, Mode.POSITION)
    arm.settings.set_reference_speed(None, 1.0)
    arm.go(None, arm.inside)
    arm.settings.set_reference_timeout(seconds)
    arm.command.set_mode([ELBOW], mode)
    return arm


@pytest.mark.parametrize("mode", PUSHES)
@pytest.mark.parametrize("name", ["nao", "icub"])
def test_watchdog_holds_joint_position_after_reference_timeout(name: str, mode: Mode) -> None:
    arm = ready(name, 0.2, mode)
    for _ in range(8):
        PUSHES[mode](arm.command)
        arm.world.advance(0.15)
        assert arm.board.table.modes[ELBOW] is mode
    arm.world.advance(0.1)
    state = arm.board.state()
    held = state.position[ELBOW]
    assert state.modes[ELBOW] is Mode.POSITION
    assert state.interactions[ELBOW] is Interaction.COMPLIANT
    assert np.flatnonzero(state.faults).tolist() == [ELBOW]
    assert state.faults[ELBOW] == FaultCode.REFERENCE_TIMEOUT
    report = arm.settings.last_fault(ELBOW)
    assert (report.code, report.message) == (
        FaultCode.REFERENCE_TIMEOUT,
        "no reference came for 0.2 s: it holds its position",
    )
    arm.world.advance(2.0)
    assert arm.board.position[ELBOW] == pytest.approx(held, abs=0.2)
    assert arm.board.velocity[ELBOW] == pytest.approx(0.0, abs=0.01)


def test_watchdog_keeps_joint_state_for_next_client() -> None:
    arm = ready("nao", 0.1, Mode.TORQUE)
    arm.world.advance(0.2)
    assert arm.board.table.interactions[ELBOW] is Interaction.COMPLIANT
    arm.command.set_mode([ELBOW], Mode.POSITION)
    state = arm.board.state()
    assert state.interactions[ELBOW] is Interaction.STIFF
    assert not state.faults.any()
    assert arm.settings.last_fault(ELBOW).code is FaultCode.REFERENCE_TIMEOUT
    arm.go([ELBOW], arm.inside[[ELBOW]])
    assert arm.board.position[ELBOW] == pytest.approx(arm.inside[ELBOW], abs=0.02)


def test_watchdog_ends_mode_without_references() -> None:
    arm = ready("nao", 0.1, Mode.TORQUE)
    arm.world.advance(0.09)
    assert arm.board.table.modes[ELBOW] is Mode.TORQUE
    arm.world.advance(0.02)
    assert arm.board.table.modes[ELBOW] is Mode.POSITION


def test_watchdog_treats_joints_with_shared_motors_together() -> None:
    arm = Arm("icub")
    arm.settings.set_reference_timeout(0.1)
    arm.command.set_mode([0], Mode.TORQUE)
    for _ in range(5):
        arm.command.set_torque([1], 0.1)
        arm.world.advance(0.05)
    assert [arm.board.table.modes[i] for i in range(3)] == [Mode.TORQUE] * 3
    arm.world.advance(0.1)
    assert [arm.board.table.modes[i] for i in range(3)] == [Mode.POSITION] * 3
    assert arm.board.table.modes[ELBOW] is Mode.IDLE


def test_watchdog_timeout_changes_at_once_and_0_disables_it() -> None:
    arm = ready("nao", 0.0, Mode.TORQUE)
    arm.world.advance(3.0)
    assert arm.board.table.modes[ELBOW] is Mode.TORQUE
    assert RemoteVariables(arm.board).get("reference_timeout").tolist() == [np.inf]
    arm.settings.set_reference_timeout(5.0)
    arm.world.advance(1.0)
    assert arm.board.table.modes[ELBOW] is Mode.TORQUE
    arm.settings.set_reference_timeout(0.5)
    arm.world.advance(0.002)
    assert arm.board.table.modes[ELBOW] is Mode.POSITION


@pytest.mark.parametrize("wrong", [-0.1, np.nan, np.inf])
def test_watchdog_refuses_invalid_timeouts(wrong: float) -> None:
    with pytest.raises(BadValue, match="a time-out is"):
        Arm("nao").settings.set_reference_timeout(wrong)
