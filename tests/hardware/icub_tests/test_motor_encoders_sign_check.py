"""motorEncodersSignCheck of icub-tests: a positive duty cycle raises the motor's position."""

from __future__ import annotations

import pytest

from robocomp_dsl.hardware.control.modes import Mode


def test_motor_encoder_sign_matches_motor_push(arm):
    arm.world.model.opt.gravity[:] = 0
    arm.command.set_mode(None, Mode.POSITION)
    arm.settings.set_reference_speed(None, 1.0)
    arm.go(None, arm.inside)
    for motor in range(len(arm.spec.motors)):
        arm.command.set_mode(None, Mode.POSITION)
        arm.world.advance(0.3)
        arm.command.set_mode(None, Mode.PWM)
        before = arm.board.state()
        arm.command.set_duty([motor], 3.0)
        arm.world.advance(0.1)
        after = arm.board.state()
        turned = after.motor_counts[motor] - before.motor_counts[motor]
        assert turned > 50, arm.spec.motors[motor].name
        assert after.duty[motor] == pytest.approx(3.0, abs=0.2)
