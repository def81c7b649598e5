"""The control board: velocities, springs, calibration, parking, refusals, settings."""

from __future__ import annotations

import numpy as np
import pytest

from robocomp_dsl.hardware.control.board import Board
from robocomp_dsl.hardware.control.calibration import CalibrationMethod, Calibrator, Procedure
from robocomp_dsl.hardware.control.commands import Commands
from robocomp_dsl.hardware.control.errors import (
    BadValue,
    ControlRefused,
    ModeRefused,
    NoSpeed,
    NotEquipped,
    UnknownJoint,
    WrongMode,
)
from robocomp_dsl.hardware.control.joints import BoardSpec, JointSpec, MotorSpec
from robocomp_dsl.hardware.control.modes import SELECTABLE, Interaction, Mode
from robocomp_dsl.hardware.control.parking import Parking, ParkState
from robocomp_dsl.hardware.control.protection.faults import FaultCode
from robocomp_dsl.hardware.control.regulators.pid import Gains
from robocomp_dsl.hardware.control.settings import ControlSettings
from robocomp_dsl.hardware.control.variables import RemoteVariables
from robocomp_dsl.hardware.devices.errors import SceneError
from robocomp_dsl.simulation.devices.control_board import SimulatedBoard
from robocomp_dsl.simulation.robots.boards import board_names, robot_board, whole_robot
from robocomp_dsl.simulation.robots.build import add_robot, new_world
from robocomp_dsl.simulation.robots.catalog import ROBOTS
from robocomp_dsl.simulation.world.world import World
from tests.support.simulated_arm import Arm


def test_velocities_are_reached_by_the_acceleration_and_held(arm):
    arm.command.set_mode(None, Mode.POSITION)
    arm.settings.set_reference_speed(None, 1.0)
    arm.go(None, arm.inside)
    arm.command.set_mode(None, Mode.VELOCITY)
    arm.settings.set_acceleration(None, 0.5)
    arm.command.velocity_move(None, 0.2)
    arm.world.advance(0.2)
    assert arm.board.references.velocity == pytest.approx(np.full(len(arm.inside), 0.1), abs=0.01)
    arm.world.advance(0.5)
    assert arm.board.velocity == pytest.approx(np.full(len(arm.inside), 0.2), abs=0.03)
    arm.command.velocity_move(None, 0.2, hold=0.1)
    arm.world.advance(1.0)
    assert arm.board.velocity == pytest.approx(np.zeros(len(arm.inside)), abs=0.01)
    fast = arm.command.velocity_move(None, 100.0)
    assert fast.all()
    assert (arm.board.references.ramp.target == arm.board.limits.speed).all()
    arm.command.stop()


def test_direct_velocities_are_there_at_once(arm):
    arm.command.set_mode(None, Mode.POSITION)
    arm.settings.set_reference_speed(None, 1.0)
    arm.go(None, arm.inside)
    arm.command.set_mode(None, Mode.VELOCITY_DIRECT)
    arm.command.set_velocity(None, 0.2)
    arm.world.advance(0.002)
    assert arm.board.references.velocity == pytest.approx(np.full(len(arm.inside), 0.2))
    arm.world.advance(0.5)
    assert arm.board.velocity == pytest.approx(np.full(len(arm.inside), 0.2), abs=0.02)
    arm.command.set_velocity(None, 0.0)
    arm.world.advance(0.3)
    assert arm.board.velocity == pytest.approx(np.zeros(len(arm.inside)), abs=0.01)


def test_mixed_mode_adds_a_velocity_to_a_motion(arm):
    arm.command.set_mode(None, Mode.POSITION)
    arm.settings.set_reference_speed(None, 1.0)
    start = arm.inside - 0.15
    arm.go(None, start)
    arm.command.set_mode(None, Mode.MIXED)
    arm.settings.set_reference_speed(None, 0.1)
    arm.command.position_move(None, start + 0.1)
    arm.command.velocity_move(None, 0.05, hold=1.0)
    arm.world.advance(2.0)
    assert arm.board.position == pytest.approx(start + 0.15, abs=0.02)


