"""Devices of a deployment in a simulator: led through their phases on the boards of the world."""

from __future__ import annotations

import json
import os
import random
import signal
import subprocess
import sys
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
from tests.simulation.served_worlds import rcgen, scene_of
from tests.support.waiting import wait_until

ARM = """\
<innerModel>
  <transform id="base">
    <joint id="pan" axis="y" min="-1.5" max="1.5">
      <joint id="tilt" axis="x" min="-1.5" max="1.5">
        <transform id="upper" tz="200">
          <joint id="elbow" axis="x" min="-1.5" max="1.5"><transform id="hand" tz="150"/></joint>
        </transform>
      </joint>
    </joint>
  </transform>
</innerModel>
"""
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
DEADLINE_S = 120.0
LINES = 300
"""Of a recorded run."""
RCDEPLOY = Path(sys.executable).with_name("rcdeploy")


def simulation(folder: Path) -> Simulation:
    return Simulation(scene_of(folder / "arm.xml", ARM), SimulationOptions(speed=0.0))


@contextmanager
def running(simulation: Simulation) -> Iterator[None]:
    simulation.start()
    try:
        yield
    finally:
        simulation.stop()


def plugged(simulation: Simulation, **change: Any) -> SimulatedDeviceHost:
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
    result = simulation(tmp_path)
    devices = plugged(result)
    with running(result):
        devices.raise_if_failed()
        wait_until_locked(result, lambda: devices.ready)
        with result.lock:
            assert positions(result) == pytest.approx([0, 0, 0.5], abs=0.05)
            controller = devices["reach"].controller
            goal = controller.pose()[:3, 3] + (20.0, 10.0, -20.0)
            controller.go_to(goal, 0.3)
        wait_until_locked(result, lambda: controller.state is CartesianState.REACHED)
        wait_until_locked(result, lambda: np.abs(controller.pose()[:3, 3] - goal).max() < 2.0)
        devices.stop()
        with result.lock:
            assert set(result.devices["pan"].board.table.modes) == {Mode.IDLE}
            assert positions(result)[0] == pytest.approx(0.7, abs=0.06)


class Jittery(threading.Thread):
    """Threads that begin when they like, as on a busy machine."""

    def run(self) -> None:
        for _ in range(random.randrange(2_000)):
            os.sched_yield()
        super().run()


def led_in_step(folder: Path) -> bytes:
    """What becomes of the arm while devices start in step, and what the devices have come to."""
    folder.mkdir()
    result = simulation(folder)
    # a second calibration, that waits for the first: a level of its own
    again = {"phase": "startup", "level": 6, "calibrate": "arm"}
    devices = plugged(result, actions=[*DEVICES["actions"], again])
    received, ready = [], False
    while not ready or result.time < ready + 0.5:
        result.advance(0.01)
        devices.raise_if_failed()
        board = result.devices["pan"].board
        received.append(board.position.tobytes() + board.torque.tobytes() + bytes([devices.ready]))
        if devices.ready and not ready:
            ready = result.time
            devices["reach"].controller.go_to([20.0, 110.0, 300.0], 0.3)
        assert result.time < 60
    devices.stop(lambda: result.advance(0.01))
    return b"".join(received)


