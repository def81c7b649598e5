"""The folder `generic_arm` as a process beside each simulated robot, over zenoh, as it is shipped.

The robots differ in the parameters `description` and in the wire of `board`; commands are the same.
"""

from __future__ import annotations

import contextlib
import os
import signal
import subprocess
import sys
from collections.abc import Iterator
from contextlib import ExitStack
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any

import numpy as np
import pytest

from robocomp_dsl.runtime.component.callback_group import CallbackGroup
from robocomp_dsl.runtime.component.statistics import Statistics
from robocomp_dsl.runtime.connection.component_ports import open_ports
from robocomp_dsl.runtime.connection.endpoint import Endpoint
from robocomp_dsl.runtime.connection.ports import ComponentContext
from robocomp_dsl.runtime.errors import MiddlewareError
from tests.support.waiting import wait_until
from tests.touch.arm_client import ARM, DESCRIPTIONS, refusal_of
from tests.touch.shipped_component import COMPONENTS

ROBOTS = {"nao": ("nao_h25", "LArm"), "icub": ("icub_v2", "left_arm")}
GOALS = (
    np.array([0.5, 0.6, 0.3, 0.9, 0.2]),
    np.array([0.1, 0.4, -0.1, 0.5, -0.2]),
    np.array([0.9, 0.5, 0.4, 1.2, 0.0]),
)
NONE = np.zeros(0)


@dataclass
class ArmDeployment:
    """Two processes of a domain, and a client of the arm."""

    robot: str
    domain: str
    processes: dict[str, subprocess.Popen[str]] = field(default_factory=dict)
    arm: Any = None
    states: list[Any] = field(default_factory=list)

    def start(self, component: str, *options: str) -> None:
        self.processes[component] = subprocess.Popen(
            [sys.executable, "main.py", "--domain", self.domain, "--log-level", "error", *options],
            cwd=COMPONENTS / component,
            env={**os.environ, "PYTHONPATH": str(Path(__file__).parents[2])},
            stderr=subprocess.DEVNULL,
            text=True,
        )

    @property
    def simulator(self) -> str:
        return f"{self.robot}_simulator"

    def start_arm(self) -> None:
        description, board = ROBOTS[self.robot]
        self.start(
            "generic_arm",
            *("--set", f"description={DESCRIPTIONS / description}.yaml"),
            *("--set", "patience=1000"),
            *("--connect", f"board={self.simulator}.{board}"),
        )

    def end(self) -> None:
        for process in self.processes.values():
            with contextlib.suppress(ProcessLookupError):
                process.send_signal(signal.SIGCONT)
                process.terminate()
        for process in self.processes.values():
            try:
                process.wait(60)
            except subprocess.TimeoutExpired:
                process.kill()
                process.wait()

    def answers(self) -> bool:
        try:
            self.arm["getState"]()
        except (ARM.interfaces.NotPossible, MiddlewareError):
            return False
        return True

    def wait_for_rest(self) -> np.ndarray:
        wait_until(lambda: not self.arm["getState"]().moving)
        return self.arm["getState"]().position


@pytest.fixture
def deployed(tmp_path: Path) -> Iterator[Any]:
    with ExitStack() as stack:

        def deploy(robot: str) -> ArmDeployment:
            deployment = ArmDeployment(robot, f"arm-{robot}-{tmp_path.name}")
            stack.callback(deployment.end)
            deployment.start(deployment.simulator)
            deployment.start_arm()
            host = ComponentContext("client", deployment.domain, CallbackGroup(), Statistics())
            middleware = open_ports("zenoh", host)
            stack.callback(middleware.close)
            interface = ARM.interfaces.GENERICARM
            link = middleware.proxy(Endpoint(interface, "client", "arm", ("generic_arm",)))
            assert link.wait(120)
            deployment.arm = {
                operation.name: link.bind(operation) for operation in interface.operations
            }
            topic = ARM.interfaces.GenericArmStateProxy.INTERFACE
            at = Endpoint(topic, "client", "GenericArmState")
            middleware.subscribe(at, {"armState": deployment.states.append}, CallbackGroup())
            wait_until(deployment.answers)
            return deployment

        yield deploy


def test_deployed_generic_arm_gives_same_angles_on_both_robots(deployed: Any) -> None:
    reached = {}
    for name in ROBOTS:
        deployment = deployed(name)
        reached[name] = []
        for goal in GOALS:
            outcome = deployment.arm["move"](goal, np.full(5, 1.0))
            assert not (outcome.clipped | outcome.dropped).any()
            reached[name].append(deployment.wait_for_rest())
        assert len(deployment.states) > 10
        assert deployment.arm["getLimits"]().available.all()
        deployment.end()
    for goal, nao, icub in zip(GOALS, reached["nao"], reached["icub"], strict=True):
        assert nao == pytest.approx(goal, abs=0.05)
        assert icub == pytest.approx(goal, abs=0.05)
        assert nao == pytest.approx(icub, abs=0.05)


def test_deployed_generic_arm_reports_suspended_or_killed_robot_and_reconnects(
    deployed: Any,
) -> None:
    deployment = deployed("icub")
    robot = deployment.processes[deployment.simulator]
    robot.send_signal(signal.SIGSTOP)
    wait_until(lambda: not deployment.answers())
    assert "the arm does not answer" in refusal_of(deployment.arm["move"], GOALS[0], NONE)
    robot.send_signal(signal.SIGCONT)
    wait_until(deployment.answers)
    robot.kill()
    robot.wait()
    wait_until(lambda: not deployment.answers())
    assert "the arm does not answer" in refusal_of(deployment.arm["getState"])
    deployment.start(deployment.simulator)
    wait_until(deployment.answers)
    deployment.arm["move"](GOALS[0], NONE)
    assert deployment.wait_for_rest() == pytest.approx(GOALS[0], abs=0.05)


@pytest.mark.parametrize(
    ("wires", "found"),
    [
        ("connect arm.board -> body.LArm;", ""),
        ("connect arm.board -> body.LArm; connect arm.board2 -> body.Head;", ""),
        ("connect arm.board2 -> body.Head;", "error[RC508]: `arm` requires `board`, which"),
    ],
)
def test_generic_arm_deployment_connects_existing_boards(
    wires: str, found: str, tmp_path: Path
) -> None:
    (tmp_path / "arm.ddsl").write_text(
        f'import "{COMPONENTS}/nao_simulator/nao_simulator.cdsl";\n'
        f'import "{COMPONENTS}/generic_arm/generic_arm.cdsl";\n'
        "Deployment test\n{\n"
        "component body : nao_simulator;\n"
        'component arm : generic_arm { set description = "robot.yaml"; };\n'
        f"{wires}\n}};\n"
    )
    rcgen = Path(sys.executable).with_name("rcgen")
    done = subprocess.run(
        [rcgen, "check", "arm.ddsl"], cwd=tmp_path, capture_output=True, text=True, check=False
    )
    output = done.stdout + done.stderr
    assert found in output
    assert output.count("RC5") == bool(found)