def test_a_compliant_arm_gives_way_and_comes_back(arm):
    joint = 3
    arm.command.set_mode(None, Mode.POSITION)
    arm.settings.set_reference_speed(None, 1.0)
    arm.go(None, arm.inside)
    torque, dof = 0.1 * arm.spec.joints[joint].torque_limit, arm.part._speed[joint]

    def pushed(stiffness: float | None) -> float:
        if stiffness:
            arm.command.set_interaction([joint], Interaction.COMPLIANT)
            arm.settings.set_impedance([joint], stiffness, 0.1 * stiffness)
        before = arm.board.position[joint]
        arm.world.data.qfrc_applied[dof] = torque
        arm.world.advance(3.0)
        moved = arm.board.position[joint] - before
        arm.world.data.qfrc_applied[dof] = 0.0
        arm.world.advance(3.0)
        assert arm.board.position[joint] == pytest.approx(arm.inside[joint], abs=0.02)
        return float(moved)

    soft = 4.0 * torque
    assert abs(pushed(None)) < 0.01
    assert pushed(soft) == pytest.approx(0.25, abs=0.03)
    assert pushed(2 * soft) == pytest.approx(0.125, abs=0.02)
    arm.settings.set_impedance_offset([joint], -0.1 * torque)
    arm.world.advance(2.0)
    assert arm.board.position[joint] - arm.inside[joint] == pytest.approx(-0.0125, abs=0.005)


WRONG_COMMANDS = {
    "position_move": (Mode.POSITION, Mode.MIXED),
    "relative_move": (Mode.POSITION, Mode.MIXED),
    "set_position": (Mode.POSITION_DIRECT,),
    "velocity_move": (Mode.VELOCITY, Mode.MIXED),
    "set_velocity": (Mode.VELOCITY_DIRECT,),
    "set_torque": (Mode.TORQUE,),
    "set_duty": (Mode.PWM,),
    "set_current": (Mode.CURRENT,),
}


def plain_board(n: int = 3, **joint) -> tuple[Board, Commands]:
    joints = tuple(JointSpec(f"j{i}", -1.0, 1.0, 2.0, 5.0, **joint) for i in range(n))
    board = Board(BoardSpec(joints, tuple(MotorSpec(f"m{i}") for i in range(n))))
    return board, Commands(board)


@pytest.mark.parametrize("mode", [m for m in SELECTABLE if m is not Mode.FORCE_IDLE])
@pytest.mark.parametrize("name", WRONG_COMMANDS)
def test_a_command_for_another_mode_is_refused(name, mode):
    _, command = plain_board()
    command.set_mode(None, mode)
    if mode in WRONG_COMMANDS[name]:
        getattr(command, name)(None, 0.1)
    else:
        with pytest.raises(WrongMode, match=f"is in mode `{mode}`; `{name}` needs"):
            getattr(command, name)(None, 0.1)


@pytest.mark.parametrize(
    ("joints", "values", "error"),
    [
        (None, np.nan, BadValue),
        (None, [0.0, np.inf, 0.0], BadValue),
        (None, [0.0], BadValue),
        (["j9"], 0.0, UnknownJoint),
        ([3], 0.0, UnknownJoint),
        (["j0", "j0"], 0.0, UnknownJoint),
        (None, "fast", BadValue),
    ],
)
@pytest.mark.parametrize("name", WRONG_COMMANDS)
def test_commands_that_cannot_be_meant_change_nothing(name, joints, values, error):
    board, command = plain_board()
    command.set_mode(None, WRONG_COMMANDS[name][0])
    board.step(np.zeros(3), np.zeros(3), 0.001)
    with pytest.raises(error):
        getattr(command, name)(joints, values)
    assert not board.step(np.zeros(3), np.zeros(3), 0.001).any()


