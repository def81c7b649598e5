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
from arm_client import ARM, DESCRIPTIONS, refused, until
from shipped_component import COMPONENTS

from robocomp_dsl.runtime.errors import MiddlewareError
from robocomp_dsl.runtime.execution import Execution
from robocomp_dsl.runtime.middleware import open_middleware
from robocomp_dsl.runtime.middleware.base import Endpoint, Host
from robocomp_dsl.runtime.statistics import Statistics

ROBOTS = {"nao": ("nao_h25", "LArm"), "icub": ("icub_v2", "left_arm")}
GOALS = (
    np.array([0.5, 0.6, 0.3, 0.9, 0.2]),
    np.array([0.1, 0.4, -0.1, 0.5, -0.2]),
    np.array([0.9, 0.5, 0.4, 1.2, 0.0]),
)
NONE = np.zeros(0)


@dataclass
class Deployed:
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
        for one in self.processes.values():
            with contextlib.suppress(ProcessLookupError):
                one.send_signal(signal.SIGCONT)
                one.terminate()
        for one in self.processes.values():
            try:
                one.wait(60)
            except subprocess.TimeoutExpired:
                one.kill()
                one.wait()

    def answers(self) -> bool:
        try:
            self.arm["getState"]()
        except (ARM.interfaces.NotPossible, MiddlewareError):
            return False
        return True

    def rest(self) -> np.ndarray:
        until(lambda: not self.arm["getState"]().moving)
        return self.arm["getState"]().position


@pytest.fixture
def deployed(tmp_path: Path) -> Iterator[Any]:
    with ExitStack() as stack:

        def deploy(robot: str) -> Deployed:
            made = Deployed(robot, f"arm-{robot}-{tmp_path.name}")
            stack.callback(made.end)
            made.start(made.simulator)
            made.start_arm()
            host = Host("client", made.domain, Execution(), Statistics())
            middleware = open_middleware("zenoh", host)
            stack.callback(middleware.close)
            interface = ARM.interfaces.GENERICARM
            link = middleware.proxy(Endpoint(interface, "client", "arm", ("generic_arm",)))
            assert link.wait(120)
            made.arm = {one.name: link.bind(one) for one in interface.operations}
            topic = ARM.interfaces.GenericArmStateProxy.INTERFACE
            at = Endpoint(topic, "client", "GenericArmState")
            middleware.subscribe(at, {"armState": made.states.append}, Execution())
            until(made.answers)
            return made

        yield deploy


def test_the_same_folder_gives_the_same_angles_on_both_robots(deployed: Any) -> None:
    reached = {}
    for name in ROBOTS:
        one = deployed(name)
        reached[name] = []
        for goal in GOALS:
            outcome = one.arm["move"](goal, np.full(5, 1.0))
            assert not (outcome.clipped | outcome.dropped).any()
            reached[name].append(one.rest())
        assert len(one.states) > 10
        assert one.arm["getLimits"]().available.all()
        one.end()
    for goal, nao, icub in zip(GOALS, reached["nao"], reached["icub"], strict=True):
        assert nao == pytest.approx(goal, abs=0.05)
        assert icub == pytest.approx(goal, abs=0.05)
        assert nao == pytest.approx(icub, abs=0.05)


def test_a_robot_that_hangs_or_dies_is_told_and_found_again(deployed: Any) -> None:
    one = deployed("icub")
    robot = one.processes[one.simulator]
    robot.send_signal(signal.SIGSTOP)
    until(lambda: not one.answers())
    assert "the arm does not answer" in refused(one.arm["move"], GOALS[0], NONE)
    robot.send_signal(signal.SIGCONT)
    until(one.answers)
    robot.kill()
    robot.wait()
    until(lambda: not one.answers())
    assert "the arm does not answer" in refused(one.arm["getState"])
    one.start(one.simulator)
    until(one.answers)
    one.arm["move"](GOALS[0], NONE)
    assert one.rest() == pytest.approx(GOALS[0], abs=0.05)


@pytest.mark.parametrize(
    ("wires", "found"),
    [
        ("connect arm.board -> body.LArm;", ""),
        ("connect arm.board -> body.LArm; connect arm.board2 -> body.Head;", ""),
        ("connect arm.board2 -> body.Head;", "error[RC508]: `arm` requires `board`, which"),
    ],
)
def test_a_deployment_wires_the_physical_parts_that_there_are(
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
    told = done.stdout + done.stderr
    assert found in told
    assert told.count("RC5") == bool(found)
