"""A driver behind the ports of a component: opened, lost, opened again; and motors on a board."""

from __future__ import annotations

import threading
import time
from collections.abc import Iterator
from contextlib import suppress

import numpy as np
import pytest

from robocomp_dsl.hardware.conformance.rules import RULES, ConformanceRule, Violation
from robocomp_dsl.hardware.conformance.trial import MAY_MOVE, on_hardware
from robocomp_dsl.hardware.control.joints import BoardSpec, JointSpec, MotorSpec
from robocomp_dsl.hardware.control.modes import Interaction, Mode
from robocomp_dsl.hardware.control.protection.faults import FaultCode
from robocomp_dsl.hardware.control.regulators.loops import Loop
from robocomp_dsl.hardware.control.regulators.pid import Gains
from robocomp_dsl.hardware.devices.errors import DriverMethodMissing, HardwareError
from robocomp_dsl.hardware.drivers.driver_host import DriverHost
from tests.support.waiting import wait_until

JOINT = JointSpec("pan", -1.0, 1.0, 3.0, 5.0)
DEADLINE_S = 60.0


class Motor:
    """A joint without load that lives by the wall clock."""

    spec = BoardSpec((JOINT,), (MotorSpec("pan"),))

    def __init__(self) -> None:
        self.failing = ""
        self.opened = self.closed = 0
        self.torque, self.position, self.velocity = 0.0, 0.3, 0.0
        self.last = time.perf_counter()

    def open(self) -> None:
        if self.failing:
            raise OSError(self.failing)
        self.opened += 1
        self.last = time.perf_counter()

    def close(self) -> None:
        self.closed += 1

    def read(self) -> tuple[np.ndarray, np.ndarray]:
        if self.failing:
            raise OSError(self.failing)
        now = time.perf_counter()
        for _ in range(min(round((now - self.last) / 0.0005), 100)):
            self.velocity += (self.torque - 0.2 * self.velocity) / 0.05 * 0.0005
            self.position += self.velocity * 0.0005
        self.last = now
        return np.array([self.position]), np.array([self.velocity])

    def write(self, torque: np.ndarray) -> None:
        self.torque = float(torque[0])


@pytest.fixture
def motor() -> Motor:
    return Motor()


@pytest.fixture
def hardware(motor: Motor) -> Iterator[DriverHost]:
    result = DriverHost(motor, ("pan",), motors=True)
    yield result
    result.close()
    assert "motors" not in {thread.name for thread in threading.enumerate()}


def test_driver_host_refuses_calls_before_device_is_opened(hardware: DriverHost) -> None:
    with pytest.raises(HardwareError, match="`pan` is not there: it has not been opened yet"):
        hardware.devices["pan"]


def test_driver_host_motors_start_idle_and_follow_board(hardware: DriverHost, motor: Motor) -> None:
    with hardware.working():
        board = hardware.devices["pan"].board
        commands = hardware.devices["pan"].commands
    assert board.table.modes == [Mode.IDLE]
    assert board.position == pytest.approx([0.3])
    with hardware.lock:
        commands.set_mode(None, Mode.POSITION)
        hardware.devices["pan"].settings.set_reference_speed(None, 2.0)
        clipped = commands.position_move(None, 5.0)
    assert clipped.tolist() == [True]
    wait_until(lambda: abs(motor.position - 1.0) < 0.02)


def test_driver_host_releases_motors_after_failure_and_reopens_them(
    hardware: DriverHost, motor: Motor
) -> None:
    with hardware.working():
        device = hardware.devices["pan"]
    motor.failing = "the cable is out"
    wait_until(lambda: device.failure)
    assert device.board.table.modes == [Mode.HW_FAULT]
    with pytest.raises(HardwareError, match="the cable is out"), hardware.working():
        pass
    with pytest.raises(HardwareError, match="`pan` is not there: the cable is out"):
        hardware.devices["pan"]
    with pytest.raises(HardwareError, match="the cable is out"):
        hardware.open()
    motor.failing = ""
    with hardware.working():
        assert hardware.devices["pan"].board.table.modes == [Mode.IDLE]
    assert motor.opened == 2


def test_driver_host_closing_leaves_motors_without_torque(motor: Motor) -> None:
    hardware = DriverHost(motor, ("pan",), motors=True)
    with hardware.working():
        hardware.devices["pan"].commands.set_mode(None, Mode.POSITION)
    motor.torque = 1.0
    hardware.close()
    assert motor.torque == 0.0