def test_other_refusals():
    board, command = plain_board(torque_control=False)
    with pytest.raises(NotEquipped):
        command.set_interaction(None, Interaction.COMPLIANT)
    command.set_mode(None, Mode.POSITION)
    ControlSettings(board).set_reference_speed([1], 0.0)
    with pytest.raises(NoSpeed, match="`j1`"):
        command.position_move(None, 0.5)
    command.set_mode(None, Mode.TORQUE)
    with pytest.raises(NotEquipped):
        command.set_torque(None, 1.0)
    with pytest.raises(BadValue):
        command.set_mode([0, 1], [Mode.IDLE])
    command.set_mode(None, [Mode.IDLE, Mode.POSITION, Mode.VELOCITY])
    assert board.table.modes == [Mode.IDLE, Mode.POSITION, Mode.VELOCITY]


def test_an_encoder_without_a_number_is_a_fault_of_its_joint_alone():
    board, command = plain_board()
    command.set_mode(None, Mode.POSITION)
    board.step(np.full(3, 0.1), np.zeros(3), 0.001)
    torque = board.step(np.array([0.1, np.nan, 0.2]), np.zeros(3), 0.001)
    assert board.table.modes == [Mode.POSITION, Mode.HW_FAULT, Mode.POSITION]
    assert board.faults.last[1].code is FaultCode.ENCODER
    assert np.isfinite(torque).all()
    assert torque[1] == 0.0
    assert board.position == pytest.approx([0.1, 0.1, 0.2])


def test_heat_and_lateness_are_faults():
    board, command = plain_board()
    command.set_mode(None, [Mode.POSITION, Mode.POSITION, Mode.IDLE])
    board.step(np.zeros(3), np.zeros(3), 0.001)
    board.motors.set_temperature(np.array([100.0, 25.0, 25.0]))
    board.pid.set_error_limits(np.arange(3), np.full(3, 0.2))
    board.step(np.array([0.0, 0.3, 0.3]), np.zeros(3), 0.001)
    assert [item.code for item in board.faults.last] == [
        FaultCode.OVERTEMPERATURE,
        FaultCode.TRACKING,
        FaultCode.NONE,
    ]


def test_coupled_joints_change_together():
    icub = robot_board(ROBOTS["icub_v2"](), "right_arm")
    board = Board(icub.spec)
    command = Commands(board)
    command.set_mode(["r_shoulder_roll"], Mode.POSITION)
    assert board.table.modes == [Mode.POSITION] * 3 + [Mode.IDLE] * 4
    with pytest.raises(ModeRefused, match="coupled"):
        command.set_mode([0, 1], [Mode.VELOCITY, Mode.TORQUE])
    assert board.table.modes[0] is Mode.POSITION
    board.fault(np.array([2]), FaultCode.EXTERNAL, "pulled the plug")
    assert board.table.modes == [Mode.HW_FAULT] * 3 + [Mode.IDLE] * 4


def test_the_whole_robot_may_be_one_board():
    for name in ROBOTS:
        robot = ROBOTS[name]()
        whole = whole_robot(robot)
        assert len(whole.spec.joints) == len(robot.motors)
        parts = [robot_board(robot, part) for part in board_names(robot)]
        assert whole.spec.names == tuple(n for part in parts for n in part.spec.names)
    with pytest.raises(KeyError):
        robot_board(robot, "tail")


def test_the_eyes_turn_by_version_and_vergence():
    robot = ROBOTS["icub_v2"]()
    spec = new_world()
    add_robot(spec, robot)
    head = SimulatedBoard(robot_board(robot, "head"))
    world = World(spec, [head])
    head.commands.set_mode(None, Mode.POSITION)
    head.settings.set_reference_speed(None, 1.0)
    head.commands.position_move(["eyes_version", "eyes_vergence"], [0.2, 0.3])
    world.advance(1.5)
    left, right = (world.data.joint(f"{side}_eye_pan").qpos[0] for side in "lr")
    assert (left, right) == pytest.approx((0.35, 0.05), abs=0.01)


def test_a_world_without_the_joints_is_refused():
    robot = ROBOTS["nao_h21"]()
    spec = new_world()
    add_robot(spec, robot, prefix="a_")
    World(spec, [SimulatedBoard(robot_board(robot, "LArm"), prefix="a_")])
    spec = new_world()
    with pytest.raises(SceneError, match="no joint `LShoulderPitch`"):
        World(spec, [SimulatedBoard(robot_board(robot, "LArm"))])


