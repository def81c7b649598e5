"""OpenloopConsistency of icub-tests: to and from duty cycles, modes and references stay true."""

from __future__ import annotations

import pytest

from robocomp_dsl.hardware.control.modes import Interaction, Mode
from robocomp_dsl.hardware.control.targets import targets

OTHERS = (
    Mode.IDLE,
    Mode.POSITION,
    Mode.POSITION_DIRECT,
    Mode.VELOCITY,
    Mode.TORQUE,
    Mode.MIXED,
    Mode.CURRENT,
)


@pytest.mark.parametrize("interaction", Interaction)
@pytest.mark.parametrize("other", OTHERS)
def test_duty_cycle_starts_at_zero_and_leaves_no_offset(arm, other, interaction):
    arm.world.model.opt.gravity[:] = 0
    arm.command.set_interaction(None, interaction)
    arm.command.set_mode(None, other)
    arm.world.advance(0.01)
    arm.command.set_mode(None, Mode.PWM)
    assert not targets(arm.board).duty.any()
    arm.command.set_duty(None, 1.0)
    arm.world.advance(0.01)
    state = arm.board.state()
    assert set(state.modes) == {Mode.PWM}
    assert set(state.interactions) == {interaction}
    assert state.duty == pytest.approx(1.0, abs=0.05)
    arm.command.set_mode(None, other)
    assert not targets(arm.board).duty.any()
    here = arm.board.state().position
    arm.world.advance(0.05)
    state = arm.board.state()
    assert set(state.modes) == {other}
    assert set(state.interactions) == {interaction}
    if other not in (Mode.TORQUE, Mode.IDLE, Mode.CURRENT):  # those hold no position
        assert state.position == pytest.approx(here, abs=0.01)
