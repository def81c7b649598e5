"""torqueControl-gravityConsistency and -stiffDampCheck of icub-tests."""

from __future__ import annotations

import numpy as np
import pytest

from robocomp_dsl.hardware.control.modes import Interaction, Mode


def test_torque_control_holds_resting_arm_with_modelled_weight(arm):
    arm.command.set_mode(None, Mode.POSITION)
    arm.settings.set_reference_speed(None, 1.0)
    for part in (0.5, 0.35):
        low, high = arm.board.limits.low, arm.board.limits.high
        arm.go(None, low + part * (high - low))
        arm.world.advance(1.0)
        weight = arm.world.data.qfrc_bias[arm.part._speed]
        assert np.abs(weight).max() > 0.05
        assert arm.board.state().torque == pytest.approx(weight, abs=0.02)


def test_torque_control_stiffness_and_damping_are_as_set(arm):
    """A push of known strength moves a compliant joint by strength over stiffness."""
    joint = 3
    arm.command.set_mode(None, Mode.POSITION)
    arm.settings.set_reference_speed(None, 1.0)
    arm.go(None, arm.inside)
    most = arm.spec.joints[joint].torque_limit
    arm.command.set_interaction([joint], Interaction.COMPLIANT)
    for stiffness, damping in ((2.0 * most, 0.4 * most), (4.0 * most, 0.6 * most)):
        arm.settings.set_impedance([joint], stiffness, damping)
        impedance = arm.board.impedance
        assert (impedance.stiffness[joint], impedance.damping[joint]) == (stiffness, damping)
        arm.world.data.qfrc_applied[arm.part._speed[joint]] = 0.2 * most
        arm.world.advance(3.0)
        moved = arm.board.position[joint] - arm.inside[joint]
        assert moved == pytest.approx(0.2 * most / stiffness, rel=0.1)
        arm.world.data.qfrc_applied[arm.part._speed[joint]] = 0.0
        arm.world.advance(3.0)