ZERO = np.array([0.4, -0.3, 0.2, 0.5, -0.6, 0.1])


def test_calibration_finds_the_zero_and_goes_home():
    arm = Arm("nao", ZERO)
    assert set(arm.board.table.modes) == {Mode.NOT_CONFIGURED}
    with pytest.raises(ModeRefused, match="not calibrated"):
        arm.command.set_mode(None, Mode.POSITION)
    home = arm.inside
    hard = Procedure(
        CalibrationMethod.HARD_STOP, duty=-8.0, stop=arm.board.limits.low[4], home=home[4], speed=1
    )
    plain = [Procedure(zero=ZERO[i], home=home[i], speed=1.0) for i in range(6)]
    calibrator = Calibrator(arm.board, (*plain[:4], hard, plain[5]))
    calibrator.calibrate()
    arm.world.advance(0.05)
    assert set(arm.board.table.modes) == {Mode.CALIBRATING}
    with pytest.raises(ModeRefused, match="being calibrated"):
        arm.command.set_mode(None, Mode.POSITION)
    assert arm.wait(lambda: not calibrator.busy, 20)
    assert set(arm.board.table.modes) == {Mode.POSITION}
    true = np.array([arm.world.data.joint(name).qpos[0] for name in arm.spec.names])
    assert arm.board.position == pytest.approx(true, abs=0.03)
    assert true == pytest.approx(home, abs=0.05)
    arm.go(None, home + 0.2)
    calibrator.home([0])
    arm.world.advance(1.0)
    assert arm.board.position[:2] == pytest.approx([home[0], home[1] + 0.2], abs=0.03)


def test_a_calibration_that_takes_too_long_is_a_fault():
    arm = Arm("nao", ZERO)
    slow = Procedure(CalibrationMethod.HARD_STOP, duty=0.5, stop=1.0, timeout=0.5)
    calibrator = Calibrator(arm.board, (slow,) * 6)
    calibrator.calibrate([0])
    arm.world.advance(1.0)
    assert arm.board.table.modes[0] is Mode.HW_FAULT
    assert arm.board.faults.last[0].code is FaultCode.CALIBRATION
    with pytest.raises(ModeRefused):
        calibrator.calibrate([0])
    arm.command.set_mode([0], Mode.FORCE_IDLE)
    calibrator.calibrate([0, 1])
    arm.command.set_mode([1], Mode.FORCE_IDLE)
    arm.world.advance(0.01)
    assert arm.board.table.modes[1] is Mode.IDLE
    calibrator.quit()
    assert arm.board.table.modes[0] is Mode.NOT_CONFIGURED


def test_impossible_calibrations_are_refused():
    board, _ = plain_board()
    for wrong in ({"kind": CalibrationMethod.HARD_STOP}, {"speed": 0.0}, {"timeout": 0.0}):
        with pytest.raises(BadValue):
            Procedure(**wrong)
    with pytest.raises(BadValue):
        Calibrator(board, (Procedure(),))


def test_parking_brings_the_arm_to_rest_and_switches_it_off(arm):
    arm.world.model.opt.gravity[:] = 0  # what is switched off would fall
    parking = Parking(arm.board, arm.inside, speed=1.0)
    parking.park()
    assert parking.busy
    assert arm.wait(lambda: not parking.busy, 10)
    assert set(parking.states) == {ParkState.PARKED}
    assert set(arm.board.table.modes) == {Mode.IDLE}
    assert arm.board.position == pytest.approx(arm.inside, abs=0.25)  # it swings out


def test_parking_may_be_stopped_and_may_fail(arm):
    parking = Parking(arm.board, arm.inside, speed=0.01, timeout=0.3)
    parking.park()
    parking.quit()
    assert not parking.busy
    assert arm.command.motion_done().all()
    parking.park()
    arm.world.advance(0.5)
    assert ParkState.FAILED in parking.states
    arm.board.fault(np.array([0]), FaultCode.EXTERNAL, "test")
    with pytest.raises(ModeRefused):
        parking.park()


