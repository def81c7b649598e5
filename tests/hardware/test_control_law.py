"""Trajectories, ramps, controllers, limits, motors: each part of a control board by itself."""

from __future__ import annotations

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from robocomp_dsl.hardware.control.acceleration import SMOOTHING, AccelerationFilter
from robocomp_dsl.hardware.control.errors import BadValue, UnknownJoint
from robocomp_dsl.hardware.control.joints import BoardSpec, JointSpec, MotorSpec, Selector, numbers
from robocomp_dsl.hardware.control.motors import Motors
from robocomp_dsl.hardware.control.protection.limits import JointLimits
from robocomp_dsl.hardware.control.regulators.impedance import Bounds, Impedance
from robocomp_dsl.hardware.control.regulators.pid import Gains, PidBank
from robocomp_dsl.hardware.control.trajectories.minimum_jerk import PEAK, MinimumJerk
from robocomp_dsl.hardware.control.trajectories.velocity import VelocityRamp

ONE = np.array([0])
DT = 0.001


def board(n: int = 2, coupling=None) -> BoardSpec:
    joints = tuple(JointSpec(f"j{i}", -1.0, 1.0, 2.0, 5.0) for i in range(n))
    motors = tuple(MotorSpec(f"m{i}") for i in range(n))
    return BoardSpec(joints, motors, np.empty((0, 0)) if coupling is None else np.array(coupling))


def follow(trajectory: MinimumJerk, seconds: float) -> np.ndarray:
    return np.array(
        [(trajectory.step(DT), trajectory.position[0])[1] for _ in range(int(seconds / DT))]
    )


@pytest.mark.parametrize(
    ("speed_at_start", "expected"),
    [  # 30 degrees at 20 degrees a second: a quarter, half, three quarters, all of 1.5 s
        (0.0, (3.10546875, 15.0, 26.89453125, 30.0)),
        (10.0, (5.8740234375, 17.34375, 27.4658203125, 30.0)),
    ],
)
def test_minimum_jerk_values_match_polynomial(speed_at_start, expected):
    trajectory = MinimumJerk(np.zeros(1))
    trajectory.velocity[0] = speed_at_start
    trajectory.move(ONE, np.array([30.0]), np.array([20.0]), DT)
    way = follow(trajectory, 1.5)
    assert way[[374, 749, 1124, 1499]] == pytest.approx(expected, abs=0.02)
    assert way[374] == pytest.approx(expected[0], abs=1e-6)
    assert not trajectory.moving[0]
    assert trajectory.velocity[0] == 0.0


def test_minimum_jerk_peak_speed_is_1_875_times_mean():
    trajectory = MinimumJerk(np.zeros(1))
    trajectory.move(ONE, np.array([30.0]), np.array([20.0]), DT)
    speeds = [(trajectory.step(DT), trajectory.velocity[0])[1] for _ in range(1500)]
    assert max(speeds) == pytest.approx(37.5, abs=1e-3)


def test_minimum_jerk_motion_shorter_than_step_ends_at_once():
    trajectory = MinimumJerk(np.zeros(1))
    trajectory.move(ONE, np.array([1e-6]), np.array([1.0]), DT)
    assert not trajectory.moving[0]
    assert trajectory.position[0] == 1e-6


@settings(max_examples=30)
@given(st.floats(-3, 3), st.floats(-3, 3), st.floats(1, 4), st.integers(1, 400))
def test_minimum_jerk_new_goal_keeps_position_and_speed(first, second, speed, steps):
    trajectory = MinimumJerk(np.zeros(1))
    trajectory.move(ONE, np.array([first]), np.array([speed]), DT)
    follow(trajectory, steps * DT)
    position, velocity = trajectory.position[0], trajectory.velocity[0]
    trajectory.move(ONE, np.array([second]), np.array([speed]), DT)
    if trajectory.moving[0]:
        trajectory.step(1e-7)
        assert trajectory.position[0] == pytest.approx(position, abs=1e-6)
        assert trajectory.velocity[0] == pytest.approx(velocity, abs=1e-3)
    follow(trajectory, abs(second - position) / speed + 0.01)
    assert trajectory.position[0] == second


