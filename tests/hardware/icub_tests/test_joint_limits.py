"""jointLimits of icub-tests: limits are reached, and held against every command."""

from __future__ import annotations

import numpy as np
import pytest

from robocomp_dsl.hardware.control.modes import Mode


def test_joint_limits_hold_in_every_mode(arm):
    n = len(arm.spec.joints)
    low, high = arm.board.limits.low, arm.board.limits.high
    arm.command.set_mode(None, Mode.POSITION)
    arm.settings.set_reference_speed(None, 4.0)
    arm.go(None, arm.inside)
    for joint in range(n):
        for bound, beyond in ((low, -1.0), (high, 1.0)):
            clipped = arm.command.position_move([joint], bound[joint] + beyond)
            assert clipped.all()
            arm.wait(lambda: arm.command.motion_done().all(), 10)
            arm.world.advance(0.2)
            assert arm.board.position[joint] == pytest.approx(bound[joint], abs=0.02)
        arm.go([joint], arm.inside[joint])
    for mode, drive in (
        (Mode.VELOCITY, lambda sign: arm.command.velocity_move(None, sign * 1.0)),
        (
            Mode.TORQUE,
            lambda sign: arm.command.set_torque(None, sign * 0.5 * arm.board.limits.torque),
        ),
        (Mode.POSITION_DIRECT, lambda sign: arm.command.set_position(None, sign * 10.0)),
    ):
        for sign in (-1.0, 1.0):
            arm.command.set_mode(None, Mode.POSITION)
            arm.go(None, arm.inside)
            arm.command.set_mode(None, mode)
            drive(sign)
            for _ in range(20):
                arm.world.advance(0.1)
                q = arm.board.position
                assert (q > low - 0.1).all(), mode
                assert (q < high + 0.1).all(), mode


def test_torque_mode_gives_commanded_torque(arm):
    arm.command.set_mode(None, Mode.TORQUE)
    clipped = arm.command.set_torque(None, 1e6)
    assert clipped.all()
    arm.world.advance(0.002)
    assert (arm.board.torque <= arm.board.limits.torque).all()
    arm.command.set_mode([0], Mode.POSITION)


def test_joint_limits_apply_to_every_motor_command(arm):
    """Whatever is asked for, motors get no more than the torque limits, joints no more speed."""
    limits = arm.board.limits
    arm.world.model.opt.gravity[:] = 0
    for mode, drive in (
        (Mode.TORQUE, lambda: arm.command.set_torque(None, 1e9)),
        (Mode.PWM, lambda: arm.command.set_duty(None, 1e9)),
        (Mode.VELOCITY_DIRECT, lambda: arm.command.set_velocity(None, 1e9)),
        (Mode.POSITION_DIRECT, lambda: arm.command.set_position(None, 1e9)),
    ):
        arm.command.set_mode(None, Mode.POSITION)
        arm.settings.set_reference_speed(None, 4.0)
        arm.go(None, arm.inside)
        arm.command.set_mode(None, mode)
        assert drive().all()
        for _ in range(60):
            arm.world.advance(0.001)
            values = np.abs(arm.world.data.ctrl[arm.part._motor])
            assert (values <= limits.torque + 1e-9).all(), mode
            assert (arm.board.references.position <= limits.high + 1e-9).all(), mode
            assert (np.abs(arm.board.references.velocity) <= limits.speed + 1e-9).all(), mode
