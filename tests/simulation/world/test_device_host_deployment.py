"""The device host of a simulator in a deployment."""

from __future__ import annotations

import os
import signal
import subprocess
import sys
from collections.abc import Callable
from pathlib import Path

from tests.simulation.served_worlds import rcgen
from tests.simulation.world.arm_world import ARM
from tests.support.waiting import wait_until

LINES = 300
"""Of a recorded run."""

RCDEPLOY = Path(sys.executable).with_name("rcdeploy")

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
    """Run `lab.ddsl` until the condition is true, and end it in order. Returns its output."""
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
