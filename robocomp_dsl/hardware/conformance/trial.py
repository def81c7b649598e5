"""Runs conformance rules against the driver of a real device.

In: a rule, and a driver. Out: nothing, or `Violation`; `skip` is called with the reason where a
rule cannot be run.
"""

from __future__ import annotations

import os
import time
from collections.abc import Callable, Sequence
from typing import Any

from robocomp_dsl.hardware.conformance.joints import JointSubset
from robocomp_dsl.hardware.conformance.rule import ConformanceRule
from robocomp_dsl.hardware.devices.errors import DriverMethodMissing
from robocomp_dsl.hardware.drivers.driver_host import Driver, DriverHost

MAY_MOVE = "ROBOCOMP_MAY_MOVE"
"""Environment variable: 1 confirms that the robot has room to move."""


def on_hardware(
    rule: ConformanceRule,
    driver: Driver,
    ids: Sequence[str],
    *,
    motors: bool = False,
    skip: Callable[[str], object],
) -> None:
    """Run `rule` on the device of `driver`, and close the device at the end.

    Raises `Violation`, `HardwareError`.
    """
    if rule.moves_robot and os.environ.get(MAY_MOVE) != "1":
        skip(f"this rule moves the robot: set {MAY_MOVE}=1 when there is room")
        return
    hardware = DriverHost(driver, ids, motors=motors)
    try:
        hardware.open()
        rule.check(subject_of(hardware.device, ids), time.sleep)
    except DriverMethodMissing as missing:
        skip(str(missing))
    finally:
        hardware.close()


def subject_of(device: Any, ids: Sequence[str]) -> Any:
    """The object that rules examine: the device, or the joints `ids` of a control board."""
    return JointSubset(device, ids) if hasattr(device, "board") else device
