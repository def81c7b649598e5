"""MotorStiction of icub-tests: an output that grows slowly sets each joint in motion."""

from __future__ import annotations

import numpy as np
import pytest

from robocomp_dsl.hardware.control.modes import Mode

FRICTION = 0.02
"""Dry friction put into the joints, as a share of their largest torque."""


@pytest.mark.parametrize("joint", [1, 3, 4])
def test_motor_stiction_is_output_that_moves_joint(arm, joint):
    arm.world.model.opt.gravity[:] = 0
    arm.command.set_mode(None, Mode.POSITION)
    arm.settings.set_reference_speed(None, 1.0)
    arm.go(None, arm.inside)
    most = arm.board.limits.torque[joint]
    arm.world.model.dof_frictionloss[arm.part._speed[joint]] = FRICTION * most
    arm.command.set_mode([joint], Mode.TORQUE)  # its coupled ones, too
    arm.command.set_torque([joint], 0.0)
    start, broke = arm.board.position[joint], np.nan
    low, high = arm.board.limits.low, arm.board.limits.high
    for share in np.arange(0.0, 3 * FRICTION, FRICTION / 20):
        arm.command.set_torque([joint], share * most)
        arm.world.advance(0.05)
        assert (arm.board.position >= low - 0.02).all()
        assert (arm.board.position <= high + 0.02).all()
        if abs(arm.board.velocity[joint]) > 0.02:
            broke = share
            break
    assert broke == pytest.approx(FRICTION, rel=0.4)
    assert arm.board.position[joint] > start
