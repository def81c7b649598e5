"""Controllers of velocity, torque and current: their gains change the simulated motion."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest

from robocomp_dsl.hardware.control.errors import BadValue
from robocomp_dsl.hardware.control.modes import Interaction, Mode
from robocomp_dsl.hardware.control.regulators.loops import Loop
from robocomp_dsl.hardware.control.regulators.pid import Gains
from tests.support.simulated_arm import Arm

ELBOW = 3
ONE = [ELBOW]


def ready(name: str, mode: Mode) -> Arm:
    """An arm in the middle of its range, one joint in `mode`."""
    arm = Arm(name)
    arm.command.set_mode(None, Mode.POSITION)
    arm.settings.set_reference_speed(None, 1.0)
    arm.go(None, arm.inside)
    arm.command.set_mode(ONE, mode)
    return arm


def adjust(arm: Arm, loop: Loop, **changes: float) -> Gains:
    gains = replace(arm.settings.pid(ELBOW, loop), **changes)
    arm.settings.set_pid(ELBOW, gains, loop)
    return gains


def speed_after(seconds: float, **gains: float) -> float:
    arm = ready("icub", Mode.VELOCITY_DIRECT)
    adjust(arm, Loop.VELOCITY, **gains)
    arm.command.set_velocity(ONE, 0.5)
    arm.world.advance(seconds)
    return float(arm.board.velocity[ELBOW])


def test_velocity_regulator_is_as_fast_as_its_gain() -> None:
    slow, fast = (speed_after(0.005, kp=kp, ki=0.0) for kp in (1.0, 2.0))
    assert 0.0 < slow < 0.1
    assert fast / slow == pytest.approx(2.0, rel=0.15)  # long before it is there
    assert speed_after(0.5) == pytest.approx(0.5, abs=0.01)


def test_velocity_regulator_constant_output_is_a_speed() -> None:
    arm = ready("icub", Mode.VELOCITY)
    adjust(arm, Loop.VELOCITY, kp=4.0, ki=0.0, offset=0.4)
    arm.world.advance(0.6)
    drag = arm.part._damping[ELBOW]
    assert arm.board.velocity[ELBOW] == pytest.approx(0.4 / (4.0 + drag), rel=0.05)
    assert arm.settings.pid_error(ONE, Loop.VELOCITY) == pytest.approx(-arm.board.velocity[ONE])


def test_velocity_mode_is_independent_of_position_gains() -> None:
    ways = []
    for kp in (1.0, 100.0):
        arm = ready("nao", Mode.VELOCITY)
        adjust(arm, Loop.POSITION, kp=kp, ki=0.0)
        arm.command.velocity_move(ONE, 0.3)
        arm.world.advance(0.4)
        ways.append(arm.board.position[ELBOW])
    assert ways[0] == ways[1]


@pytest.mark.parametrize("name", ["nao", "icub"])
def test_torque_regulator_compensates_motor_losses(name: str) -> None:
    """Its drag and its inertia."""
    missing, speeds = [], []
    for kp in (1e-9, 4.0):
        arm = ready(name, Mode.TORQUE)
        adjust(arm, Loop.TORQUE, kp=kp)
        high = arm.board.limits.torque[ELBOW]
        weight = arm.world.data.qfrc_bias[arm.part._speed[ELBOW]]
        arm.command.set_torque(ONE, weight + 0.02 * high)
        arm.world.advance(0.02)
        missing.append(float(arm.settings.pid_error(ONE, Loop.TORQUE)[0]))
        speeds.append(float(arm.board.velocity[ELBOW]))
    assert missing[0] > 0.01 * high
    assert missing[1] < 0.6 * missing[0]
    assert speeds[1] > 2.0 * speeds[0] > 0.0


def test_current_regulator_compensates_back_emf() -> None:
    missing = []
    for gains in ({"kp": 0.0, "ki": 0.0}, {"ki": 0.0}, {}):
        arm = ready("icub", Mode.CURRENT)
        adjust(arm, Loop.CURRENT, **gains)
        weight = np.zeros(len(arm.inside))
        weight[ELBOW] = arm.world.data.qfrc_bias[arm.part._speed[ELBOW]]
        push = arm.board.motors.current(weight)[ELBOW]
        arm.command.set_current(ONE, push + 0.05)
        arm.world.advance(0.03)
        motors = arm.board.motors
        taken = motors.stall_current(motors.duty_of_speed(arm.board.velocity))[ELBOW]
        assert taken > 0.001
        missing.append(float(arm.settings.pid_error(ONE, Loop.CURRENT)[0]) / taken)
    assert missing[0] == pytest.approx(1.0, rel=0.05)
    assert missing[1] == pytest.approx(0.1, rel=0.1)
    assert abs(missing[2]) < 0.02


@pytest.mark.parametrize(
    ("mode", "loop", "push"),
    [
        (Mode.VELOCITY_DIRECT, Loop.VELOCITY, lambda arm: arm.command.set_velocity(ONE, 1.0)),
        (Mode.TORQUE, Loop.TORQUE, lambda arm: arm.command.set_torque(ONE, 0.5)),
        (Mode.CURRENT, Loop.CURRENT, lambda arm: arm.command.set_current(ONE, 0.1)),
    ],
)
def test_regulator_gains_respect_limits(mode: Mode, loop: Loop, push) -> None:
    arm = ready("nao", mode)
    arm.settings.set_pid(ELBOW, Gains(50.0, 500.0, 0.0, 3.0, feedforward=50.0), loop)
    most = arm.board.limits.torque + 1e-12
    high, low = arm.board.limits.high[ELBOW], arm.board.limits.low[ELBOW]
    for _ in range(60):
        push(arm)
        arm.world.advance(0.01)
        assert (np.abs(arm.board.torque) <= most).all()
        assert low - 0.05 < arm.board.position[ELBOW] < high + 0.05


@pytest.mark.parametrize("loop", [Loop.VELOCITY, Loop.TORQUE, Loop.CURRENT])
def test_regulator_is_bounded_resets_and_is_switched_off(loop: Loop) -> None:
    mode = {Loop.VELOCITY: Mode.VELOCITY, Loop.TORQUE: Mode.TORQUE, Loop.CURRENT: Mode.CURRENT}
    arm = ready("nao", mode[loop])
    arm.settings.set_pid(ELBOW, Gains(offset=0.02, max_output=0.01), loop)
    arm.world.advance(0.002)
    assert arm.settings.pid_output(ONE, loop) == pytest.approx([0.01])
    others = set(Loop) - {loop}
    assert all(not arm.settings.pid_output(ONE, loop).any() for loop in others)
    arm.settings.enable_pid(ONE, False, loop)
    assert arm.settings.pid_enabled(None, loop).tolist() == [
        i != ELBOW for i in range(len(arm.inside))
    ]
    arm.world.advance(0.002)
    assert arm.settings.pid_output(ONE, loop).tolist() == [0.0]
    arm.settings.enable_pid(ONE, True, loop)
    summed = arm.board.law.currents if loop is Loop.CURRENT else arm.board.pid
    summed.integral[ELBOW] = 1.0
    arm.settings.reset_pid(ONE, Loop.POSITION)
    assert summed.integral[ELBOW] == 1.0  # it is another that works
    arm.settings.reset_pid(ONE, loop)
    assert summed.integral[ELBOW] == 0.0


def test_regulator_feeds_reference_forward() -> None:
    arm = ready("icub", Mode.VELOCITY_DIRECT)
    arm.settings.set_pid(ELBOW, Gains(feedforward=2.0), Loop.VELOCITY)
    arm.command.set_velocity(ONE, 0.5)
    arm.world.advance(0.002)
    assert arm.settings.pid_output(ONE, Loop.VELOCITY) == pytest.approx([1.0])


def test_stiffness_needs_no_regulator() -> None:
    arm = ready("nao", Mode.VELOCITY)
    arm.command.set_interaction(ONE, Interaction.COMPLIANT)
    assert arm.board.loops.active[ELBOW] is None
    arm.world.advance(0.1)
    assert arm.settings.pid_output(ONE, Loop.VELOCITY).tolist() == [0.0]
    arm.command.set_interaction(ONE, Interaction.STIFF)
    assert arm.board.loops.active[ELBOW] is Loop.VELOCITY


@pytest.mark.parametrize("wrong", [{"feedforward": np.nan}, {"feedforward": -1.0}])
def test_regulator_refuses_invalid_feedforward(wrong: dict[str, float]) -> None:
    with pytest.raises(BadValue):
        Gains(**wrong)
