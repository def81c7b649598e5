"""The device host of a simulator in one process."""

from __future__ import annotations

import json
import os
import random
import threading
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from pathlib import Path
from typing import Any

import numpy as np
import pytest

from robocomp_dsl.hardware.control.modes import Mode
from robocomp_dsl.hardware.device_manager.check import PlanError
from robocomp_dsl.hardware.device_manager.host import DEVICES_VARIABLE
from robocomp_dsl.hardware.device_manager.read import InvalidPlan
from robocomp_dsl.hardware.devices.errors import HardwareError
from robocomp_dsl.hardware.kinematics.cartesian_controller import CartesianState
from robocomp_dsl.simulation.world.device_host import SimulatedDeviceHost, board_parts
from robocomp_dsl.simulation.world.simulation import Simulation, SimulationOptions
from tests.simulation.served_worlds import scene_of
from tests.simulation.world.arm_world import ARM
from tests.support.waiting import wait_until

BARE = '<innerModel><transform id="a"/></innerModel>'

DEVICES: dict[str, Any] = {
    "devices": [
        {"name": "arm", "kind": "control_board", "part": "ControlBoard"},
        {"name": "zeroing", "kind": "calibrator", "speed": 0.5, "home.elbow": 0.5, "park.pan": 0.7},
        {"name": "reach", "kind": "cartesian", "tip": "hand"},
    ],
    "attach": {"zeroing": ["arm"], "reach": ["arm"]},
    "actions": [
        {"phase": "startup", "level": 5, "calibrate": "arm"},
        {"phase": "shutdown", "level": 1, "park": "arm"},
    ],
}


def open_arm(folder: Path) -> Simulation:
    return Simulation(scene_of(folder / "arm.xml", ARM), SimulationOptions(speed=0.0))


@contextmanager
def running(simulation: Simulation) -> Iterator[None]:
    simulation.start()
    try:
        yield
    finally:
        simulation.stop()


def host_devices(simulation: Simulation, **change: Any) -> SimulatedDeviceHost:
    return SimulatedDeviceHost(simulation, {DEVICES_VARIABLE: json.dumps(DEVICES | change)})


def wait_until_locked(simulation: Simulation, condition: Callable[[], object]) -> None:
    """Wait for a condition that is evaluated with the lock of the simulation."""

    def holds() -> object:
        with simulation.lock:
            return condition()

    wait_until(holds)


def poll_until_failure(devices: SimulatedDeviceHost) -> None:
    """Supervise the devices until they fail, as a component does in every period."""
    wait_until(devices.raise_if_failed, "the devices have not failed")


def positions(simulation: Simulation) -> list[float]:
    found: list[float] = simulation.devices["pan"].board.position.tolist()
    return found


def test_device_host_calibrates_uses_and_parks_devices(tmp_path: Path) -> None:
    simulation = open_arm(tmp_path)
    devices = host_devices(simulation)
    with running(simulation):
        devices.raise_if_failed()
        wait_until_locked(simulation, lambda: devices.ready)
        with simulation.lock:
            assert positions(simulation) == pytest.approx([0, 0, 0.5], abs=0.05)
            controller = devices["reach"].controller
            goal = controller.pose()[:3, 3] + (20.0, 10.0, -20.0)
            controller.go_to(goal, 0.3)
        wait_until_locked(simulation, lambda: controller.state is CartesianState.REACHED)
        wait_until_locked(simulation, lambda: np.abs(controller.pose()[:3, 3] - goal).max() < 2.0)
        devices.stop()
        with simulation.lock:
            assert set(simulation.devices["pan"].board.table.modes) == {Mode.IDLE}
            assert positions(simulation)[0] == pytest.approx(0.7, abs=0.06)


class JitterThread(threading.Thread):
    """Threads that begin when they like, as on a busy machine."""

    def run(self) -> None:
        for _ in range(random.randrange(2_000)):
            os.sched_yield()
        super().run()