def test_device_host_on_deployment_clock_depends_on_simulated_time_only(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    """Startup, levels and motions come at the same steps, however threads are scheduled."""
    monkeypatch.setattr(Simulation, "on_deployment_clock", True)
    monkeypatch.setattr(threading, "Thread", Jittery)
    first = led_in_step(tmp_path / "one")
    assert led_in_step(tmp_path / "two") == first


def test_device_host_advances_world_during_shutdown(tmp_path: Path) -> None:
    """As in a deployment with its own time, when the component has ended."""
    result = simulation(tmp_path)
    devices = plugged(result)
    devices.raise_if_failed()
    while not devices.ready:
        with result.lock:
            result.advance(0.02)
    devices.stop(lambda: result.advance(0.02))
    assert positions(result)[0] == pytest.approx(0.7, abs=0.06)


def test_device_host_restarts_devices_after_reset(
    tmp_path: Path, caplog: pytest.LogCaptureFixture
) -> None:
    result = simulation(tmp_path)
    devices = plugged(result)
    with running(result):
        devices.raise_if_failed()
        wait_until_locked(result, lambda: devices.ready)
        with result.lock:
            before = devices["arm"].board
            result.reset()
        devices.raise_if_failed()
        assert "all devices start again" in caplog.text
        wait_until_locked(result, lambda: devices.ready)
        with result.lock:
            assert devices["arm"].board is not before
            assert positions(result) == pytest.approx([0, 0, 0.5], abs=0.05)
        devices.stop()


def test_device_host_without_plan_has_no_devices(tmp_path: Path) -> None:
    devices = SimulatedDeviceHost(simulation(tmp_path), {})
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
    result = simulation(tmp_path)
    devices = plugged(result, **change)
    with running(result):
        with pytest.raises(HardwareError, match=message):
            poll_until_failure(devices)
        devices.stop()
    assert "Traceback" not in caplog.text


def test_device_host_refuses_invalid_plan(tmp_path: Path) -> None:
    result = simulation(tmp_path)
    with pytest.raises(PlanError, match="tail"):
        plugged(result, attach={"zeroing": ["tail"]})
    with pytest.raises(InvalidPlan):
        SimulatedDeviceHost(result, {DEVICES_VARIABLE: "{"})


def test_device_host_names_board_parts_after_ports(tmp_path: Path) -> None:
    assert {n: p.joints for n, p in board_parts(simulation(tmp_path)).items()} == {
        "ControlBoard": ("pan", "tilt", "elbow")
    }
    bare = Simulation(scene_of(tmp_path / "bare.xml", BARE))
    assert board_parts(bare) == {}


WORKER = """\
from __future__ import annotations

from pathlib import Path

from arm_simulator_generated.simulator import Simulator


class SpecificWorker(Simulator):
    goal = None

    def compute(self) -> None:
        super().compute()
        if not self.devices.ready:
            return
        controller = self.devices["reach"].controller
        with self.simulation.lock:
            if self.goal is None:
                self.goal = controller.pose()[:3, 3] + (20.0, 10.0, -20.0)
                controller.go_to(self.goal, 0.3)
            elif controller.state.value == "reached":
                Path("reached").touch()
"""
DDSL = """\
import "arm_simulator/arm_simulator.cdsl";
Deployment lab {
    component arm_simulator {
        device arm : control_board { set part = ControlBoard; };
        device zeroing : calibrator { set speed = 2.0; set home.elbow = 0.5; };
        device reach : cartesian { set tip = hand; };
        attach zeroing to arm;
        attach reach to arm;
        on startup level 5 calibrate arm by zeroing;
        on shutdown level 1 park arm by zeroing;
    };
};
"""


def deployed(folder: Path, name: str, seen: Callable[[], bool]) -> str:
    """Run `lab.ddsl` until something is seen, and end it in order; what it has said."""
    options = ("--name", name, "--domain", name, "--no-table")
    with (folder / f"{name}.log").open("w+") as log:
        process = subprocess.Popen(
            [RCDEPLOY, "lab.ddsl", "up", *options], cwd=folder, stdout=log, stderr=log
        )
        try:

            def holds() -> bool:
                assert process.poll() is None, Path(log.name).read_text()
                return seen()

            wait_until(holds, Path(log.name).read_text)
        finally:
            process.send_signal(signal.SIGINT)
            code = process.wait(timeout=60)
    message = Path(log.name).read_text()
    assert code == 0
    assert "failed" not in message
    return message


def test_device_host_runs_in_simulator_process_of_deployment(tmp_path: Path) -> None:
    (tmp_path / "arm.xml").write_text(ARM)
    assert rcgen("simulator", "arm.xml", cwd=tmp_path).returncode == 0
    folder = tmp_path / "arm_simulator"
    (folder / "specificworker.py").write_text(WORKER)
    (tmp_path / "lab.ddsl").write_text(DDSL)
    shown = subprocess.run(
        [RCDEPLOY, "lab.ddsl", "plan"], cwd=tmp_path, capture_output=True, text=True, check=False
    )
    assert "arm: control_board" in shown.stdout, shown.stdout
    assert "startup 5: calibrate arm by zeroing" in shown.stdout
    deployed(tmp_path, f"plugged-{os.getpid()}", (folder / "reached").exists)


WRITER = """\
from __future__ import annotations

from pathlib import Path

from arm_simulator_generated.simulator import Simulator


class SpecificWorker(Simulator):
    goal = None

    def compute(self) -> None:
        super().compute()
        with self.simulation.lock:
            state = self.simulation.devices["pan"].board.state()
            line = f"{self.clock.now():.6f} {state.position.tobytes().hex()} {self.devices.ready}"
            if self.devices.ready and self.goal is None:
                controller = self.devices["reach"].controller
                self.goal = controller.pose()[:3, 3] + (20.0, 10.0, -20.0)
                controller.go_to(self.goal, 0.3)
        with Path("path.txt").open("a") as file:
            file.write(f"{line}\\n")
"""


def test_device_host_in_lockstep_repeats_byte_for_byte(tmp_path: Path) -> None:
    (tmp_path / "arm.xml").write_text(ARM)
    assert rcgen("simulator", "arm.xml", cwd=tmp_path).returncode == 0
    folder = tmp_path / "arm_simulator"
    (folder / "specificworker.py").write_text(WRITER)
    lockstep = DDSL.replace("{\n", "{\n    clock sim lockstep;\n", 1)
    (tmp_path / "lab.ddsl").write_text(lockstep)
    runs, path = [], folder / "path.txt"

    def lines() -> list[str]:
        return path.read_text().splitlines()[:LINES] if path.exists() else []

    for number in range(2):
        deployed(tmp_path, f"stepped-{os.getpid()}-{number}", lambda: len(lines()) == LINES)
        runs.append(lines())
        path.unlink()
    assert runs[0] == runs[1]
    ready = [line.endswith("True") for line in runs[0]]
    assert not ready[0]
    assert ready[-1]
    assert len({line.split()[1] for line in runs[0][ready.index(True) :]}) > 20  # it has moved on
