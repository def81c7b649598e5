"""opticalEncoders-drift and motorEncoders-consistency of icub-tests."""

from __future__ import annotations

import numpy as np
import pytest

from robocomp_dsl.hardware.control.modes import Mode


def test_joint_and_motor_encoders_agree_while_arm_moves(arm):
    arm.command.set_mode(None, Mode.POSITION)
    arm.settings.set_reference_speed(None, 0.7)
    arm.command.position_move(None, arm.inside)
    motors, last = arm.board.motors, arm.board.state()
    for _ in range(400):
        arm.world.advance(0.002)
        state = arm.board.state()
        per_turn = motors.counts / (2 * np.pi)
        from_motors = np.linalg.inv(motors.to_motor) @ (state.motor_counts / per_turn)
        assert from_motors == pytest.approx(state.position, abs=2e-4)
        measured = (state.position - last.position) / (state.time - last.time)
        assert measured == pytest.approx((state.velocity + last.velocity) / 2, abs=0.04)
        assert state.motor_speed == pytest.approx(motors.to_motor @ state.velocity * per_turn)
        last = state


def test_encoders_do_not_drift_in_cyclic_motion(arm):
    arm.command.set_mode(None, Mode.POSITION)
    arm.settings.set_reference_speed(None, 2.0)
    arm.go(None, arm.inside)
    first = arm.board.state()
    for _ in range(6):
        arm.go(None, arm.inside + 0.12)
        arm.go(None, arm.inside)
    last = arm.board.state()
    counts = arm.board.motors.counts * arm.board.motors.gear / (2 * np.pi)
    assert last.position == pytest.approx(first.position, abs=0.005)
    assert last.motor_counts == pytest.approx(first.motor_counts, abs=0.015 * counts.max())
    true = np.array([arm.world.data.joint(name).qpos[0] for name in arm.spec.names])
    assert last.position == pytest.approx(true, abs=0.01)