@pytest.mark.parametrize("seed", [0, 1])
def test_minimum_jerk_new_goals_respect_speed_limits(seed):
    chance, joints, most = np.random.default_rng(seed), np.arange(200), np.full(200, 2.0)
    trajectory, fastest = MinimumJerk(np.zeros(200)), 0.0
    for steps in [*chance.integers(1, 400, 40), 20000]:
        goal = chance.uniform(-3, 3, 200)
        trajectory.move(joints, goal, most / PEAK, DT, most)
        for _ in range(steps):
            trajectory.step(DT)
            fastest = max(fastest, float(np.abs(trajectory.velocity).max()))
            if not trajectory.active:
                break
    assert trajectory.position == pytest.approx(goal)
    assert fastest <= 2.0 * (1.0 + 1e-6)


def test_minimum_jerk_joints_move_in_their_own_time():
    trajectory = MinimumJerk(np.zeros(3))
    trajectory.move(np.array([0, 2]), np.array([1.0, -1.0]), np.array([1.0, 2.0]), DT)
    for _ in range(500):
        trajectory.step(DT)
    assert trajectory.moving.tolist() == [True, False, False]
    assert trajectory.position == pytest.approx([0.5, 0, -1])


def test_velocities_ramp_and_time_out():
    ramp = VelocityRamp(1)
    ramp.command(ONE, np.array([1.0]), hold=0.3)
    speeds = [float(ramp.step(np.array([5.0]), DT)[0]) for _ in range(600)]
    assert speeds[99] == pytest.approx(0.5)
    assert max(speeds) == 1.0
    assert speeds[310] == pytest.approx(1 - 5 * 0.01, abs=0.02)
    assert speeds[-1] == 0.0
    assert not ramp.active


@pytest.mark.parametrize("asked_each", [1, 7, 1000])
def test_acceleration_estimate_is_independent_of_readers(asked_each):
    random, velocity, expected = np.random.default_rng(0), np.zeros(3), np.zeros(3)
    acceleration = AccelerationFilter(velocity)
    for k in range(200):
        dt = DT if k < 120 else 2 * DT
        faster = velocity + random.normal(size=3) * 0.01
        expected = (expected * SMOOTHING + faster - velocity) / (dt + SMOOTHING)
        velocity = faster
        acceleration.add(velocity, dt)
        if k % asked_each == 0:
            assert acceleration.now(velocity) == pytest.approx(expected, abs=1e-9)
    assert acceleration.now(velocity) == pytest.approx(expected, abs=1e-9)
    acceleration.begin(velocity)
    assert not acceleration.now(velocity).any()


def test_regulator_has_proportional_integral_derivative_and_bounds():
    bank = PidBank((Gains(kp=2, ki=1, kd=0.5, offset=0.1, max_output=10, max_integral=0.3),))
    assert bank.step(np.array([1.0]), np.array([2.0]), 0.1) == pytest.approx([3.2])
    for _ in range(100):
        bank.step(np.array([1.0]), np.zeros(1), 0.1)
    assert bank.integral == pytest.approx([0.3])
    assert bank.step(np.array([100.0]), np.zeros(1), 0.1) == pytest.approx([10])
    bank.configure(bank.gains, np.zeros(1, bool))
    assert bank.step(np.array([1.0]), np.zeros(1), 0.1) == pytest.approx([0])
    bank.configure(bank.gains, np.ones(1, bool))
    assert bank.step(np.array([1.0]), np.zeros(1), 0.1) == pytest.approx([2.2])


def test_regulator_integral_does_not_wind_up_at_bound():
    bank = PidBank((Gains(kp=1, ki=10, max_output=1),))
    for _ in range(1000):
        bank.step(np.array([5.0]), np.zeros(1), 0.01)
    assert bank.integral[0] < 1.0


@pytest.mark.parametrize("wrong", [{"kp": -1}, {"ki": np.nan}, {"max_output": -1}, {"kd": np.inf}])
def test_regulator_refuses_invalid_gains(wrong):
    with pytest.raises(BadValue):
        Gains(**wrong)


def test_impedance_pulls_back_within_bounds():
    impedance = Impedance((Bounds(100, 5),) * 2)
    both = np.array([0, 1])
    impedance.set(both, np.array([10.0, 0]), np.array([1.0, 0]))
    impedance.offset[1] = 0.5
    assert impedance.torque(np.full(2, 0.1), np.full(2, -1.0)) == pytest.approx([0.0, 0.5])
    with pytest.raises(BadValue, match="0 to 100"):
        impedance.set(both, np.array([101.0, 0]), np.zeros(2))
    assert impedance.stiffness[0] == 10.0


