"""Calibration and parking of a control board."""

from __future__ import annotations

import numpy as np
import pytest

from robocomp_dsl.hardware.control.calibration import CalibrationMethod, Calibrator, Procedure
from robocomp_dsl.hardware.control.errors import (
    BadValue,
    ModeRefused,
)
from robocomp_dsl.hardware.control.modes import Mode
from robocomp_dsl.hardware.control.parking import Parking, ParkState
from robocomp_dsl.hardware.control.protection.faults import FaultCode
from tests.hardware.plain_board import plain_board
from tests.support.simulated_arm import Arm

ZERO = np.array([0.4, -0.3, 0.2, 0.5, -0.6, 0.1])


def test_control_board_calibration_finds_zero_and_goes_home():
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


def test_control_board_calibration_that_times_out_is_fault():
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


def test_control_board_refuses_invalid_calibrations():
    board, _ = plain_board()
    for wrong in ({"kind": CalibrationMethod.HARD_STOP}, {"speed": 0.0}, {"timeout": 0.0}):
        with pytest.raises(BadValue):
            Procedure(**wrong)
    with pytest.raises(BadValue):
        Calibrator(board, (Procedure(),))


def test_control_board_parking_brings_arm_to_rest_and_switches_off(arm):
    arm.world.model.opt.gravity[:] = 0  # what is switched off would fall
    parking = Parking(arm.board, arm.inside, speed=1.0)
    parking.park()
    assert parking.busy
    assert arm.wait(lambda: not parking.busy, 10)
    assert set(parking.states) == {ParkState.PARKED}
    assert set(arm.board.table.modes) == {Mode.IDLE}
    assert arm.board.position == pytest.approx(arm.inside, abs=0.25)  # it swings out


def test_control_board_parking_may_be_stopped_and_may_fail(arm):
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
