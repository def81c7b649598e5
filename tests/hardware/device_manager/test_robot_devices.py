"""A robot's boards, calibrators and a Cartesian controller through their whole life, simulated."""

from __future__ import annotations

import threading
from collections.abc import Iterator
from contextlib import contextmanager

import numpy as np
import pytest

from robocomp_dsl.hardware.control.errors import BadValue
from robocomp_dsl.hardware.control.modes import Mode
from robocomp_dsl.hardware.device_manager.boards import BoardPart, board_kinds
from robocomp_dsl.hardware.device_manager.description import Phase
from robocomp_dsl.hardware.device_manager.manager import DeviceManager
from robocomp_dsl.hardware.device_manager.read import read_plan
from robocomp_dsl.hardware.devices.errors import CommandRefused
from robocomp_dsl.hardware.kinematics.cartesian_controller import CartesianState
from robocomp_dsl.hardware.servants.fair_lock import FairLock
from robocomp_dsl.simulation.devices.control_board_chain import extract_chain
from tests.support.simulated_arm import Arm

ZERO = np.array([0.3, -0.2, 0.25, 0.1, -0.4, 0.05])
LONG = 60.0

DEVICES = {
    "devices": [
        {"name": "arm", "kind": "control_board", "part": "LArm"},
        {
            "name": "zeroing",
            "kind": "calibrator",
            "speed": 1.0,
            "home.LShoulderPitch": 1.0,
            "home.LElbowRoll": -0.8,
            "park.LElbowRoll": -0.3,
            "park.LShoulderPitch": 1.4,
            **{f"zero.{joint}": float(ZERO[i]) for i, joint in enumerate(("LShoulderPitch",))},
        },
        {"name": "hand", "kind": "cartesian", "tip": "l_hand"},
    ],
    "attach": {"zeroing": ["arm"], "hand": ["arm"]},
    "actions": [
        {"phase": "startup", "level": 5, "calibrate": "arm"},
        {"phase": "shutdown", "level": 1, "park": "arm"},
    ],
}


class Robot:
    """A NAO's arm whose world goes on in a thread, as fast as it can."""

    def __init__(self) -> None:
        self.zero = np.zeros(6)
        self.zero[0] = ZERO[0]
        self.arm = Arm("nao", self.zero)
        self.arm.world.model.opt.gravity[:] = 0  # what is switched off stays where it is
        self.turn = FairLock()
        part = BoardPart(self.arm.board, self.arm.spec.names)
        self.kinds = board_kinds({"LArm": part}, self.turn, self.chain)
        self._over = threading.Event()

    def chain(self, spec, joints):
        five = joints[:5]
        return extract_chain(self.arm.world.model, five, spec.parameters["tip"]), five

    @contextmanager
    def alive(self) -> Iterator[None]:
        thread = threading.Thread(target=self._live)
        thread.start()
        try:
            yield
        finally:
            self._over.set()
            thread.join()

    def _live(self) -> None:
        while not self._over.is_set():
            with self.turn:
                self.arm.world.advance(0.02)

    def true(self, joint: str) -> float:
        return float(self.arm.world.data.joint(joint).qpos[0])


def test_robot_devices_calibrate_use_and_park_arm():
    robot = Robot()
    conductor = DeviceManager(read_plan(DEVICES), robot.kinds)
    with robot.alive():
        assert conductor.start()
        with robot.turn:
            assert set(robot.arm.board.table.modes) == {Mode.POSITION}
            assert robot.true("LShoulderPitch") == pytest.approx(1.0, abs=0.1)
            assert robot.true("LElbowRoll") == pytest.approx(-0.8, abs=0.1)
        hand = conductor.devices["hand"].controller
        with robot.turn:
            goal = hand.pose()
            goal[:3, 3] += (5.0, -5.0, 5.0)
            hand.go_to(goal[:3, 3], 0.5)
        advance_until(robot, lambda: hand.state is CartesianState.REACHED)
        assert conductor.shutdown()
        with robot.turn:
            assert set(robot.arm.board.table.modes) == {Mode.IDLE}
            assert robot.true("LElbowRoll") == pytest.approx(-0.3, abs=0.2)
    assert robot.arm.board.motion_overrides == []
    assert conductor.phase is Phase.CLOSED


def test_robot_devices_interrupt_ends_calibration_without_motor_power():
    robot = Robot()
    conductor = DeviceManager(read_plan(DEVICES), robot.kinds)
    result: list[bool] = []
    with robot.alive():
        starter = threading.Thread(target=lambda: result.append(conductor.start()))
        starter.start()
        advance_until(robot, lambda: Mode.CALIBRATING in robot.arm.board.table.modes)
        conductor.interrupt()
        starter.join(LONG)
        assert result == [False]
        with robot.turn:
            assert Mode.NOT_CONFIGURED in robot.arm.board.table.modes
        assert not conductor.shutdown()  # what is not calibrated cannot be parked
        with robot.turn:
            assert not robot.arm.board.table.effective[0].startswith("pos")
            robot.arm.world.advance(0.01)
            assert not robot.arm.board.torque.any()


def advance_until(robot: Robot, done) -> None:
    """Wait, in turns with the world, until `done()`; a minute of the world's time at most."""
    with robot.turn:
        last = robot.arm.world.time + LONG
    while True:
        with robot.turn:
            if done():
                return
            assert robot.arm.world.time < last


@pytest.mark.parametrize(
    ("change", "error", "message"),
    [
        ({"part": "tail"}, CommandRefused, "there is no part `tail`: LArm"),
        ({"speed": "fast"}, BadValue, "`speed` must be a number"),
    ],
)
def test_robot_devices_refuse_unknown_parameters(change, error, message):
    robot = Robot()
    devices = [dict(device) for device in DEVICES["devices"]]
    devices[0 if "part" in change else 1].update(change)
    conductor = DeviceManager(read_plan({**DEVICES, "devices": devices}), robot.kinds)
    with pytest.raises(error, match=message):
        conductor.start()


def test_robot_devices_fail_startup_with_parameter_of_unknown_joint(caplog):
    robot = Robot()
    devices = [dict(device) for device in DEVICES["devices"]]
    devices[1]["home.LTail"] = 1.0
    conductor = DeviceManager(
        read_plan({**DEVICES, "devices": devices, "actions": []}), robot.kinds
    )
    assert not conductor.start()
    assert "there is no parameter `home.LTail`" in caplog.text
    conductor.shutdown()


def test_robot_devices_attach_controllers_to_boards_only(caplog):
    robot = Robot()
    data = {**DEVICES, "attach": {"hand": "zeroing"}, "actions": []}
    conductor = DeviceManager(read_plan(data), robot.kinds)
    assert not conductor.start()
    assert "`zeroing` is not a control board" in caplog.text
    conductor.shutdown()