def test_driver_host_motor_holds_position_after_push_ends(
    hardware: DriverHost, motor: Motor
) -> None:
    hardware.set_reference_timeout(3600.0)
    with hardware.working():
        device = hardware.devices["pan"]
    with hardware.lock:
        device.commands.set_mode(None, Mode.TORQUE)
        device.commands.set_torque(None, 0.05)
    wait_until(lambda: motor.velocity > 0.1)
    assert device.board.table.modes == [Mode.TORQUE]
    hardware.set_reference_timeout(0.001)
    wait_until(lambda: device.board.table.modes == [Mode.POSITION])
    with hardware.lock:
        state = device.board.state()
    assert state.interactions == (Interaction.COMPLIANT,)
    assert state.faults.tolist() == [FaultCode.REFERENCE_TIMEOUT]
    wait_until(lambda: abs(motor.velocity) < 0.01)


class TorqueSensingMotor(Motor):
    """Its gear keeps a fifth of the torque for itself, which a sensor tells."""

    broken = False

    def read_torque(self) -> np.ndarray:
        return np.array([np.nan if self.broken else 0.8 * self.torque])


def test_driver_host_motor_with_sensor_gives_requested_torque() -> None:
    motor = TorqueSensingMotor()
    hardware = DriverHost(motor, ("pan",), motors=True)
    try:
        with hardware.working():
            device = hardware.devices["pan"]
        with hardware.lock:
            device.commands.set_mode(None, Mode.TORQUE)
            gains = Gains(ki=20.0, max_output=5.0, max_integral=5.0, feedforward=1.0)
            device.settings.set_pid("pan", gains, Loop.TORQUE)
            device.commands.set_torque(None, 0.02)
        wait_until(lambda: abs(0.8 * motor.torque - 0.02) < 1e-4)
        assert device.settings.pid_error(None, Loop.TORQUE) == pytest.approx([0.0], abs=1e-3)
        motor.broken = True
        wait_until(lambda: device.board.table.modes == [Mode.HW_FAULT])
        assert device.settings.last_fault("pan").message == "the torque sensor reads NaN"
        wait_until(lambda: motor.torque == 0.0)
    finally:
        hardware.close()


@pytest.mark.parametrize("rule", RULES["joint"], ids=str)
def test_motor_driver_conforms(
    rule: ConformanceRule, motor: Motor, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setenv(MAY_MOVE, "1")
    on_hardware(rule, motor, ("pan",), motors=True, skip=pytest.fail)
    assert motor.closed == 1


def test_conformance_skips_moving_rules_without_free_space(
    motor: Motor, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.delenv(MAY_MOVE, raising=False)
    message: list[str] = []
    moving = next(rule for rule in RULES["joint"] if rule.moves_robot)
    on_hardware(moving, motor, ("pan",), motors=True, skip=message.append)
    assert message == ["this rule moves the robot: set ROBOCOMP_MAY_MOVE=1 when there is room"]
    assert motor.opened == 0


class UnimplementedMotor:
    """As `rcgen hardware` writes it."""

    def open(self) -> None:
        raise DriverMethodMissing("open")

    def close(self) -> None:
        pass


def test_conformance_skips_unimplemented_driver_by_name() -> None:
    message: list[str] = []
    on_hardware(RULES["laser"][0], UnimplementedMotor(), ("laser",), skip=message.append)
    assert message == ["`open` of driver.py is not implemented yet"]


class FailingMotor(UnimplementedMotor):
    """There, and wrong."""

    def open(self) -> None:
        pass

    def value(self) -> float:
        return -1.0


def test_conformance_reports_broken_rule_and_closes_device() -> None:
    with pytest.raises(Violation, match="the value is -1"):
        on_hardware(RULES["touchsensor"][0], FailingMotor(), ("bump",), skip=pytest.fail)


def test_conformance_reports_broken_rule_despite_failing_close() -> None:
    class FailingCloseDevice(FailingMotor):
        def open(self) -> None:
            raise OSError("no such port")

        def close(self) -> None:
            raise OSError("never opened")

    hardware = DriverHost(FailingCloseDevice(), ("bump",))
    with pytest.raises(HardwareError, match="no such port"):
        hardware.open()
    with suppress(OSError):
        hardware.close()


def test_driver_host_closes_device_after_failed_call_and_reopens_it() -> None:
    class FreeMotor(FailingMotor):
        opened = 0

        def open(self) -> None:
            self.opened += 1

        def value(self) -> float:
            if self.opened == 1:
                raise OSError("the plug is loose")
            return 0.0

    driver = FreeMotor()
    hardware = DriverHost(driver, ("bump",))
    with hardware.working():
        device = hardware.devices["bump"]
    with pytest.raises(HardwareError, match="the plug is loose"):
        device.value()
    with pytest.raises(HardwareError, match="`bump` is not there: the plug is loose"):
        hardware.devices["bump"]
    with hardware.working():
        assert hardware.devices["bump"].value() == 0.0
