import math
from dataclasses import replace

import pytest

from robocomp_dsl.hardware.devices.differential_robot import DifferentialRobotDevice, Mechanics
from robocomp_dsl.hardware.devices.errors import CommandRefused, SceneError
from robocomp_dsl.hardware.kinematics.planar import Pose
from robocomp_dsl.simulation.devices.differential_robot import DifferentialRobot
from robocomp_dsl.simulation.scene.room import Pillar, Room, Wall
from robocomp_dsl.simulation.world.world import World

START = Pose(1000, 2000, 0.5)
EMPTY = Room()
IDEAL = Mechanics(encoder_steps=0)


def robot_at(
    room: Room = EMPTY, mechanics: Mechanics = IDEAL, **options: float
) -> tuple[World, DifferentialRobot]:
    robot = DifferentialRobot(mechanics, START, **options)
    return World(room.spec(), (robot,), seed=7), robot


def test_base_is_a_device() -> None:
    device: DifferentialRobotDevice = robot_at()[1]
    assert device.mechanics is IDEAL


def test_base_stays_where_it_is_placed() -> None:
    world, robot = robot_at()
    world.advance(1.0)
    state = robot.state()
    assert state.time == pytest.approx(1.0)
    assert (state.corrected.x, state.corrected.z) == pytest.approx((1000, 2000), abs=0.1)
    assert state.corrected.alpha == pytest.approx(0.5, abs=1e-4)
    assert state.odometry.z == pytest.approx(0, abs=1e-9)
    assert not state.moving


def test_base_drives_ahead_at_commanded_speed() -> None:
    world, robot = robot_at()
    robot.set_speed(300, 0)
    world.advance(2.0)
    state = robot.state()
    assert state.adv == pytest.approx(300, rel=1e-3)
    assert state.rot == pytest.approx(0, abs=1e-6)
    assert state.moving
    # v²/2a is lost while it gathers speed
    expected = 300 * 2.0 - 300**2 / (2 * IDEAL.max_acceleration)
    assert state.odometry.z == pytest.approx(expected, rel=0.01)
    ahead = START.then(Pose(0, expected, 0))
    assert (state.corrected.x, state.corrected.z) == pytest.approx((ahead.x, ahead.z), abs=8)


def test_base_turns_right_with_positive_rotation() -> None:
    world, robot = robot_at()
    robot.set_speed(0, 1.0)
    world.advance(1.0)
    state = robot.state()
    assert state.rot == pytest.approx(1.0, rel=1e-3)
    assert state.corrected.alpha == pytest.approx(0.5 + 0.9, abs=0.1)
    assert math.hypot(state.corrected.x - 1000, state.corrected.z - 2000) < 5


def test_base_odometry_agrees_with_true_motion_within_one_percent() -> None:
    world, robot = robot_at()
    robot.set_speed(400, 0.6)
    world.advance(8.0)
    state = robot.state()
    guess = START.then(state.odometry)
    assert math.hypot(guess.x - state.corrected.x, guess.z - state.corrected.z) < 0.01 * 400 * 8


def test_base_drift_changes_odometry_only() -> None:
    def drive(drift: float) -> tuple[Pose, Pose]:
        world, robot = robot_at(drift=drift)
        robot.set_speed(400, 0)
        world.advance(5.0)
        return robot.state().odometry, robot.state().corrected

    (straight, truth), (bent, same_truth) = drive(0.0), drive(0.05)
    assert same_truth == truth
    assert math.hypot(bent.x - straight.x, bent.z - straight.z) > 10


def test_base_encoders_count_whole_steps() -> None:
    coarse = replace(IDEAL, encoder_steps=4, gear_ratio=1)
    world, robot = robot_at(mechanics=coarse)
    robot.set_speed(100, 0)
    seen = set()
    for _ in range(200):
        world.advance(0.02)
        seen.add(round(robot.state().odometry.z, 6))
    step = math.tau * IDEAL.wheel_radius / 4
    assert len(seen) == 1 + int(robot.state().odometry.z / step + 0.5)
    assert all(abs(z / step - round(z / step)) < 1e-6 for z in seen)


def test_base_is_stopped_by_wall_while_wheels_slip() -> None:
    room = Room(walls=(Wall(-5000, 3000, 5000, 3000, 100, 1000),))
    world, robot = robot_at(room)
    robot.set_speed(500, 0)
    world.advance(6.0)
    state = robot.state()
    front = 3000 - 50 - IDEAL.body_radius
    assert state.corrected.z == pytest.approx(front, abs=20)
    assert state.odometry.z > 2000  # the encoders know nothing of the wall


def test_base_stops() -> None:
    world, robot = robot_at()
    robot.set_speed(800, 0)
    world.advance(1.0)
    robot.stop()
    world.advance(0.5)
    assert robot.state().adv == pytest.approx(0, abs=1)
    assert not robot.state().moving


def test_base_is_stopped_by_watchdog() -> None:
    world, robot = robot_at(watchdog=0.3)
    robot.set_speed(300, 0)
    world.advance(0.3)
    assert robot.state().moving
    world.advance(0.7)
    assert not robot.state().moving
    robot.set_speed(300, 0)
    world.advance(0.3)
    assert robot.state().moving


@pytest.mark.parametrize(
    ("adv", "rot", "message"),
    [
        (math.nan, 0, "`adv` is nan, it must be a finite number"),
        (0, math.inf, "`rot` is inf, it must be a finite number"),
        (801, 0, "`adv` is 801 mm/s, the limit is ±800 mm/s"),
        (0, -2.5, "`rot` is -2.5 rad/s, the limit is ±2 rad/s"),
    ],
)
def test_base_refuses_invalid_command_unchanged(adv: float, rot: float, message: str) -> None:
    world, robot = robot_at()
    robot.set_speed(200, 0)
    with pytest.raises(CommandRefused) as refusal:
        robot.set_speed(adv, rot)
    assert str(refusal.value) == message
    world.advance(1.0)
    assert robot.state().adv == pytest.approx(200, rel=1e-2)


def test_base_odometry_continues_from_set_pose() -> None:
    world, robot = robot_at()
    robot.set_odometry(Pose(10, 20, math.pi / 2))
    robot.set_speed(200, 0)
    world.advance(1.0)
    assert robot.state().odometry.x > 150
    assert robot.state().odometry.z == pytest.approx(20, abs=1)
    with pytest.raises(CommandRefused):
        robot.set_odometry(Pose(math.nan, 0, 0))


def test_base_correction_moves_corrected_pose_only() -> None:
    world, robot = robot_at()
    robot.correct(Pose(0, 0, 0))
    corrected = robot.state().corrected
    assert (corrected.x, corrected.z, corrected.alpha) == pytest.approx((0, 0, 0), abs=1e-9)
    robot.set_speed(300, 0)
    world.advance(1.0)
    state = robot.state()
    assert state.corrected.x == pytest.approx(0, abs=2)
    assert state.corrected.z == pytest.approx(state.odometry.z, abs=5)
    assert robot.true_pose().z > 2000
    with pytest.raises(CommandRefused):
        robot.correct(Pose(0, math.inf, 0))


def test_base_cannot_start_inside_something() -> None:
    room = Room(pillars=(Pillar("lamp", 1000, 2100, 150, 1000),))
    with pytest.raises(SceneError, match=r"the robot starts inside `pillar 1 lamp`: x 1000 mm"):
        robot_at(room)