def test_torques_respect_limits_and_lead_back():
    limits = JointLimits(board(5))
    q = np.array([0.0, 1.01, 1.01, -1.01, 0.0])
    dq = np.array([0.0, 0.0, 0.0, 0.0, 3.0])
    torque = limits.guard(q, dq, np.array([9.0, 4.0, -4.0, -1.0, 1.0]))
    assert torque == pytest.approx([5.0, -1.0, -4.0, 1.0, 0.0])
    assert limits.guard(q, dq, np.array([0, 0, 0, 0, -1.0]))[4] == -1.0
    limits.trust(np.array([True, False, True, True, True]))
    assert limits.guard(q, dq, np.full(5, 4.0))[1] == 4.0


def test_position_limits_may_only_be_narrowed():
    limits = JointLimits(board())
    limits.set_position(ONE, np.array([-0.5]), np.array([0.5]))
    saved, clipped = limits.clip(np.array([0, 1]), np.array([0.7, 0.7]))
    assert saved == pytest.approx([0.5, 0.7])
    assert clipped.tolist() == [True, False]
    for low, high in ((-2, 0), (0.5, 0.2), (0, 1.5)):
        with pytest.raises(BadValue):
            limits.set_position(ONE, np.array([float(low)]), np.array([float(high)]))
    with pytest.raises(BadValue):
        limits.set_speed(ONE, np.array([0.0]))


DIFFERENTIAL = [[1.0, 1.0], [1.0, -1.0]]


@given(st.tuples(*(st.floats(-5, 5) for _ in range(4))))
def test_motor_and_joint_power_are_equal(values):
    motors = Motors(board(2, DIFFERENTIAL))
    torque, velocity = np.array(values[:2]), np.array(values[2:])
    motor_torque = motors.current(torque) * motors.torque_constant
    work = motor_torque @ (motors.to_motor @ velocity)
    assert work == pytest.approx(torque @ velocity, abs=1e-9)
    assert motors.torque_of_current(motors.current(torque)) == pytest.approx(torque, abs=1e-9)
    duty = motors.duty(torque, velocity)
    if (np.abs(duty) < 100).all():
        assert motors.torque_of_duty(duty, velocity) == pytest.approx(torque, abs=1e-6)


def test_motor_encoders_count_through_gear_and_coupling():
    motors = Motors(board(2, DIFFERENTIAL))
    q = np.array([0.1, 0.2])
    turns = 100 * np.array([0.3, -0.1]) / (2 * np.pi)
    assert motors.encoder(q) == pytest.approx(turns * 4096, abs=1.0)
    motors.set_encoder(np.array([1]), np.array([5.0]), q)
    assert motors.encoder(q)[1] == 5.0
    assert motors.speed(q) == pytest.approx(turns * 4096)


def test_board_spec_refuses_invalid_boards():
    with pytest.raises(BadValue, match="no motor"):
        board(2, [[1.0, 0.0], [1.0, 0.0]])
    with pytest.raises(BadValue, match="as many motors"):
        board(2, [[1.0]])
    chain = [[1.0, 0, 0, 0], [1, 1, 0, 0], [0, 1, 1, 0], [0, 0, 0, 1]]
    assert board(4, chain).coupled(0).tolist() == [0, 1, 2]
    assert board(4, chain).coupled(3).tolist() == [3]


def test_board_spec_without_couplings_needs_no_search(monkeypatch):
    """A rank takes the third power of the number of joints: half a minute for a thousand."""
    monkeypatch.setattr(np.linalg, "matrix_rank", None)
    spec = board(500)
    assert spec.coupled(499).tolist() == [499]
    with pytest.raises(BadValue, match="no motor"):
        board(3, np.diag([1.0, 0.0, 1.0]))


def test_board_spec_finds_joints_by_name_or_number():
    select = Selector(("a", "b"))
    assert select.indices(["b", "a"]).tolist() == [1, 0]
    assert select.indices(None).tolist() == [0, 1]
    for wrong in (["c"], [2], [-1], ["a", "a"], ["a", 0]):
        with pytest.raises(UnknownJoint):
            select.indices(wrong)


@pytest.mark.parametrize("wrong", [[1.0], [1.0, np.nan], "x", [1, "y"], None, [[1, 2]], np.inf])
def test_control_law_refuses_non_finite_values(wrong):
    with pytest.raises(BadValue):
        numbers("x", wrong, 2)
