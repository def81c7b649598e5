"""Rules tried on a simulated device and on a real one.

In: a rule, and where the device is. Out: nothing, or `Broken`; on hardware `skip` is called with
the reason where a rule cannot be tried.
"""

from __future__ import annotations

import os
import time
from collections.abc import Callable, Sequence
from pathlib import Path
from typing import Any

from robocomp_dsl.hardware.driven import Driver, Hardware
from robocomp_dsl.hardware.errors import NotWritten
from robocomp_dsl.hardware.rules.joints import Motors
from robocomp_dsl.hardware.rules.rule import Rule

MAY_MOVE = "ROBOCOMP_MAY_MOVE"
"""Set to 1 in the environment, it says that there is room for a robot to move."""


def on_simulation(rule: Rule, scene: Path, ids: Sequence[str]) -> None:
    """The device, or the joints, `ids` of a world that `rcgen` wrote, as fast as it can.

    Raises `Broken`.
    """
    from robocomp_dsl.hardware.mujoco.simulation import Simulation  # noqa: PLC0415 - MuJoCo

    simulation = Simulation.read(scene)
    rule.holds(_subject(simulation.devices[ids[0]], ids), simulation.advance)


def on_hardware(
    rule: Rule,
    driver: Driver,
    ids: Sequence[str],
    *,
    motors: bool = False,
    skip: Callable[[str], object],
) -> None:
    """The device behind `driver`, which is closed in the end. Raises `Broken`, `HardwareError`."""
    if rule.moves and os.environ.get(MAY_MOVE) != "1":
        skip(f"it moves the robot: say {MAY_MOVE}=1 when there is room")
        return
    hardware = Hardware(driver, ids, motors=motors)
    try:
        hardware.open()
        rule.holds(_subject(hardware.device, ids), time.sleep)
    except NotWritten as missing:
        skip(str(missing))
    finally:
        hardware.close()


def _subject(device: Any, ids: Sequence[str]) -> Any:
    """What rules are told of: the device, or on a control board the joints `ids`."""
    return Motors(device, ids) if hasattr(device, "board") else device
