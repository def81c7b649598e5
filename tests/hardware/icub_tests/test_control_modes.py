"""ControlModes of icub-tests: every mode is entered and left; faults end by force-idle only."""

from __future__ import annotations

import numpy as np
import pytest

from robocomp_dsl.hardware.control.errors import ModeRefused
from robocomp_dsl.hardware.control.modes import SELECTABLE, Interaction, Mode
from robocomp_dsl.hardware.control.protection.faults import FaultCode
from tests.support.simulated_arm import Arm


def modes(arm: Arm) -> set[tuple[Mode, Interaction]]:
    state = arm.board.state()
    return set(zip(state.modes, state.interactions, strict=True))


SEQUENCE = (
    (Mode.POSITION, Mode.POSITION),
    (Mode.POSITION_DIRECT, Mode.POSITION_DIRECT),
    (Mode.VELOCITY, Mode.VELOCITY),
    (Mode.VELOCITY_DIRECT, Mode.VELOCITY_DIRECT),
    (Mode.TORQUE, Mode.TORQUE),
    (Mode.MIXED, Mode.MIXED),
    (Mode.PWM, Mode.PWM),
    (Mode.CURRENT, Mode.CURRENT),
    (Mode.IDLE, Mode.IDLE),
    (Mode.POSITION, Mode.POSITION),
    (Mode.FORCE_IDLE, Mode.IDLE),
    (Mode.POSITION, Mode.POSITION),
)


def test_control_modes_change_and_faults_end_by_force_idle(arm):
    for interaction in (Interaction.STIFF, Interaction.COMPLIANT):
        arm.command.set_interaction(None, interaction)
        for asked, expected in SEQUENCE:
            arm.command.set_mode(None, asked)
            arm.world.advance(0.01)
            assert modes(arm) == {(expected, interaction)}
    arm.board.motors.set_max_current(
        np.arange(len(arm.spec.joints)), np.zeros(len(arm.spec.joints))
    )
    arm.world.advance(0.01)
    assert modes(arm) == {(Mode.HW_FAULT, Interaction.STIFF)}
    assert {fault.code for fault in arm.board.faults.last} == {FaultCode.OVERCURRENT}
    arm.board.motors.set_max_current(
        np.arange(len(arm.spec.joints)), np.full(len(arm.spec.joints), 10.0)
    )
    for asked in SELECTABLE:
        if asked is not Mode.FORCE_IDLE:
            with pytest.raises(ModeRefused, match="only force-idle"):
                arm.command.set_mode(None, asked)
            arm.world.advance(0.01)
            assert modes(arm) == {(Mode.HW_FAULT, Interaction.STIFF)}
    assert not arm.board.torque.any()
    arm.command.set_mode(None, Mode.FORCE_IDLE)
    assert modes(arm) == {(Mode.IDLE, Interaction.COMPLIANT)}
    arm.command.set_mode(None, Mode.POSITION)
    assert modes(arm) == {(Mode.POSITION, Interaction.COMPLIANT)}


def test_control_mode_refuses_states_as_request(arm):
    for state in (m for m in Mode if m not in SELECTABLE):
        with pytest.raises(ModeRefused, match="cannot be asked for"):
            arm.command.set_mode(None, state)


def test_control_mode_change_does_not_move_arm(arm):
    arm.command.set_mode(None, Mode.POSITION)
    arm.world.advance(0.5)
    for asked in (Mode.VELOCITY, Mode.MIXED, Mode.POSITION_DIRECT, Mode.POSITION):
        before = arm.board.state().position
        arm.command.set_mode(None, asked)
        arm.world.advance(0.2)
        assert arm.board.state().position == pytest.approx(before, abs=0.005)