def test_settings_are_checked_and_move_nothing(arm):
    arm.command.set_mode(None, Mode.POSITION)
    arm.world.advance(0.2)
    first = arm.spec.names[0]
    arm.settings.set_pid(first, Gains(kp=1.0))
    assert arm.settings.pid(0).kp == 1.0
    here = arm.board.position.copy()
    arm.settings.set_encoder([first], here[0] + 0.1)
    arm.settings.set_motor_encoder([first], 7)
    assert arm.board.state().motor_counts[0] == 7
    arm.world.advance(0.2)
    moved = arm.world.data.joint(first).qpos[0] - here[0]
    assert abs(moved) < 0.02
    assert arm.board.position[0] == pytest.approx(here[0] + 0.1, abs=0.02)
    low, high = arm.settings.position_limits()
    arm.settings.set_position_limits([1], low[1] + 0.1, high[1] - 0.1)
    assert arm.settings.position_limits([1])[0] == pytest.approx(low[1] + 0.1)
    assert arm.settings.last_fault(first).code is FaultCode.NONE
    arm.settings.set_speed_limits(None, 1.0)
    for wrong in (
        lambda: arm.settings.set_position_limits([1], low[1] - 1.0, high[1]),
        lambda: arm.settings.set_encoder([0], np.nan),
        lambda: arm.settings.set_speed_limits(None, 0.0),
        lambda: arm.settings.set_impedance([0], 1e9, 0.0),
        lambda: arm.settings.pid("nobody"),
    ):
        with pytest.raises(ControlRefused):
            wrong()


def test_settings_are_read_back_and_regulators_switched():
    board, command = plain_board()
    settings = ControlSettings(board)
    command.set_mode(None, Mode.POSITION)
    settings.set_reference_speed(["j1"], 0.7)
    settings.set_acceleration([2], 3.0)
    settings.set_impedance(["j0"], 2.0, 0.5)
    settings.set_impedance_offset(["j0"], 0.1)
    assert settings.reference_speed(["j1"]).tolist() == [0.7]
    assert settings.acceleration().tolist() == [10.0, 10.0, 3.0]
    assert settings.impedance("j0") == (2.0, 0.5, 0.1)
    board.step(np.zeros(3), np.zeros(3), 0.001)
    off = np.full(3, -0.02)
    assert (board.step(off, np.zeros(3), 0.001) > 0.5).all()
    settings.enable_pid(["j1"], on=False)
    torque = board.step(off, np.zeros(3), 0.001)
    assert torque[1] == 0.0
    assert torque[0] > 0.5
    for _ in range(100):
        board.step(off, np.zeros(3), 0.01)
    summed = board.pid.integral.copy()
    settings.reset_pid([0])
    assert board.pid.integral.tolist() == [0.0, 0.0, summed[2]]
    assert summed[2] > 0.0
    settings.set_max_current(None, 0.0)
    board.step(off, np.zeros(3), 0.001)
    assert board.table.modes == [Mode.HW_FAULT] * 3
    with pytest.raises(BadValue):
        settings.set_max_current([0], -1.0)


def test_remote_variables_are_read_and_written():
    board, _ = plain_board()
    variables = RemoteVariables(board)
    assert "pid.j1" in variables.keys()  # noqa: SIM118 - not a dictionary
    variables.set("pid.j1", [1, 2, 3, 0])
    assert board.pid.gains[1].kp == 1.0
    assert variables.get("pid.j1").tolist() == [1, 2, 3, 0]
    variables.set("speed_limits", 0.5)
    assert board.limits.speed.tolist() == [0.5] * 3
    for key, values in (
        ("pid.j9", [1, 2, 3, 0]),
        ("pid.j1", [1, 2]),
        ("pid.j1", [-1, 0, 0, 0]),
        ("gears", [1, 1, 1]),
        ("max_currents", [-1, 0, 0]),
        ("tracking_limits", 0.0),
    ):
        with pytest.raises(ControlRefused):
            variables.set(key, values)
    with pytest.raises(BadValue, match="there is no variable"):
        variables.get("x")