def led_in_step(folder: Path) -> bytes:
    """What becomes of the arm while devices start in step, and what the devices have come to."""
    folder.mkdir()
    simulation = open_arm(folder)
    # a second calibration, that waits for the first: a level of its own
    again = {"phase": "startup", "level": 6, "calibrate": "arm"}
    devices = host_devices(simulation, actions=[*DEVICES["actions"], again])
    received, ready = [], False
    while not ready or simulation.time < ready + 0.5:
        simulation.advance(0.01)
        devices.raise_if_failed()
        board = simulation.devices["pan"].board
        received.append(board.position.tobytes() + board.torque.tobytes() + bytes([devices.ready]))
        if devices.ready and not ready:
            ready = simulation.time
            devices["reach"].controller.go_to([20.0, 110.0, 300.0], 0.3)
        assert simulation.time < 60
    devices.stop(lambda: simulation.advance(0.01))
    return b"".join(received)


def test_device_host_on_deployment_clock_depends_on_simulated_time_only(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    """Startup, levels and motions come at the same steps, however threads are scheduled."""
    monkeypatch.setattr(Simulation, "on_deployment_clock", True)
    monkeypatch.setattr(threading, "Thread", JitterThread)
    first = led_in_step(tmp_path / "one")
    assert led_in_step(tmp_path / "two") == first


def test_device_host_advances_world_during_shutdown(tmp_path: Path) -> None:
    """As in a deployment with its own time, when the component has ended."""
    simulation = open_arm(tmp_path)
    devices = host_devices(simulation)
    devices.raise_if_failed()
    while not devices.ready:
        with simulation.lock:
            simulation.advance(0.02)
    devices.stop(lambda: simulation.advance(0.02))
    assert positions(simulation)[0] == pytest.approx(0.7, abs=0.06)


def test_device_host_restarts_devices_after_reset(
    tmp_path: Path, caplog: pytest.LogCaptureFixture
) -> None:
    simulation = open_arm(tmp_path)
    devices = host_devices(simulation)
    with running(simulation):
        devices.raise_if_failed()
        wait_until_locked(simulation, lambda: devices.ready)
        with simulation.lock:
            before = devices["arm"].board
            simulation.reset()
        devices.raise_if_failed()
        assert "all devices start again" in caplog.text
        wait_until_locked(simulation, lambda: devices.ready)
        with simulation.lock:
            assert devices["arm"].board is not before
            assert positions(simulation) == pytest.approx([0, 0, 0.5], abs=0.05)
        devices.stop()


def test_device_host_without_plan_has_no_devices(tmp_path: Path) -> None:
    devices = SimulatedDeviceHost(open_arm(tmp_path), {})
    devices.raise_if_failed()
    assert not devices.ready
    with pytest.raises(HardwareError, match="there is no device `arm` now; available: none"):
        devices["arm"]
    devices.stop()


def device(at: int, **change: Any) -> dict[str, Any]:
    found = [dict(device) for device in DEVICES["devices"]]
    found[at] |= change
    return {"devices": found}


@pytest.mark.parametrize(
    ("change", "message"),
    [
        (device(0, part="tail"), "there is no part `tail`: ControlBoard"),
        (device(2, tip="tail"), "the startup of the devices failed"),
        (device(2, tip=""), "the startup of the devices failed"),
        (device(2, speed=1), "the startup of the devices failed"),
    ],
)
def test_device_host_reports_failed_startup(
    tmp_path: Path, change: dict[str, Any], message: str, caplog: pytest.LogCaptureFixture
) -> None:
    simulation = open_arm(tmp_path)
    devices = host_devices(simulation, **change)
    with running(simulation):
        with pytest.raises(HardwareError, match=message):
            poll_until_failure(devices)
        devices.stop()
    assert "Traceback" not in caplog.text


def test_device_host_refuses_invalid_plan(tmp_path: Path) -> None:
    simulation = open_arm(tmp_path)
    with pytest.raises(PlanError, match="tail"):
        host_devices(simulation, attach={"zeroing": ["tail"]})
    with pytest.raises(InvalidPlan):
        SimulatedDeviceHost(simulation, {DEVICES_VARIABLE: "{"})


def test_device_host_names_board_parts_after_ports(tmp_path: Path) -> None:
    assert {n: p.joints for n, p in board_parts(open_arm(tmp_path)).items()} == {
        "ControlBoard": ("pan", "tilt", "elbow")
    }
    bare = Simulation(scene_of(tmp_path / "bare.xml", BARE))
    assert board_parts(bare) == {}
